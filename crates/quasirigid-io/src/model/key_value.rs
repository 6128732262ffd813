//! Values that a program gives to keys of a model, in place of those of the file.
//! TOML's own kinds are mirrored here, so that the library which edits the text stays out of public signatures.

use std::fmt;

/// Value for a key of a model file.
#[derive(Clone, Debug, PartialEq)]
pub enum KeyValue {
    /// A number in SI units.
    Number(f64),
    /// An integer.
    Integer(i64),
    /// `true` or `false`.
    Bool(bool),
    /// A text, such as a name or a number with its unit.
    Text(String),
    /// A list of values.
    List(Vec<KeyValue>),
    /// A table of values by key.
    Table(Vec<(String, KeyValue)>),
}

impl KeyValue {
    /// The value as the library that edits the text writes it.
    pub(super) fn written(&self) -> toml_edit::Value {
        match self {
            Self::Number(number) => (*number).into(),
            Self::Integer(integer) => (*integer).into(),
            Self::Bool(boolean) => (*boolean).into(),
            Self::Text(text) => text.as_str().into(),
            Self::List(items) => items.iter().map(Self::written).collect(),
            Self::Table(entries) => {
                entries.iter().map(|(key, value)| (key.as_str(), value.written())).collect()
            }
        }
    }
}

/// Writes the value as TOML does.
impl fmt::Display for KeyValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.written())
    }
}

impl From<f64> for KeyValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<i64> for KeyValue {
    fn from(integer: i64) -> Self {
        Self::Integer(integer)
    }
}

impl From<bool> for KeyValue {
    fn from(boolean: bool) -> Self {
        Self::Bool(boolean)
    }
}

impl From<&str> for KeyValue {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl<T: Into<KeyValue>> From<Vec<T>> for KeyValue {
    fn from(items: Vec<T>) -> Self {
        Self::List(items.into_iter().map(Into::into).collect())
    }
}
