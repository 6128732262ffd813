//! Factors of large sparse symmetric positive definite matrices, and solutions with them.

mod analysis;
mod branch;
mod conjugate;
mod dense;
mod graph;
#[cfg(feature = "metis")]
mod metis;
mod numeric;
mod ordering;
mod permuted;
mod places;
mod postorder;
mod separators;
mod softest;
mod solution;
mod structure;
mod supernodes;
#[cfg(test)]
mod tests;
mod tree;
mod triangle;

pub use self::analysis::Analysis;
pub use self::conjugate::Refinement;
pub use self::ordering::Ordering;
pub(super) use self::softest::{refusal, verdict};
pub(super) use self::structure::Structure;
pub(super) use self::triangle::{Real, Triangle};

use self::conjugate::System;
use super::symmetric::Symmetric;

/// A matrix is singular or indefinite: along `direction` its quadratic form is not positive.
#[derive(Clone, Debug, PartialEq)]
pub struct NotPositive {
    /// A vector whose quadratic form is zero to rounding, or negative; largest entry ±1.
    pub direction: Vec<f64>,
}

/// Number format of the entries of a factor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Precision {
    /// Single above 300 000 unknowns if the matrix permits it, else double.
    #[default]
    Automatic,
    /// 64 bits.
    Double,
    /// 32 bits, half the time and memory; conjugate gradients make up the digits. Double if the matrix is too
    /// ill-conditioned for it.
    Single,
}

/// Method of a factorisation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Method {
    /// Number format of the factor.
    pub precision: Precision,
    /// Order of elimination.
    pub ordering: Ordering,
}

/// Cost of a factorisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorWork {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Stored entries of the factor.
    pub entries: usize,
    /// Multiplications of the factorisation.
    pub multiplications: f64,
    /// Format used, never [`Precision::Automatic`].
    pub precision: Precision,
    /// Order used, never [`Ordering::Automatic`].
    pub ordering: Ordering,
    /// Refinements of one solution, at most, when the factor was tried.
    pub iterations: usize,
}

/// Cholesky factor of a sparse symmetric matrix, scaled to a unit diagonal so that mixed units do no harm.
#[derive(Clone, Debug)]
pub struct Factor {
    matrix: Symmetric,
    scale: Vec<f64>,
    triangle: Stored,
    work: FactorWork,
}

#[derive(Clone, Debug)]
enum Stored {
    Nothing,
    Double(Triangle<f64>),
    Single(Triangle<f32>),
}

/// Unknowns above which a factor is stored in 32 bits.
const LARGE: usize = 300_000;
/// Residual of a solution, for a unit diagonal.
const RESIDUAL: f64 = 1e-14;
/// Refinements of one solution, at most.
const REFINEMENTS: usize = 100;
/// Residual of the solutions with which a factor in 32 bits is tried.
const TRIAL_RESIDUAL: f64 = 1e-6;
/// Refinements of a trial solution, at most; a full solution takes twice as many.
const TRIAL_REFINEMENTS: usize = 15;

impl Factor {
    /// Factors a symmetric positive definite matrix.
    ///
    /// # Errors
    /// [`NotPositive`] holds a direction in which the matrix is singular or indefinite.
    pub fn new(matrix: &Symmetric, method: Method) -> Result<Self, NotPositive> {
        Analysis::new(matrix, method.ordering)?.factor(method.precision)
    }

    fn triangle_of<T: Real>(&self, structure: &Structure) -> Option<Triangle<T>> {
        Triangle::new(structure.clone(), &self.matrix, &self.scale, 0.0)
    }

