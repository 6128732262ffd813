//! Sparse matrices by rows, and the factorisation of the symmetric ones.

use std::ops::{AddAssign, Range};

/// Square sparse matrix of entries `T`, stored by rows, columns ascending.
///
/// Where few rows have entries these alone are stored: thousands of dampers, each a matrix of the whole body, would take room that grows
/// with the square of their number.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseRows<T> {
    size: usize,
    /// The rows with entries, ascending; none where every row is stored.
    rows: Option<Vec<usize>>,
    /// Where each stored row starts among the entries, and the end of the last.
    starts: Vec<usize>,
    columns: Vec<usize>,
    entries: Vec<T>,
}

/// Rows for each one with entries, from which only these are stored.
const ROWS_PER_FILLED_ROW: usize = 4;

impl<T: Clone + AddAssign> SparseRows<T> {
    /// The `size × size` matrix that is the sum of these entries `(row, column, entry)`, added in the order given.
    #[must_use]
    pub fn sum(size: usize, mut parts: Vec<(usize, usize, T)>) -> Self {
        parts.sort_by_key(|(row, column, _)| (*row, *column));
        let mut filled: Vec<usize> = parts.iter().map(|(row, ..)| *row).collect();
        filled.dedup();
        let rows = (filled.len() * ROWS_PER_FILLED_ROW < size).then_some(filled);
        let count = rows.as_ref().map_or(size, Vec::len);
        let mut matrix =
            Self { size, rows, starts: vec![0; count + 1], columns: Vec::new(), entries: Vec::new() };
        let (mut last, mut place) = (None, 0);
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
            place = match &matrix.rows {
                Some(rows) if rows[place] != row => place + 1,
                Some(_) => place,
                None => row,
            };
            matrix.starts[place + 1] = matrix.columns.len();
        }
        for row in 0..count {
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
        self.size
    }

    /// Entries of a row with their columns.
    #[inline]
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, &T)> {
        let range = match &self.rows {
            None => self.starts[row]..self.starts[row + 1],
            Some(rows) => {
                rows.binary_search(&row).map_or(0..0, |place| self.starts[place]..self.starts[place + 1])
            }
        };
        self.columns[range.clone()].iter().copied().zip(&self.entries[range])
    }

    /// Every entry with its row and column.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, &T)> {
        let row_at = move |place: usize| self.rows.as_ref().map_or(place, |rows| rows[place]);
        (0..self.starts.len() - 1).flat_map(move |place| {
            let (row, range) = (row_at(place), self.starts[place]..self.starts[place + 1]);
            let entries = self.columns[range.clone()].iter().zip(&self.entries[range]);
            entries.map(move |(column, entry)| (row, *column, entry))
        })
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

    /// `xᵀ A x`.
    #[must_use]
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        self.times(x).iter().zip(x).map(|(image, x)| image * x).sum()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Entries of the same rows in a matrix that stores them all, and in a larger one that stores few rows.
    #[test]
    fn few_rows_are_stored_alone_and_read_the_same() {
        let parts = vec![(5, 2, 1.5), (1, 5, -2.0), (5, 5, 4.0), (1, 5, 0.5), (1, 1, 3.0)];
        let [dense, few] = [6, 60].map(|size| SparseRows::sum(size, parts.clone()));
        assert!(dense.rows.is_none() && few.rows.as_deref() == Some(&[1, 5]) && few.starts.len() == 3);
        let expected = [(1, 1, 3.0), (1, 5, -1.5), (5, 2, 1.5), (5, 5, 4.0)];
        for matrix in [&dense, &few] {
            let found: Vec<_> = matrix.iter().map(|(row, column, entry)| (row, column, *entry)).collect();
            assert_eq!(found, expected);
            for row in 0..matrix.size() {
                let of_row: Vec<_> = matrix.row(row).map(|(column, entry)| (row, column, *entry)).collect();
                assert_eq!(of_row, expected.into_iter().filter(|entry| entry.0 == row).collect::<Vec<_>>());
            }
            let x: Vec<f64> = (0..matrix.size()).map(|i| 1.0 + i as f64).collect();
            let product = matrix.times(&x);
            assert_eq!(
                (product[1], product[5], product[0]),
                (3.0 * 2.0 - 1.5 * 6.0, 1.5 * 3.0 + 4.0 * 6.0, 0.0)
            );
            assert_eq!(matrix.diagonal()[..6], [0.0, 3.0, 0.0, 0.0, 0.0, 4.0]);
            assert_eq!(matrix.scaled(2.0).row(5).map(|(_, entry)| *entry).collect::<Vec<_>>(), [3.0, 8.0]);
        }
        assert_eq!(few.size(), 60);
        assert_eq!(
            few.block(1..6),
            SparseRows::sum(5, vec![(0, 0, 3.0), (0, 4, -1.5), (4, 1, 1.5), (4, 4, 4.0)])
        );
        assert_eq!(SparseRows::<f64>::sum(3, Vec::new()).iter().count(), 0);
    }
}
