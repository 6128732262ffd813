//! Linear equations of a Newton step for a steady state, with the displacements eliminated. (M6)

use nalgebra::{DMatrix, DVector};

use super::system::System;
use crate::math::eigen::Dense;
use crate::math::lu::Lu;

/// Share of the largest singular value below which others count as zero.
const SINGULAR: f64 = 1e-11;

/// Equations of moments and of the translation with the displacements eliminated.
pub(super) struct Reduced {
    pub left: DMatrix<f64>,
    pub right: DVector<f64>,
    /// `E⁻¹` of the unbalanced loads on the displacements, and of their columns.
    pub load: DVector<f64>,
    pub answers: DMatrix<f64>,
}

impl Reduced {
    pub fn of(system: &System, columns: &DMatrix<f64>, n: usize, elastic: usize) -> Option<Self> {
        let rows: Vec<usize> = (0..3).chain(3 + n..system.residual.len()).collect();
        let all = DVector::from_column_slice(&system.residual);
        let mut left = columns.select_rows(&rows);
        let mut right = all.select_rows(&rows);
        let width = columns.ncols();
        let mut answers = DMatrix::zeros(elastic, width);
        let mut load = DVector::zeros(elastic);
        if elastic > 0 {
            let mut held = Dense::zero(elastic);
            for j in 0..elastic {
                (0..elastic).for_each(|k| held.add(j, k, system.stiffness[(3 + j, 3 + k)]));
            }
            let side: Vec<f64> = (0..elastic)
                .flat_map(|j| {
                    let row = columns.row(3 + j).iter().copied().collect::<Vec<_>>();
                    row.into_iter().chain([all[3 + j]])
                })
                .collect();
            let solved =
                DMatrix::from_row_slice(elastic, width + 1, &Lu::new(&held)?.solve(&side, width + 1)?);
            answers.copy_from(&solved.columns(0, width));
            load.copy_from(&solved.column(width));
            let coupled = system.stiffness.columns(3, elastic).select_rows(&rows);
            left -= &coupled * &answers;
            right -= &coupled * &load;
        }
        Some(Self { left, right, load, answers })
    }
}

/// Shortest solution in the sense of least squares; columns after the first `own` are scaled to the size of those.
pub(super) fn least_squares(
    mut left: DMatrix<f64>,
    right: &DVector<f64>,
    own: usize,
) -> Option<DVector<f64>> {
    let size = left.columns(0, own).amax();
    let mut unit = 1.0;
    if own < left.ncols() {
        let other = left.columns(own, left.ncols() - own).amax();
        unit = if size > 0.0 && other > 0.0 { size / other } else { 1.0 };
        left.columns_mut(own, left.ncols() - own).scale_mut(unit);
    }
    let factors = left.svd(true, true);
    let least = SINGULAR * factors.singular_values.max();
    let mut x = factors.solve(right, least).ok()?;
    let others = x.len() - own;
    x.rows_mut(own, others).scale_mut(unit);
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the solutions of one equation the shortest shares it among its unknowns; what others are measured in does not matter.
    #[test]
    fn unknowns_of_any_unit_share_an_equation() {
        for unit in [1e-9, 1e-2, 1.0, 30.0, 1e7] {
            let left = DMatrix::from_row_slice(1, 2, &[3.0, 3.0 * unit]);
            let x = least_squares(left, &DVector::from_element(1, 12.0), 1).unwrap();
            assert!((x[0] - 2.0).abs() < 1e-12 && (x[1] * unit - 2.0).abs() < 1e-12, "{unit:e}: {x}");
        }
    }

    /// Unknowns without an effect stay at zero.
    #[test]
    fn an_unknown_that_does_nothing_is_left_alone() {
        let left = DMatrix::from_row_slice(1, 2, &[3.0, 0.0]);
        let x = least_squares(left, &DVector::from_element(1, 12.0), 1).unwrap();
        assert!((x[0] - 4.0).abs() < 1e-12 && x[1] == 0.0, "{x}");
    }
}