    /// Tries the factor on the softest direction; false if there is none or it does not solve the equations.
    fn holds(&mut self) -> Result<bool, NotPositive> {
        let mut most = 0;
        let holds = match &self.triangle {
            Stored::Nothing => Ok(false),
            Stored::Double(triangle) => verdict(&self.matrix, &self.scale, |x| {
                triangle.solve(x, 1);
                true
            }),
            Stored::Single(_) => verdict(&self.matrix, &self.scale, |x| {
                divide(x, &self.scale);
                let refinement = self.refined(x, 1, TRIAL_RESIDUAL, TRIAL_REFINEMENTS);
                divide(x, &self.scale);
                most = most.max(refinement.iterations);
                refinement.residual <= TRIAL_RESIDUAL
            }),
        };
        self.work.iterations = most;
        holds
    }

    /// Cost of the factorisation.
    #[must_use]
    pub fn work(&self) -> FactorWork {
        self.work
    }

    /// Solves in place for right-hand sides stored row by row, `width` to a row; returns iterations and residual.
    ///
    /// Solutions are refined until their residual is about 1e-14 of the right-hand side, each row in units of the
    /// root of its diagonal entry, or a few roundings of the solution, or falls no more.
    pub fn solve(&self, right: &mut [f64], width: usize) -> Refinement {
        if right.is_empty() || width == 0 {
            return Refinement { iterations: 0, residual: 0.0 };
        }
        self.refined(right, width, RESIDUAL, REFINEMENTS)
    }

    fn refined(&self, right: &mut [f64], width: usize, residual: f64, most: usize) -> Refinement {
        let times = |x: &[f64]| self.matrix.times_block(x, width);
        let precondition = |x: &mut [f64]| self.rough(x, width);
        let exact = !matches!(self.triangle, Stored::Single(_));
        let system = System { width, scale: &self.scale, times: &times, exact, precondition: &precondition };
        system.solve(right, residual, most)
    }

    /// `A⁻¹ r` to the precision of the factor, in place.
    fn rough(&self, right: &mut [f64], width: usize) {
        rescale(right, width, &self.scale);
        match &self.triangle {
            Stored::Nothing => {}
            Stored::Double(triangle) => triangle.solve(right, width),
            Stored::Single(triangle) => solve_single(triangle, right, width),
        }
        rescale(right, width, &self.scale);
    }
}

/// Solves in 32 bits, each right-hand side in units of its largest entry so that none leaves their range.
fn solve_single(triangle: &Triangle<f32>, right: &mut [f64], width: usize) {
    let mut units = vec![0.0_f64; width];
    for row in right.chunks_exact(width) {
        units.iter_mut().zip(row).for_each(|(unit, entry)| *unit = unit.max(entry.abs()));
    }
    units.iter_mut().filter(|unit| !(**unit > 0.0)).for_each(|unit| *unit = 1.0);
    let mut single: Vec<f32> = right
        .chunks_exact(width)
        .flatten()
        .zip(units.iter().cycle())
        .map(|(x, unit)| (x / unit) as f32)
        .collect();
    triangle.solve(&mut single, width);
    for ((x, single), unit) in right.iter_mut().zip(single).zip(units.iter().cycle()) {
        *x = f64::from(single) * unit;
    }
}

/// Factors that scale a matrix to a unit diagonal.
///
/// # Errors
/// [`NotPositive`] names the rows whose diagonal is not positive.
pub(super) fn unit_diagonal(diagonal: &[f64]) -> Result<Vec<f64>, NotPositive> {
    if diagonal.iter().any(|d| !(*d > 0.0)) {
        let direction = diagonal.iter().map(|d| f64::from(u8::from(!(*d > 0.0)))).collect();
        return Err(NotPositive { direction });
    }
    Ok(diagonal.iter().map(|d| d.sqrt().recip()).collect())
}

/// Each row of `width` numbers times its scale.
pub(super) fn rescale(rows: &mut [f64], width: usize, scale: &[f64]) {
    for (row, scale) in rows.chunks_exact_mut(width).zip(scale) {
        row.iter_mut().for_each(|entry| *entry *= scale);
    }
}

fn divide(x: &mut [f64], scale: &[f64]) {
    x.iter_mut().zip(scale).for_each(|(entry, scale)| *entry /= scale);
}
