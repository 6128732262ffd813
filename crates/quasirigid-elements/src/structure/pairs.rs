//! Pairs of coordinates `j ≤ k`, numbered: the rows of quantities of second order.

use nalgebra::DMatrix;

/// Pairs of so many coordinates.
pub(super) struct Pairs(pub usize);

impl Pairs {
    pub fn count(&self) -> usize {
        self.0 * (self.0 + 1) / 2
    }

    pub fn iter(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.0).flat_map(|j| (j..self.0).map(move |k| (j, k)))
    }

    /// Symmetric matrix with these entries.
    pub fn symmetric(&self, entries: impl Iterator<Item = f64>) -> DMatrix<f64> {
        let mut form = DMatrix::zeros(self.0, self.0);
        for ((j, k), entry) in self.iter().zip(entries) {
            form[(j, k)] = entry;
            form[(k, j)] = entry;
        }
        form
    }
}
