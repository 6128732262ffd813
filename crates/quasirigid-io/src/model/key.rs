//! Keys of tables with their documentation: name, form of the value, meaning.
//! Readers check files against these lists; reference, schema and guide are written from them, so that none can drift.

use super::value::alternatives;

/// Key of a table, with its documentation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    /// Name in the file.
    pub(crate) name: &'static str,
    /// Form of the value.
    pub(crate) form: Form,
    /// Meaning; empty where name and unit say it.
    pub(crate) meaning: &'static str,
}

/// Documented key; texts are plain, but for code between backticks.
pub(crate) const fn key(name: &'static str, form: Form, meaning: &'static str) -> Key {
    Key { name, form, meaning }
}

/// The keys a table can have.
#[derive(Debug)]
pub(crate) struct Keys {
    /// The keys, in the order in which messages list them.
    pub(crate) known: &'static [Key],
}

impl Keys {
    /// Names of the keys.
    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.known.iter().map(|key| key.name)
    }

    /// Whether the table can have a key.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }
}

/// The keys of a list with these names, in their order. The compiler refuses a name that the list does not have.
pub(crate) const fn pick<const N: usize>(all: &[Key], names: [&str; N]) -> [Key; N] {
    let mut picked = [all[0]; N];
    let mut i = 0;
    while i < N {
        picked[i] = all[position(all, names[i])];
        i += 1;
    }
    picked
}

const fn position(all: &[Key], name: &str) -> usize {
    let mut i = 0;
    while i < all.len() {
        if same(all[i].name.as_bytes(), name.as_bytes()) {
            return i;
        }
        i += 1;
    }
    panic!("a kind has a key that its table does not document")
}

const fn same(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// Form of a value: its shape, its unit, and what stands for it if it is left out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    pub(crate) shape: Shape,
    /// Unit of plain numbers; empty for pure ones.
    pub(crate) unit: &'static str,
    /// Default in words; empty for a key that is required, or an alternative to another.
    pub(crate) default: &'static str,
}

/// Shape of a value.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    /// A number, or a text with its unit.
    Number,
    /// An integer from one number to another.
    Integer(u64, u64),
    /// A text.
    Text,
    /// `true` or `false`.
    Boolean,
    /// One of these texts.
    Words(&'static [&'static str]),
    /// The word that chooses the kind of its table.
    Kind,
    /// A formula, or a number in its place.
    Formula,
    /// Three numbers.
    Vector,
    /// Three rows of three numbers.
    Matrix,
    /// Four numbers, scalar first.
    Quaternion,
    /// So many values.
    Array(usize, &'static Shape),
    /// Any number of values.
    List(&'static Shape),
    /// A table with these keys.
    Table(&'static Keys),
    /// A table that several others have, by its name in the reference.
    Shared(&'static str),
    /// A table of values with names of the user's.
    Named(&'static Shape),
    /// A value that depends on other keys.
    Value,
    /// One of several.
    Any(&'static [Shape]),
}

/// A pure number.
pub(crate) const NUMBER: Form = quantity("");
pub(crate) const TEXT: Form = of(Shape::Text);
pub(crate) const BOOLEAN: Form = of(Shape::Boolean);
/// The word that chooses the kind of a table.
pub(crate) const KIND: Form = of(Shape::Kind);
/// A direction, or three pure numbers.
pub(crate) const VECTOR: Form = vector("");
pub(crate) const QUATERNION: Form = of(Shape::Quaternion);
/// A whole number that is not negative.
pub(crate) const COUNT: Form = of(COUNTED);
pub(crate) const COUNTED: Shape = Shape::Integer(0, u64::MAX);

pub(crate) const fn of(shape: Shape) -> Form {
    Form { shape, unit: "", default: "" }
}

pub(crate) const fn quantity(unit: &'static str) -> Form {
    of(Shape::Number).in_unit(unit)
}

pub(crate) const fn vector(unit: &'static str) -> Form {
    of(Shape::Vector).in_unit(unit)
}

pub(crate) const fn integer(least: u64, greatest: u64) -> Form {
    of(Shape::Integer(least, greatest))
}

pub(crate) const fn words(words: &'static [&'static str]) -> Form {
    of(Shape::Words(words))
}

pub(crate) const fn array(count: usize, shape: &'static Shape) -> Form {
    of(Shape::Array(count, shape))
}

pub(crate) const fn list(shape: &'static Shape) -> Form {
    of(Shape::List(shape))
}

pub(crate) const fn table(keys: &'static Keys) -> Form {
    of(Shape::Table(keys))
}

pub(crate) const fn shared(name: &'static str) -> Form {
    of(Shape::Shared(name))
}

pub(crate) const fn named(shape: &'static Shape) -> Form {
    of(Shape::Named(shape))
}

pub(crate) const fn any(shapes: &'static [Shape]) -> Form {
    of(Shape::Any(shapes))
}

impl Form {
    /// The form with this unit.
    pub(crate) const fn in_unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// The form of a value that may be left out.
    pub(crate) const fn or(self, default: &'static str) -> Self {
        Self { default, ..self }
    }

    /// The form in words, with unit and default: `vector, m (0)`.
    pub(crate) fn words(&self) -> String {
        let shape = match self.shape {
            Shape::Number if !self.unit.is_empty() => String::new(),
            shape => shape.noun(),
        };
        let default = if self.default.is_empty() { String::new() } else { format!("({})", self.default) };
        let separator = if shape.is_empty() || self.unit.is_empty() { "" } else { ", " };
        let value = format!("{shape}{separator}{}", self.unit);
        [value, default].into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

impl Shape {
    /// The shape in words.
    fn noun(&self) -> String {
        match self {
            Self::Number => "number".to_owned(),
            Self::Integer(_, u64::MAX) => "integer".to_owned(),
            Self::Integer(least, greatest) => format!("{least} to {greatest}"),
            Self::Text | Self::Kind => "text".to_owned(),
            Self::Boolean => "boolean".to_owned(),
            Self::Words(_) => alternatives(&self.choices(false)),
            Self::Formula => "formula".to_owned(),
            Self::Vector => "vector".to_owned(),
            Self::Matrix => "3×3".to_owned(),
            Self::Quaternion => "quaternion".to_owned(),
            Self::Array(count, shape) => format!("{count} {}", shape.plural()),
            Self::List(shape) => shape.plural(),
            Self::Table(_) => "table".to_owned(),
            Self::Shared(name) => format!("`{name}`"),
            Self::Named(shape) => format!("named {}", shape.plural()),
            Self::Value => "value".to_owned(),
            Self::Any(shapes) => {
                let several = shapes.iter().any(|shape| matches!(shape, Self::Vector | Self::List(_)));
                alternatives(&shapes.iter().flat_map(|shape| shape.choices(several)).collect::<Vec<_>>())
            }
        }
    }

    /// The shape in words beside others; beside several numbers, one is told by its count.
    fn choices(&self, several: bool) -> Vec<String> {
        match self {
            Self::Number if several => vec!["1".to_owned()],
            Self::Vector if several => vec!["3".to_owned()],
            Self::Words(words) => words.iter().map(|word| format!("`{word:?}`")).collect(),
            other => vec![other.noun()],
        }
    }

    fn plural(&self) -> String {
        match self {
            Self::Integer(..) => "integers".to_owned(),
            Self::Words(_) => format!("list of {}", self.noun()),
            Self::Any(_) => "values".to_owned(),
            Self::Shared(_) => self.noun(),
            Self::List(_) | Self::Array(..) => "lists".to_owned(),
            other => format!("{}s", other.noun()),
        }
    }
}
