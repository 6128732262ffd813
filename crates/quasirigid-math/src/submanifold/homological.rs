//! Homological equation of one monomial: the linear system for a coefficient of the manifold and of the motion on it.
//! Bordered by the masters whose motion keeps the monomial, so that a near resonance inside costs no digits; singular where the monomial
//! resonates with a mode left out.

use nalgebra::Complex;

use super::eigenpair::{Vector, complex, pairs, times};
use super::linear_part::LinearPart;
use crate::lu::{ComplexDense, ComplexLu};

/// Border of the homological equation: columns `M₀V` of unknown coefficients of the motion, rows of conditions on the manifold.
#[derive(Clone, Debug)]
pub(super) struct Border {
    /// `M₀v`.
    pub column: Vector,
    /// `M₀ᵀℓ`, or the gradient of the conserved quantity.
    pub row: Vector,
}

impl Border {
    /// Border of a master mode: no part of a higher coefficient along the mode.
    pub fn of_mode(linear: &LinearPart, right: &[[f64; 2]], left: &[[f64; 2]]) -> Self {
        let (right, left): (Vector, Vector) = (complex(right).collect(), complex(left).collect());
        Self { column: times(&linear.mass, &right, false), row: times(&linear.mass, &left, true) }
    }
}

/// Solves `(sM₀ − A₀)W + Σ M₀v R = right`, `ℓᵀM₀W = levels`: the coefficient `W`, then the `R` of each border; none where singular. (W4)
pub(super) fn solve(
    linear: &LinearPart,
    s: Complex<f64>,
    borders: &[&Border],
    right: &[Complex<f64>],
    levels: &[Complex<f64>],
) -> Option<(Vector, Vector)> {
    let size = right.len();
    let whole = size + borders.len();
    let mut matrix = ComplexDense::zero(whole);
    for row in 0..size {
        for column in 0..size {
            let (mass, slope) = (linear.mass.at(row, column), linear.slope.at(row, column));
            if mass != 0.0 || slope != 0.0 {
                matrix.add(row, column, [s.re * mass - slope, s.im * mass]);
            }
        }
    }
    for (k, border) in borders.iter().enumerate() {
        for i in 0..size {
            matrix.add(i, size + k, [border.column[i].re, border.column[i].im]);
            matrix.add(size + k, i, [border.row[i].re, border.row[i].im]);
        }
    }
    let all: Vector = right.iter().chain(levels).copied().collect();
    let solved: Vector = complex(&ComplexLu::new(&matrix)?.solve(&pairs(&all), 1)?).collect();
    let (W, R) = solved.split_at(size);
    Some((W.to_vec(), R.to_vec()))
}
