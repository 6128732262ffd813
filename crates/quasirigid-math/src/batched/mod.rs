//! Batched eigenvalues: those of many small dense matrices, eight side by side in lanes.
//! Balancing, Householder's reduction to Hessenberg form and Francis's QR iteration, in which each lane has shifts, blocks and deflations of its
//! own, so that a matrix gives the same bits in any lane, beside any others and alone. (M11)

mod balancing;
mod hessenberg;
mod matrices;
mod qr;

use crate::eigen::{self, Dense, NoConvergence};
use crate::lanes::{LANES, Lanes};
use crate::simd::{Arithmetic, Rounding, Task, dispatch_lanes};
use matrices::Matrices;

/// Eigenvalues of a matrix as pairs (real part, imaginary part); complex ones in conjugate pairs.
pub type Eigenvalues = Result<Vec<[f64; 2]>, NoConvergence>;

/// Eigenvalues of each of many matrices, in no particular order. (M11)
///
/// They are those of matrices that differ from the given ones by rounding, relative to the norm after balancing. Matrices of one size that
/// follow each other are solved together. A matrix whose iteration does not end, or whose eigenvalues have not its first two moments, is left
/// to [`eigen::eigenvalues`], whose bits are the processor's also where [`Rounding::Reproducible`] is asked for.
///
/// # Errors
/// [`NoConvergence`] of a matrix that neither solver solves, as one with an entry that is not finite.
///
/// # Example
/// ```
/// use quasirigid_math::{batched, eigen::Dense, simd::Rounding};
///
/// let mut oscillator = Dense::zero(2);
/// oscillator.add(0, 1, 1.0);
/// oscillator.add(1, 0, -4.0);
/// let values = batched::eigenvalues(&[oscillator], Rounding::Reproducible);
/// assert_eq!(values, [Ok(vec![[0.0, 2.0], [0.0, -2.0]])]);
/// ```
#[must_use]
pub fn eigenvalues(matrices: &[Dense], rounding: Rounding) -> Vec<Eigenvalues> {
    let mut all = Vec::with_capacity(matrices.len());
    for alike in matrices.chunk_by(|a, b| a.size() == b.size()) {
        let found = dispatch_lanes(rounding, Batch { matrices: alike }).into_iter().zip(alike);
        all.extend(found.map(|(found, matrix)| found.map_or_else(|| eigen::eigenvalues(matrix), Ok)));
    }
    all
}

/// Matrices of one size.
struct Batch<'a> {
    matrices: &'a [Dense],
}

impl Task for Batch<'_> {
    type Output = Vec<Option<Vec<[f64; 2]>>>;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Self::Output {
        let mut all = Vec::with_capacity(self.matrices.len());
        for eight in self.matrices.chunks(LANES) {
            all.extend(together::<A>(eight));
        }
        all
    }
}

/// Eigenvalues of up to eight matrices of one size; none of those left to the general solver.
#[inline(always)]
fn together<A: Arithmetic>(matrices: &[Dense]) -> impl Iterator<Item = Option<Vec<[f64; 2]>>> {
    let mut all = Matrices::of(matrices);
    let unit = all.normalize();
    balancing::balance::<A>(&mut all);
    let unit = unit * all.normalize();
    let moments = Moments::of::<A>(&all);
    hessenberg::reduce::<A>(&mut all);
    let found = qr::eigenvalues::<A>(&mut all);
    let count = matrices.len();
    found.into_iter().enumerate().take(count).map(move |(lane, values)| {
        let values = values.filter(|values| moments.agree(lane, values))?;
        // the sum with zero has no negative zero
        let scaled = |[re, im]: [f64; 2]| [re * unit.0[lane] + 0.0, im * unit.0[lane] + 0.0];
        Some(values.into_iter().map(scaled).collect())
    })
}

/// First two moments of the eigenvalues, the traces of a matrix and of its square, and the sum of the squares of the entries.
struct Moments {
    size: usize,
    first: Lanes,
    second: Lanes,
    squares: Lanes,
}

/// Roundings per row by which the moments of eigenvalues may differ from those of the matrix; five are the most seen in a hundred thousand.
const ROUNDINGS: f64 = 64.0;

impl Moments {
    #[inline(always)]
    fn of<A: Arithmetic>(matrices: &Matrices) -> Self {
        let size = matrices.size();
        let zero = Lanes::splat(0.0);
        let mut moments = Self { size, first: zero, second: zero, squares: zero };
        for row in 0..size {
            moments.first = moments.first + matrices.at(row, row);
            for column in 0..size {
                let entry = matrices.at(row, column);
                moments.second = entry.mul_add::<A>(matrices.at(column, row), moments.second);
                moments.squares = entry.mul_add::<A>(entry, moments.squares);
            }
        }
        moments
    }

    /// Whether eigenvalues have the moments of the matrix in a lane, up to rounding.
    fn agree(&self, lane: usize, values: &[[f64; 2]]) -> bool {
        let allowed = ROUNDINGS * self.size as f64 * f64::EPSILON;
        let squares = self.squares.0[lane];
        let first: f64 = values.iter().map(|[re, _]| re).sum();
        let second: f64 = values.iter().map(|[re, im]| (re - im) * (re + im)).sum();
        (first - self.first.0[lane]).abs() <= allowed * squares.sqrt()
            && (second - self.second.0[lane]).abs() <= allowed * squares
    }
}

#[cfg(test)]
mod tests;
