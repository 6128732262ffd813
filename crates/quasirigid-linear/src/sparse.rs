//! Sparse matrices by rows, and the factorisation of the symmetric ones.

use std::ops::{AddAssign, Range};

/// Square sparse matrix of entries `T`, stored by rows, columns ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseRows<T> {
    starts: Vec<usize>,
    columns: Vec<usize>,
    entries: Vec<T>,
}

impl<T: Clone + AddAssign> SparseRows<T> {
    /// The `size × size` matrix that is the sum of these entries `(row, column, entry)`, added in the order given.
    #[must_use]
    pub fn sum(size: usize, mut parts: Vec<(usize, usize, T)>) -> Self {
        parts.sort_by_key(|(row, column, _)| (*row, *column));
        let mut matrix = Self { starts: vec![0; size + 1], columns: Vec::new(), entries: Vec::new() };
        let mut last = None;
        for (row, column, entry) in parts {
            if last == Some((row, column)) {
                if let Some(sum) = matrix.entries.last_mut() {
                    *sum += entry;
                }
            } else {
                matrix.columns.push(column);
                matrix.entries.push(entry);
                last = Some((row, column));
            }
            matrix.starts[row + 1] = matrix.columns.len();
        }
        for row in 0..size {
            matrix.starts[row + 1] = matrix.starts[row + 1].max(matrix.starts[row]);
        }
        matrix
    }

    /// The square block of a range of rows and columns.
    #[must_use]
    pub fn block(&self, range: Range<usize>) -> Self {
        let inside = self.iter().filter(|(row, column, _)| range.contains(row) && range.contains(column));
        let place = |(row, column, entry): (usize, usize, &T)| {
            (row - range.start, column - range.start, entry.clone())
        };
        Self::sum(range.len(), inside.map(place).collect())
    }
}

impl<T> SparseRows<T> {
    /// Number of rows and columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Entries of a row with their columns.
    #[inline]
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, &T)> {
        let range = self.starts[row]..self.starts[row + 1];
        self.columns[range.clone()].iter().copied().zip(&self.entries[range])
    }

    /// Every entry with its row and column.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, &T)> {
        (0..self.size()).flat_map(move |row| self.row(row).map(move |(column, entry)| (row, column, entry)))
    }
}

impl SparseRows<f64> {
    /// Every entry times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { entries: self.entries.iter().map(|entry| factor * entry).collect(), ..self.clone() }
    }

    /// The diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.size())
            .map(|row| self.row(row).find(|(column, _)| *column == row).map_or(0.0, |(_, entry)| *entry))
            .collect()
    }

    /// Product with a vector.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        (0..self.size()).map(|row| self.row(row).map(|(column, entry)| entry * x[column]).sum()).collect()
    }
}
