//! Numbers in JSON, which has no word for those that are not finite: they become `"NaN"`, `"inf"`, `"-inf"`.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{self, DeserializeOwned, Deserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// A number, or numbers, that a field of a record holds.
pub trait Numbers: Sized {
    /// The same with [`Written`] in the place of `f64`.
    type Wire: Serialize + DeserializeOwned;
    /// To what is written.
    fn to_wire(&self) -> Self::Wire;
    /// From what was read.
    fn from_wire(wire: Self::Wire) -> Self;
}

impl Numbers for f64 {
    type Wire = Written;
    fn to_wire(&self) -> Written {
        Written(*self)
    }
    fn from_wire(wire: Written) -> Self {
        wire.0
    }
}

impl<T: Numbers> Numbers for Option<T> {
    type Wire = Option<T::Wire>;
    fn to_wire(&self) -> Self::Wire {
        self.as_ref().map(T::to_wire)
    }
    fn from_wire(wire: Self::Wire) -> Self {
        wire.map(T::from_wire)
    }
}

impl<T: Numbers> Numbers for Vec<T> {
    type Wire = Vec<T::Wire>;
    fn to_wire(&self) -> Self::Wire {
        self.iter().map(T::to_wire).collect()
    }
    fn from_wire(wire: Self::Wire) -> Self {
        wire.into_iter().map(T::from_wire).collect()
    }
}

impl<T: Numbers> Numbers for BTreeMap<String, T> {
    type Wire = BTreeMap<String, T::Wire>;
    fn to_wire(&self) -> Self::Wire {
        self.iter().map(|(name, value)| (name.clone(), value.to_wire())).collect()
    }
    fn from_wire(wire: Self::Wire) -> Self {
        wire.into_iter().map(|(name, value)| (name, T::from_wire(value))).collect()
    }
}

impl<T: Numbers, const N: usize> Numbers for [T; N]
where
    [T::Wire; N]: Serialize + DeserializeOwned,
{
    type Wire = [T::Wire; N];
    fn to_wire(&self) -> Self::Wire {
        self.each_ref().map(T::to_wire)
    }
    fn from_wire(wire: Self::Wire) -> Self {
        wire.map(T::from_wire)
    }
}

/// For `#[serde(with = "number")]`.
pub fn serialize<T: Numbers, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    value.to_wire().serialize(serializer)
}

/// For `#[serde(with = "number")]`.
pub fn deserialize<'de, T: Numbers, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    T::Wire::deserialize(deserializer).map(T::from_wire)
}

/// One number as JSON spells it here.
pub struct Written(f64);

impl Serialize for Written {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            serializer.serialize_f64(self.0)
        } else {
            serializer.collect_str(&self.0) // Display spells them NaN, inf and -inf
        }
    }
}

impl<'de> Deserialize<'de> for Written {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Spelling).map(Self)
    }
}

struct Spelling;

impl Visitor<'_> for Spelling {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"NaN\", \"inf\" or \"-inf\"")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<f64, E> {
        match text {
            "NaN" => Ok(f64::NAN),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
        }
    }
}
