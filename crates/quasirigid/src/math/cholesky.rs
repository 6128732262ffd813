//! Factorisation of sparse symmetric positive definite matrices; the only file that names the sparse library.

use faer::prelude::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, Side};

use super::sparse::SparseRows;

/// Cholesky factor of a sparse symmetric matrix, scaled to a unit diagonal so that mixed units do no harm.
#[derive(Clone, Debug)]
pub struct Cholesky {
    scale: Vec<f64>,
    factor: Option<Llt<usize, f64>>,
}

/// A matrix is singular or indefinite: along `direction` its quadratic form is not positive.
#[derive(Clone, Debug, PartialEq)]
pub struct NotPositive {
    /// A vector whose quadratic form is zero to rounding, or negative; largest entry ±1.
    pub direction: Vec<f64>,
}

/// Quadratic forms below this, for a unit diagonal, are rounding.
const SINGULAR: f64 = 1e-13;
/// Shift that makes a singular matrix factorable when its null direction is looked for.
const SHIFT: f64 = 1e-11;
/// Steps of inverse iteration; each gains the ratio of the two smallest eigenvalues.
const INVERSE_ITERATIONS: usize = 8;

impl Cholesky {
    /// Factors a symmetric positive definite matrix.
    ///
    /// # Errors
    /// [`NotPositive`] holds a direction in which the matrix is singular or indefinite.
    pub fn new(matrix: &SparseRows<f64>) -> Result<Self, NotPositive> {
        let size = matrix.size();
        let diagonal = matrix.diagonal();
        if diagonal.iter().any(|d| !(*d > 0.0)) {
            let direction = diagonal.iter().map(|d| f64::from(u8::from(!(*d > 0.0)))).collect();
            return Err(NotPositive { direction });
        }
        let scale: Vec<f64> = diagonal.iter().map(|d| d.sqrt().recip()).collect();
        if size == 0 {
            return Ok(Self { scale, factor: None });
        }
        let cholesky = Self { factor: scaled_factor(matrix, &scale, 0.0), scale };
        let (form, direction) = cholesky.softest(matrix);
        if form > SINGULAR { Ok(cholesky) } else { Err(NotPositive { direction }) }
    }

    /// Solves in place for right-hand sides stored row by row, `width` to a row.
    pub fn solve(&self, right: &mut [f64], width: usize) {
        self.rescale(right, width);
        if let Some(factor) = &self.factor {
            factor.solve_in_place(MatMut::from_row_major_slice_mut(right, self.scale.len(), width));
        }
        self.rescale(right, width);
    }

    fn rescale(&self, rows: &mut [f64], width: usize) {
        for (row, scale) in rows.chunks_exact_mut(width).zip(&self.scale) {
            row.iter_mut().for_each(|entry| *entry *= scale);
        }
    }

    /// Smallest quadratic form of the scaled matrix over unit vectors, by inverse iteration, and the unscaled
    /// vector that has it.
    fn softest(&self, matrix: &SparseRows<f64>) -> (f64, Vec<f64>) {
        let shifted = self.factor.clone().or_else(|| scaled_factor(matrix, &self.scale, SHIFT));
        let Some(factor) = shifted else {
            return (f64::NEG_INFINITY, vec![1.0; self.scale.len()]);
        };
        let size = self.scale.len();
        let mut x: Vec<f64> = (0..size).map(|row| 1.0 + 0.5 * (row as f64).sin()).collect();
        for _ in 0..INVERSE_ITERATIONS {
            factor.solve_in_place(MatMut::from_row_major_slice_mut(&mut x, size, 1));
            let norm = x.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
            x.iter_mut().for_each(|entry| *entry /= norm);
        }
        let unscaled: Vec<f64> = x.iter().zip(&self.scale).map(|(entry, scale)| entry * scale).collect();
        let form = unscaled.iter().zip(matrix.times(&unscaled)).map(|(a, b)| a * b).sum();
        let largest = unscaled.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        (form, unscaled.iter().map(|entry| entry / largest).collect())
    }
}

fn scaled_factor(matrix: &SparseRows<f64>, scale: &[f64], shift: f64) -> Option<Llt<usize, f64>> {
    let lower: Vec<_> = matrix
        .iter()
        .filter(|(row, column, _)| row >= column)
        .map(|(row, column, entry)| {
            let diagonal = if row == column { shift } else { 0.0 };
            Triplet::new(row, column, entry * scale[row] * scale[column] + diagonal)
        })
        .collect();
    let sparse = SparseColMat::try_new_from_triplets(scale.len(), scale.len(), &lower).ok()?;
    sparse.sp_cholesky(Side::Lower).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tridiagonal(size: usize, end: f64) -> SparseRows<f64> {
        let mut parts = Vec::new();
        for row in 0..size {
            parts.push((row, row, if row == 0 { 1.0 + end } else { 2.0 }));
            if row > 0 {
                parts.push((row, row - 1, -1.0));
                parts.push((row - 1, row, -1.0));
            }
        }
        parts.push((size - 1, size - 1, -1.0));
        SparseRows::sum(size, parts)
    }

    #[test]
    fn solution_satisfies_the_equation() {
        let matrix = tridiagonal(40, 0.3);
        let factor = Cholesky::new(&matrix).unwrap();
        let right: Vec<f64> = (0..80).map(|i| (i as f64 * 0.7).cos()).collect();
        let mut x = right.clone();
        factor.solve(&mut x, 2);
        for column in 0..2 {
            let one: Vec<f64> = x.iter().skip(column).step_by(2).copied().collect();
            for (row, value) in matrix.times(&one).iter().enumerate() {
                assert!((value - right[2 * row + column]).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn a_chain_held_nowhere_moves_as_a_whole() {
        let direction = Cholesky::new(&tridiagonal(12, 0.0)).unwrap_err().direction;
        assert!(direction.iter().all(|entry| (entry.abs() - 1.0).abs() < 1e-9));
    }

    #[test]
    fn units_do_not_make_a_matrix_singular() {
        let entries = [1e-12, 1.0, 1e12].iter().enumerate().map(|(i, d)| (i, i, *d)).collect();
        assert!(Cholesky::new(&SparseRows::sum(3, entries)).is_ok());
    }

    /// A unit diagonal and the smallest eigenvalue `softness`, in units of its own for each row.
    fn pair(softness: f64) -> SparseRows<f64> {
        let units = [3e-6, 7e5];
        let entry = |row: usize, column: usize| {
            let share = if row == column { 1.0 } else { softness - 1.0 };
            (row, column, units[row] * units[column] * share)
        };
        SparseRows::sum(2, vec![entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)])
    }

    #[test]
    fn a_matrix_is_singular_below_the_line_and_not_above() {
        assert!(Cholesky::new(&pair(1.02e-13)).is_ok());
        for softness in [0.98e-13, 1e-15, 0.0, -1e-15] {
            let direction = Cholesky::new(&pair(softness)).expect_err("a singular matrix").direction;
            assert!((direction[0] - 1.0).abs() < 1e-9, "{softness:e}: {direction:?}");
            assert!((direction[1] / (3e-6 / 7e5) - 1.0).abs() < 1e-9, "{softness:e}: {direction:?}");
        }
    }
}
