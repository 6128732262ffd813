//! Columns in memory that arrays and streams share. Knows nothing of Python, so that the streams are tested without it.

use std::sync::Arc;

/// Values of a column.
#[derive(Clone, Debug)]
pub enum Values {
    /// Numbers.
    Numbers(Arc<Vec<f64>>),
    /// Counts.
    Counts(Arc<Vec<i64>>),
    /// Truth values; none where missing.
    Booleans(Arc<Vec<Option<bool>>>),
    /// Texts; none where missing.
    Texts(Arc<Vec<Option<String>>>),
}

/// A named column.
#[derive(Clone, Debug)]
pub struct Series {
    pub name: String,
    /// SI unit; `1` for a pure number, empty for texts.
    pub unit: String,
    pub values: Values,
}

impl Series {
    pub fn numbers(name: &str, unit: &str, values: Vec<f64>) -> Self {
        Self { name: name.into(), unit: unit.into(), values: Values::Numbers(Arc::new(values)) }
    }

    pub fn texts(name: &str, values: Vec<String>) -> Self {
        Self {
            name: name.into(),
            unit: String::new(),
            values: Values::Texts(Arc::new(values.into_iter().map(Some).collect())),
        }
    }

    pub fn rows(&self) -> usize {
        match &self.values {
            Values::Numbers(values) => values.len(),
            Values::Counts(values) => values.len(),
            Values::Booleans(values) => values.len(),
            Values::Texts(values) => values.len(),
        }
    }
}
