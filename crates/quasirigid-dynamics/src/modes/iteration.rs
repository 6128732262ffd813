//! Inverse iteration for nonlinear eigenproblems `P(λ)x = 0`. (M3)

use nalgebra::Complex;

use crate::math::lu::{ComplexDense, ComplexLu};
use crate::math::watch;

/// Nonlinear eigenproblem `P(λ)x = 0`.
pub(super) trait Nonlinear {
    /// `P(λ)x`.
    fn times(&self, lambda: Complex<f64>, x: &[Complex<f64>]) -> Vec<Complex<f64>>;

    /// Solution of `P(λ)x = right`.
    fn solve(&self, lambda: Complex<f64>, right: &[Complex<f64>]) -> Solution;

    /// Weights of the unknowns by the masses, in the inner product of motions.
    fn weights(&self, lambda: Complex<f64>) -> Vec<f64>;
}

/// Solution of a linear system.
pub(super) enum Solution {
    /// The matrix has no factors.
    None,
    /// The matrix is singular.
    Singular,
    Found(Vec<Complex<f64>>),
}

impl Solution {
    /// Solution with a dense matrix.
    pub fn dense(P: &ComplexDense, right: &[Complex<f64>]) -> Self {
        let Some(factor) = ComplexLu::new(P) else { return Self::None };
        let right: Vec<[f64; 2]> = right.iter().map(|value| [value.re, value.im]).collect();
        let complex = |found: Vec<[f64; 2]>| found.iter().map(|[re, im]| Complex::new(*re, *im)).collect();
        factor.solve(&right, 1).map_or(Self::Singular, |found| Self::Found(complex(found)))
    }
}

/// Inner product of two motions.
pub(super) fn product(weights: &[f64], a: &[Complex<f64>], b: &[Complex<f64>]) -> Complex<f64> {
    weights.iter().zip(a.iter().zip(b)).map(|(weight, (a, b))| *weight * a.conj() * b).sum()
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

/// Relative difference below which eigenpairs are one.
const SAME_PAIR: f64 = 1e-6;
/// Share of an eigenvalue below which an imaginary part is rounding.
const IMAGINARY_ROUNDING: f64 = 1e-12;

/// Eigenpair that inverse iteration leads to; none without convergence. (M3)
pub(super) fn inverse_iteration(problem: &dyn Nonlinear, start: Pair) -> Option<Pair> {
    iterated(problem, start, 0)
}

/// Eigenpair that inverse iteration leads to from one that is nearly exact.
pub(super) fn polished(problem: &dyn Nonlinear, start: Pair) -> Option<Pair> {
    iterated(problem, start, 1)
}

/// Eigenpair that inverse iteration leads to from the eigenvalue that a shape has: the root of `xᴴP(λ)x` next to a start, which materials with
/// memory move far from that of the equations of motion. The part of the shape along a mode that it must not lead to is taken out. None where it
/// leads further from that root than from zero.
fn by_shape(problem: &dyn Nonlinear, (mut lambda, mut x): Pair, taken: Option<&Pair>) -> Option<Pair> {
    let ones = vec![1.0; x.len()];
    if let Some((_, taken)) = taken {
        let weights = problem.weights(lambda);
        let share = product(&weights, taken, &x) / product(&weights, taken, taken);
        x.iter_mut().zip(taken).for_each(|(x, taken)| *x -= share * taken);
    }
    let form = |lambda: Complex<f64>| product(&ones, &x, &problem.times(lambda, &x));
    for _ in 0..INVERSE_ITERATIONS {
        let h = Complex::from(STEP * lambda.norm());
        let change = form(lambda) * 2.0 * h / (form(lambda + h) - form(lambda - h));
        lambda -= change;
        if !lambda.is_finite() {
            return None;
        }
        if change.norm() <= ACCEPTED_CHANGE * lambda.norm() {
            return inverse_iteration(problem, (lambda, x)).filter(|(found, _)| belongs(*found, lambda));
        }
    }
    None
}

/// Eigenpair of a motion that is none of those known: what it was refined to, else what its shape leads to, apart from the one that it was led to.
pub(super) fn apart_from(
    known: &[Pair],
    problem: &dyn Nonlinear,
    start: &Pair,
    refined: Option<Pair>,
) -> Option<Pair> {
    let taken = |pair: &Pair| known.iter().find(|other| same(pair, other));
    let led = refined.as_ref().and_then(taken);
    if led.is_none() && refined.is_some() {
        return refined;
    }
    by_shape(problem, start.clone(), led).filter(|pair| taken(pair).is_none())
}

/// Whether two eigenpairs are one.
fn same((lambda, x): &Pair, (other, y): &Pair) -> bool {
    let ones = vec![1.0; x.len()];
    let alike = product(&ones, x, y).norm_sqr();
    let parallel = alike >= (1.0 - SAME_PAIR) * product(&ones, x, x).re * product(&ones, y, y).re;
    (lambda - other).norm() < SAME_PAIR * lambda.norm() && parallel
}

/// Inverse iteration whose first step, numbered zero, leaves the eigenvalue as it is.
fn iterated(problem: &dyn Nonlinear, (mut lambda, mut x): Pair, first: usize) -> Option<Pair> {
    let mut best = f64::INFINITY;
    for step in first..INVERSE_ITERATIONS {
        watch::ask();
        if !lambda.is_finite() {
            return None;
        }
        let h = Complex::from(STEP * lambda.norm());
        let (ahead, behind) = (problem.times(lambda + h, &x), problem.times(lambda - h, &x));
        let right: Vec<_> = ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * h)).collect();
        let solved = match problem.solve(lambda, &right) {
            Solution::None => return None,
            Solution::Singular => return Some((lambda, x)),
            Solution::Found(solved) => solved,
        };
        let weights = problem.weights(lambda);
        let (before, after) = (product(&weights, &x, &x), product(&weights, &x, &solved));
        let change = before / after;
        if step > 0 {
            lambda -= change;
        }
        let weights = problem.weights(lambda);
        let length = product(&weights, &solved, &solved).re.sqrt();
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

/// `P x` of a dense matrix.
pub(super) fn times(P: &ComplexDense, x: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let entry = |row: usize, column: usize| {
        let [re, im] = P.at(row, column);
        Complex::new(re, im)
    };
    (0..x.len()).map(|row| (0..x.len()).map(|column| entry(row, column) * x[column]).sum()).collect()
}
