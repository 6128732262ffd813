//! Eigenvalues with right and left vectors, refined by two-sided inverse iteration.
//! Vectors come from the pencil itself, not from a solver on a product of matrices, whose rounding is that of the fastest mode.

use nalgebra::Complex;

use super::linear_part::LinearPart;
use crate::eigen::Dense;
use crate::lu::{ComplexDense, ComplexLu};

/// Eigenvalue `λ` of `A₀x = λM₀x` with its vectors: `A₀x = λM₀x`, `ℓᵀA₀ = λℓᵀM₀`.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenpair {
    /// Eigenvalue `λ`, real and imaginary part.
    pub lambda: [f64; 2],
    /// Right vector `x`.
    pub right: Vec<[f64; 2]>,
    /// Left vector `ℓ`, not conjugated, with `ℓᵀM₀x = 1`.
    pub left: Vec<[f64; 2]>,
}

pub(super) type Vector = Vec<Complex<f64>>;

/// Iterations: the convergence is cubic.
const ITERATIONS: usize = 6;
/// Relative change of the eigenvalue at which the iteration ends.
const CONVERGED: f64 = 4.0 * f64::EPSILON;
/// Size of an eigenvalue that is zero, over the fastest rate of the system.
const ZERO_EIGENVALUE: f64 = 1e-6;
/// Distance of the shift from the eigenvalue, relative to the size of the eigenvalue, so that the pencil can be factored.
const OFFSET: f64 = 1e-13;

impl Eigenpair {
    /// Pair of the complex conjugate eigenvalue.
    #[must_use]
    pub fn conjugate(&self) -> Self {
        let conjugate = |vector: &[[f64; 2]]| vector.iter().map(|[re, im]| [*re, -im]).collect();
        let [re, im] = self.lambda;
        Self { lambda: [re, -im], right: conjugate(&self.right), left: conjugate(&self.left) }
    }

    /// Pair with the right vector times a complex factor.
    #[must_use]
    pub fn scaled(&self, [re, im]: [f64; 2]) -> Self {
        let factor = Complex::new(re, im);
        let times = |vector: &[[f64; 2]], factor: Complex<f64>| {
            pairs(&complex(vector).map(|x| x * factor).collect::<Vec<_>>())
        };
        Self { lambda: self.lambda, right: times(&self.right, factor), left: times(&self.left, factor.inv()) }
    }
}

/// Two-sided inverse iteration with the Rayleigh quotient `ℓᵀA₀x/ℓᵀM₀x`.
pub(super) fn two_sided(linear: &LinearPart, [re, im]: [f64; 2], right: &[[f64; 2]]) -> Option<Eigenpair> {
    let (mass, slope) = (&linear.mass, &linear.slope);
    let real = im == 0.0;
    let mut lambda = Complex::new(re, im);
    let mut x: Vector = complex(right).collect();
    let mut left: Vector = linear
        .scales
        .iter()
        .enumerate()
        .map(|(i, scale)| Complex::from((1.0 + 0.5 * (i as f64).sin()) / scale))
        .collect();
    let fastest = fastest(linear);
    for _ in 0..ITERATIONS {
        let size = lambda.norm().max(ZERO_EIGENVALUE * fastest);
        let shift = lambda
            + if real { Complex::from(OFFSET * size) } else { Complex::new(OFFSET * size, OFFSET * size) };
        let pencil = linear.pencil(shift);
        x = normalized(solved(&pencil, &times(mass, &x, false))?, &linear.scales);
        left = normalized(solved(&transposed(&pencil), &times(mass, &left, true))?, &[]);
        let next = product(&left, &times(slope, &x, false)) / product(&left, &times(mass, &x, false));
        let moved = (next - lambda).norm();
        lambda = if real { Complex::from(next.re) } else { next };
        if !moved.is_finite() {
            return None;
        }
        if moved <= CONVERGED * size {
            break;
        }
    }
    let unit = product(&left, &times(mass, &x, false));
    let left: Vector = left.iter().map(|entry| entry / unit).collect();
    let finite = left.iter().chain(&x).all(|entry| entry.re.is_finite() && entry.im.is_finite());
    finite.then(|| Eigenpair { lambda: [lambda.re, lambda.im], right: pairs(&x), left: pairs(&left) })
}

/// Upper estimate of the rates of a system: the largest entry of each row of `A₀` over that of `M₀`, components in their scales.
fn fastest(linear: &LinearPart) -> f64 {
    let size = linear.state.len();
    let largest = |matrix: &Dense, row: usize| {
        (0..size).map(|k| (matrix.at(row, k) * linear.scales[k]).abs()).fold(0.0, f64::max)
    };
    (0..size).map(|row| largest(&linear.slope, row) / largest(&linear.mass, row)).fold(0.0, f64::max)
}

/// Vector of complex numbers of pairs.
pub(super) fn complex(pairs: &[[f64; 2]]) -> impl Iterator<Item = Complex<f64>> + '_ {
    pairs.iter().map(|[re, im]| Complex::new(*re, *im))
}

/// Pairs of complex numbers.
pub(super) fn pairs(vector: &[Complex<f64>]) -> Vec<[f64; 2]> {
    vector.iter().map(|entry| [entry.re, entry.im]).collect()
}

/// Product of two vectors without conjugation.
pub(super) fn product(a: &[Complex<f64>], b: &[Complex<f64>]) -> Complex<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Real matrix, or its transpose, times a complex vector.
pub(super) fn times(matrix: &Dense, x: &[Complex<f64>], transposed: bool) -> Vector {
    let size = x.len();
    let entry =
        |row: usize, column: usize| if transposed { matrix.at(column, row) } else { matrix.at(row, column) };
    (0..size).map(|row| (0..size).map(|column| x[column] * entry(row, column)).sum()).collect()
}

fn transposed(matrix: &ComplexDense) -> ComplexDense {
    let size = matrix.size();
    let mut transposed = ComplexDense::zero(size);
    (0..size * size).for_each(|k| transposed.add(k % size, k / size, matrix.at(k / size, k % size)));
    transposed
}

fn solved(matrix: &ComplexDense, right: &[Complex<f64>]) -> Option<Vector> {
    Some(complex(&ComplexLu::new(matrix)?.solve(&pairs(right), 1)?).collect())
}

/// Vector of size one, components measured in their scales.
fn normalized(x: Vector, scales: &[f64]) -> Vector {
    let scale = |i: usize| scales.get(i).copied().unwrap_or(1.0);
    let size = x.iter().enumerate().fold(0.0_f64, |sum, (i, entry)| sum.hypot(entry.norm() / scale(i)));
    x.iter().map(|entry| entry / size).collect()
}
