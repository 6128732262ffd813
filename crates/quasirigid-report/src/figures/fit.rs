//! Measurements beside the model that fits them best: columns of a history over the time, residuals with their histogram, single answers.

use crate::figure::{Compared, Drawn, Panels, Row};
use crate::number::time_unit;

/// A measured column beside that of the history that fits best.
#[derive(Clone, Copy, Debug)]
pub struct FitColumn<'a> {
    /// Name of the column.
    pub name: &'a str,
    /// Unit of the column.
    pub unit: &'a str,
    /// Measured values.
    pub measured: &'a [f64],
    /// Values of the history that fits best.
    pub fitted: &'a [f64],
    /// Residuals over their deviations.
    pub residuals: &'a [f64],
}

/// Columns over the times (s), their residuals in deviations, and the residuals of single answers, as an SVG file of its own; none without
/// any of them.
#[must_use]
pub fn fit_picture(
    title: &str,
    t: &[f64],
    columns: &[FitColumn<'_>],
    answers: &[(&str, f64)],
) -> Option<String> {
    let (unit, length) = time_unit(t.iter().copied().fold(0.0, f64::max));
    let compared = columns.iter().map(|column| Compared {
        name: column.name.to_owned(),
        unit: column.unit.to_owned(),
        measured: column.measured.to_vec(),
        fitted: column.fitted.to_vec(),
        residuals: column.residuals.to_vec(),
    });
    let row = |(name, residual): &(&str, f64)| Row {
        name: (*name).to_owned(),
        drawn: Drawn::Point(*residual, 1.0),
    };
    let panels = Panels {
        title: title.to_owned(),
        x: t.iter().map(|t| t / length).collect(),
        x_name: format!("t [{unit}]"),
        columns: compared.collect(),
        rows: answers.iter().map(row).collect(),
    };
    panels.picture()
}
