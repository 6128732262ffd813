//! Inverse iteration for nonlinear eigenproblems `P(λ)x = 0`. (M3)

use nalgebra::Complex;

use crate::math::lu::{ComplexDense, ComplexLu};
use crate::math::watch;

/// Nonlinear eigenproblem `P(λ)x = 0`.
pub(super) trait Nonlinear {
    /// `P(λ)`.
    fn at(&self, lambda: Complex<f64>) -> ComplexDense;

    /// Inner product of two motions, weighted by the masses.
    fn product(&self, a: &[Complex<f64>], b: &[Complex<f64>], lambda: Complex<f64>) -> Complex<f64>;
}

/// Eigenpair: `λ` (1/s) and the unknowns.
pub(super) type Pair = (Complex<f64>, Vec<Complex<f64>>);

/// Limit of steps of inverse iteration.
const INVERSE_ITERATIONS: usize = 30;
/// Relative change of an eigenvalue that is rounding.
const EIGENVALUE_ROUNDING: f64 = 1e-14;
/// Relative change accepted where rounding ends the progress.
const ACCEPTED_CHANGE: f64 = 1e-8;
/// Step of the difference quotient by `λ`, relative to `λ`: exact for polynomials of the second degree.
const STEP: f64 = 1e-4;

/// Share of an eigenvalue below which an imaginary part is rounding.
const IMAGINARY_ROUNDING: f64 = 1e-12;

/// Eigenpair that inverse iteration leads to; none without convergence. (M3)
pub(super) fn inverse_iteration(problem: &impl Nonlinear, (mut lambda, mut x): Pair) -> Option<Pair> {
    let mut best = f64::INFINITY;
    for step in 0..INVERSE_ITERATIONS {
        watch::ask();
        if !lambda.is_finite() {
            return None;
        }
        let factor = ComplexLu::new(&problem.at(lambda))?;
        let h = Complex::from(STEP * lambda.norm());
        let ahead = times(&problem.at(lambda + h), &x);
        let behind = times(&problem.at(lambda - h), &x);
        let right: Vec<[f64; 2]> = ahead
            .iter()
            .zip(&behind)
            .map(|(a, b)| (a - b) / (2.0 * h))
            .map(|value| [value.re, value.im])
            .collect();
        let Some(solved) = factor.solve(&right, 1) else {
            return Some((lambda, x));
        };
        let solved: Vec<Complex<f64>> = solved.iter().map(|[re, im]| Complex::new(*re, *im)).collect();
        let (before, after) = (problem.product(&x, &x, lambda), problem.product(&x, &solved, lambda));
        let change = before / after;
        if step > 0 {
            lambda -= change;
        }
        let length = problem.product(&solved, &solved, lambda).re.sqrt();
        x = solved.iter().map(|entry| entry / length).collect();
        let moved = change.norm() / lambda.norm();
        if step > 0 {
            if moved <= EIGENVALUE_ROUNDING || (moved >= 0.5 * best && best <= ACCEPTED_CHANGE) {
                return Some((lambda, x));
            }
            best = best.min(moved);
        }
    }
    None
}

/// True if a refined eigenvalue belongs to the mode that the iteration starts from.
pub(super) fn belongs(refined: Complex<f64>, start: Complex<f64>) -> bool {
    (refined - start).norm() < 0.5 * start.norm() && refined.im >= -IMAGINARY_ROUNDING * refined.norm()
}

fn times(P: &ComplexDense, x: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let entry = |row: usize, column: usize| {
        let [re, im] = P.at(row, column);
        Complex::new(re, im)
    };
    (0..x.len()).map(|row| (0..x.len()).map(|column| entry(row, column) * x[column]).sum()).collect()
}
