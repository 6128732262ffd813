//! Symmetric matrices of the coefficients of springs and hinges.

use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::number::finite;
use crate::{Coefficient, HingeCoefficient, Problem};

/// Difference, relative to the largest entry, up to which entries agree: rounding of 13 digits.
const SYMMETRY_ROUNDING: f64 = 1e-12;

/// Matrix of a spring's coefficient.
pub(crate) fn matrix(coefficient: Coefficient) -> Result<Matrix3<f64>, Problem> {
    let entries = match coefficient {
        Coefficient::Isotropic(value) => Matrix3::from_diagonal_element(value),
        Coefficient::Diagonal(values) => Matrix3::from_diagonal(&Vector3::from(values)),
        Coefficient::Full(rows) => Matrix3::from_fn(|row, column| rows[row][column]),
    };
    let checked = semi_definite(&DMatrix::from_iterator(3, 3, entries.iter().copied()))?;
    Ok(Matrix3::from_fn(|row, column| checked[(row, column)]))
}

/// Matrix of a hinge's coefficient, one row per axis.
pub(crate) fn hinge_matrix(coefficient: &HingeCoefficient, axes: usize) -> Result<DMatrix<f64>, Problem> {
    let per_axis = |values| {
        if values == axes { Ok(()) } else { Err(Problem::ValuePerAxis { axes, values }) }
    };
    let entries = match coefficient {
        HingeCoefficient::PerAxis(values) => {
            per_axis(values.len())?;
            DMatrix::from_fn(axes, axes, |row, column| if row == column { values[row] } else { 0.0 })
        }
        HingeCoefficient::Full(rows) => {
            per_axis(rows.len())?;
            rows.iter().try_for_each(|row| per_axis(row.len()))?;
            DMatrix::from_fn(axes, axes, |row, column| rows[row][column])
        }
    };
    semi_definite(&entries)
}

/// Accepts a symmetric positive semi-definite matrix and returns its symmetric part.
fn semi_definite(entries: &DMatrix<f64>) -> Result<DMatrix<f64>, Problem> {
    finite(entries.as_slice())?;
    let tolerance = SYMMETRY_ROUNDING * entries.amax();
    for row in 0..entries.nrows() {
        for column in row + 1..entries.ncols() {
            let (upper, lower) = (entries[(row, column)], entries[(column, row)]);
            if (upper - lower).abs() > tolerance {
                return Err(Problem::NotSymmetric { row, column, upper, lower });
            }
        }
    }
    let symmetric = 0.5 * (entries + entries.transpose());
    let eigenvalue = symmetric.symmetric_eigenvalues().min();
    if eigenvalue < -tolerance { Err(Problem::Indefinite { eigenvalue }) } else { Ok(symmetric) }
}
