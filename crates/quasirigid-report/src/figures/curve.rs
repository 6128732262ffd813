//! Columns as curves of a figure.

use quasirigid_io::record::Column;

use crate::columns::{TimeUnit, column};
use crate::figure::Series;

/// A column to draw against the column `t`.
#[derive(Clone, Copy)]
pub struct Curve<'a> {
    /// Name of the column.
    pub name: &'a str,
    /// Label at the right end of the curve.
    pub label: &'a str,
    /// CSS class of its colour.
    pub class: &'static str,
}

impl Curve<'_> {
    /// The curve, if both columns have rows.
    pub fn series(&self, columns: &[Column], time: &TimeUnit, value: fn(f64) -> f64) -> Option<Series> {
        let x = column(columns, "t")?.values.iter().map(|t| t / time.length).collect();
        let y = column(columns, self.name)?.values.iter().map(|&v| value(v)).collect();
        Some(Series::line(self.label, self.class, x, y))
    }
}

/// Unit of a column.
pub fn unit(columns: &[Column], name: &str) -> String {
    column(columns, name).map_or_else(|| "SI".into(), |column| column.unit.clone())
}
