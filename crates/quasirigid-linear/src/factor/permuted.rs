//! The lower triangle of a matrix, scaled, shifted and with its unknowns in the order of elimination.

use super::triangle::Real;
use crate::symmetric::Symmetric;

/// Entries by columns, rows in no order.
pub(super) struct Permuted<T> {
    starts: Vec<usize>,
    rows: Vec<u32>,
    entries: Vec<T>,
}

impl<T: Real> Permuted<T> {
    /// `P (S A S + s 1) Pᵀ`, where `places` has the place of each unknown in the order of elimination.
    pub fn new(matrix: &Symmetric, places: &[usize], scale: &[f64], shift: f64) -> Self {
        let mut starts = vec![0; matrix.size() + 1];
        let each = || {
            (0..matrix.size())
                .flat_map(|column| matrix.column(column).map(move |(row, entry)| (row, column, entry)))
        };
        each().for_each(|(row, column, _)| starts[places[row].min(places[column]) + 1] += 1);
        (0..matrix.size()).for_each(|column| starts[column + 1] += starts[column]);
        let mut next = starts.clone();
        let mut rows = vec![0; matrix.entries().len()];
        let mut entries = vec![T::rounded(0.0); rows.len()];
        for (row, column, entry) in each() {
            let shift = if row == column { shift } else { 0.0 };
            let (a, b) = (places[row], places[column]);
            let place = &mut next[a.min(b)];
            rows[*place] = a.max(b) as u32;
            entries[*place] = T::rounded(entry * scale[row] * scale[column] + shift);
            *place += 1;
        }
        Self { starts, rows, entries }
    }

    /// Rows and entries of a column.
    pub fn column(&self, column: usize) -> impl Iterator<Item = (usize, T)> {
        let range = self.starts[column]..self.starts[column + 1];
        let rows = self.rows[range.clone()].iter().map(|row| *row as usize);
        rows.zip(self.entries[range].iter().copied())
    }
}

/// Bytes of a permuted matrix.
pub(super) fn bytes<T>(size: usize, entries: usize) -> usize {
    entries * (size_of::<T>() + size_of::<u32>()) + 2 * size * size_of::<usize>()
}
