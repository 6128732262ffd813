//! Compliance of a body, and the difference between two of them.

use nalgebra::{Matrix6, MatrixXx6};

use crate::math::sym3;
use crate::model::FlexibleBody;

/// Products of the spin in the order xx, yy, zz, yz, zx, xy.
const PRODUCTS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];
/// Share of the largest compliance below which a product of the spin takes negligible power beside others.
const FAINT: f64 = 1e-3;

/// Static compliance on the products of the spin: half its form is the elastic energy.
pub(crate) fn of(body: &FlexibleBody) -> Matrix6<f64> {
    let J1: Vec<[[f64; 3]; 3]> = body.invariants().J1.iter().map(|J1| sym3::rows(*J1)).collect();
    let loads = MatrixXx6::from_fn(J1.len(), |j, product| {
        let [a, b] = PRODUCTS[product];
        if a == b { 0.5 * J1[j][a][b] } else { J1[j][a][b] }
    });
    let mut answers: Vec<f64> =
        (0..J1.len()).flat_map(|j| (0..6).map(move |k| (j, k))).map(|at| loads[at]).collect();
    body.solve_stiffness(&mut answers, 6);
    let answers = MatrixXx6::from_row_slice(&answers);
    Matrix6::from_fn(|i, j| loads.column(i).dot(&answers.column(j)))
}

/// Largest difference of the energies at any products of the spin, over the energy of the first. (G12)
pub(crate) fn gap(one: &Matrix6<f64>, other: &Matrix6<f64>) -> f64 {
    let floor = FAINT * one.symmetric_eigenvalues().max();
    let Some(factor) = (one + floor * Matrix6::identity()).cholesky() else { return f64::INFINITY };
    let l = factor.l();
    let half = l.solve_lower_triangular(&(other - one)).unwrap_or_else(|| Matrix6::repeat(f64::INFINITY));
    let whole = l.solve_lower_triangular(&half.transpose());
    let found = whole
        .map_or(f64::INFINITY, |whole| (0.5 * (whole + whole.transpose())).symmetric_eigenvalues().amax());
    if found.is_finite() { found } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_is_that_of_the_worst_product_that_matters() {
        let one = Matrix6::from_diagonal(&[1.0, 2.0, 4.0, 1e-6, 1.0, 1.0].into());
        let mut other = one;
        other[(1, 1)] *= 1.3;
        other[(3, 3)] *= 2.0;
        let expected = 0.6 / 2.004;
        assert!((gap(&one, &other) - expected).abs() < 1e-12);
        other[(1, 1)] = f64::NAN;
        assert_eq!(gap(&one, &other), f64::INFINITY);
    }
}
