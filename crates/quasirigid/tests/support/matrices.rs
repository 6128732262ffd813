//! Matrices of a body in other formats.

use nalgebra::DMatrix;
use quasirigid_math::sparse::SparseRows;

/// A matrix over the coordinates of a body, written out.
pub fn dense(matrix: &SparseRows<f64>) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(matrix.size(), matrix.size());
    matrix.iter().for_each(|(row, column, entry)| dense[(row, column)] += entry);
    dense
}
