//! Picture of a fit.

use crate::report::{FitColumn, fit_picture};

use super::Inferred;

impl Inferred {
    /// Measured and fitted columns with their residuals and the histogram of these, and the residuals of measured answers, as an SVG file
    /// of its own; none without rows.
    #[must_use]
    pub fn picture(&self) -> Option<String> {
        let unit = self.scatter.filter(|scatter| *scatter > 0.0).unwrap_or(1.0);
        let residuals: Vec<Vec<f64>> =
            self.columns.iter().map(|column| column.residuals.iter().map(|r| r / unit).collect()).collect();
        let columns = self.columns.iter().zip(&residuals).map(|(column, residuals)| FitColumn {
            name: &column.name,
            unit: &column.unit,
            measured: &column.measured,
            fitted: &column.fitted,
            residuals,
        });
        let answers: Vec<(&str, f64)> =
            self.measured.iter().map(|each| (each.quantity.as_str(), each.residual)).collect();
        fit_picture(&self.name, &self.t, &columns.collect::<Vec<_>>(), &answers)
    }
}
