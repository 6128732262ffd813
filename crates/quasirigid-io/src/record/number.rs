//! Numbers in JSON, which has no word for those that are not finite: they become `null`.
//!
//! Read back, `null` is NaN, or infinity where [`unbounded`] says that the field means it. Records of versions before wrote the words
//! `"NaN"`, `"inf"` and `"-inf"`, which are still read.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{self, DeserializeOwned, Deserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// A number, or numbers, that a field of a record holds.
pub trait Numbers: Sized {
    /// Type with [`Written`] in place of `f64`.
    type Wire: Serialize + DeserializeOwned;
    /// Converts to the written type.
    fn to_wire(&self) -> Self::Wire;
    /// Converts from the written type, with this number for `null`.
    fn from_wire(wire: Self::Wire, null: f64) -> Self;
}

impl Numbers for f64 {
    type Wire = Written;
    fn to_wire(&self) -> Written {
        Written(self.is_finite().then_some(*self))
    }
    fn from_wire(wire: Written, null: f64) -> Self {
        wire.0.unwrap_or(null)
    }
}

impl<T: Numbers> Numbers for Option<T> {
    type Wire = Option<T::Wire>;
    fn to_wire(&self) -> Self::Wire {
        self.as_ref().map(T::to_wire)
    }
    fn from_wire(wire: Self::Wire, null: f64) -> Self {
        wire.map(|value| T::from_wire(value, null))
    }
}

impl<T: Numbers> Numbers for Vec<T> {
    type Wire = Vec<T::Wire>;
    fn to_wire(&self) -> Self::Wire {
        self.iter().map(T::to_wire).collect()
    }
    fn from_wire(wire: Self::Wire, null: f64) -> Self {
        wire.into_iter().map(|value| T::from_wire(value, null)).collect()
    }
}

impl<T: Numbers> Numbers for BTreeMap<String, T> {
    type Wire = BTreeMap<String, T::Wire>;
    fn to_wire(&self) -> Self::Wire {
        self.iter().map(|(name, value)| (name.clone(), value.to_wire())).collect()
    }
    fn from_wire(wire: Self::Wire, null: f64) -> Self {
        wire.into_iter().map(|(name, value)| (name, T::from_wire(value, null))).collect()
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
    fn from_wire(wire: Self::Wire, null: f64) -> Self {
        wire.map(|value| T::from_wire(value, null))
    }
}

/// For `#[serde(with = "number")]`.
pub fn serialize<T: Numbers, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    value.to_wire().serialize(serializer)
}

/// For `#[serde(with = "number")]`: `null` is NaN.
pub fn deserialize<'de, T: Numbers, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    T::Wire::deserialize(deserializer).map(|wire| T::from_wire(wire, f64::NAN))
}

/// Numbers whose `null` means infinity: times of events that never happen, ratios to zero.
pub mod unbounded {
    use super::{Deserialize, Deserializer, Numbers};

    pub use super::serialize;

    /// For `#[serde(with = "number::unbounded")]`.
    pub fn deserialize<'de, T: Numbers, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
        T::Wire::deserialize(deserializer).map(|wire| T::from_wire(wire, f64::INFINITY))
    }
}

/// One number as JSON spells it here; none is `null`.
pub struct Written(Option<f64>);

impl Serialize for Written {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Written {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Spelling).map(Self)
    }
}

struct Spelling;

impl Visitor<'_> for Spelling {
    type Value = Option<f64>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or null")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Self::Value, E> {
        Ok(Some(value))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Self::Value, E> {
        Ok(Some(value as f64))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Self::Value, E> {
        Ok(Some(value as f64))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
        match text {
            "NaN" => Ok(Some(f64::NAN)),
            "inf" => Ok(Some(f64::INFINITY)),
            "-inf" => Ok(Some(f64::NEG_INFINITY)),
            _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
        }
    }
}
