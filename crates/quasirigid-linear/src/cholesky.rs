//! Factorisation of sparse symmetric positive definite matrices stored by rows.

use super::factor::{Ordering, Structure, Triangle, refusal, rescale, unit_diagonal, verdict};
use super::sparse::SparseRows;
use super::symmetric::Symmetric;

pub use super::factor::NotPositive;

/// Cholesky factor of a sparse symmetric matrix, scaled to a unit diagonal so that mixed units do no harm.
///
/// Solutions are not refined: the refinement of a [`super::factor::Factor`] for the last digits of large bodies costs too
/// much where equations of motion are solved at every step.
#[derive(Clone, Debug)]
pub struct Cholesky {
    scale: Vec<f64>,
    factor: Option<Triangle<f64>>,
}

impl Cholesky {
    /// Factors a symmetric positive definite matrix.
    ///
    /// # Errors
    /// [`NotPositive`] holds a direction in which the matrix is singular or indefinite.
    pub fn new(matrix: &SparseRows<f64>) -> Result<Self, NotPositive> {
        let scale = unit_diagonal(&matrix.diagonal())?;
        if scale.is_empty() {
            return Ok(Self { scale, factor: None });
        }
        let matrix = Symmetric::from(matrix);
        let Some(structure) = Structure::new(&matrix, Ordering::Automatic) else {
            return Err(NotPositive { direction: vec![1.0; scale.len()] });
        };
        let Some(factor) = Triangle::new(structure.clone(), &matrix, &scale, 0.0) else {
            return Err(refusal(&matrix, &structure, &scale));
        };
        verdict(&matrix, &scale, |x| {
            factor.solve(x, 1);
            true
        })?;
        Ok(Self { scale, factor: Some(factor) })
    }

    /// Solves in place for right-hand sides stored row by row, `width` to a row.
    pub fn solve(&self, right: &mut [f64], width: usize) {
        rescale(right, width, &self.scale);
        if let Some(factor) = &self.factor {
            factor.solve(right, width);
        }
        rescale(right, width, &self.scale);
    }
}
