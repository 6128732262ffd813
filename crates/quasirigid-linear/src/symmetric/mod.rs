//! Large sparse symmetric matrices, assembled from the matrices of elements.

mod error;
mod pattern;
mod strip;

use std::sync::Arc;

pub use self::error::SymmetricError;
pub use self::pattern::Pattern;
use self::strip::{Strip, strips};
use super::sparse::SparseRows;
use super::threads::Team;

/// Sparse symmetric matrix: the entries of its lower triangle on a pattern that several matrices may share.
///
/// A clone shares the entries until one of the two changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Symmetric {
    pattern: Arc<Pattern>,
    entries: Arc<Vec<f64>>,
}

impl Symmetric {
    /// Zero on a pattern.
    #[must_use]
    pub fn zero(pattern: Arc<Pattern>) -> Self {
        Self { entries: Arc::new(vec![0.0; pattern.places()]), pattern }
    }

    /// Adds the matrix of an element, row-major, one row for each of `unknowns`; a constrained unknown is `None`.
    ///
    /// Only the half of `element` on and below the diagonal of the whole matrix is read.
    ///
    /// # Errors
    /// [`SymmetricError`] if the element matrix has the wrong size or an entry has no place; the matrix may then hold
    /// a part of the element.
    pub fn add(&mut self, unknowns: &[Option<u32>], element: &[f64]) -> Result<(), SymmetricError> {
        let entries = Arc::make_mut(&mut self.entries);
        let mut whole = Strip { pattern: &self.pattern, columns: 0..u32::MAX, first: 0, entries };
        whole.add(unknowns, element)
    }

    /// Adds the matrices of elements, shared among threads; the sums have the bits of [`Symmetric::add`] one element after another.
    ///
    /// # Errors
    /// As of [`Symmetric::add`].
    pub fn add_all(
        &mut self,
        elements: &[(&[Option<u32>], &[f64])],
        team: &Team,
    ) -> Result<(), SymmetricError> {
        let strips =
            strips(&self.pattern, Arc::make_mut(&mut self.entries).as_mut_slice(), elements, team.size());
        let added = team.map(strips, |mut strip| {
            elements.iter().try_for_each(|(unknowns, element)| strip.add(unknowns, element))
        });
        added.into_iter().collect()
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// The pattern.
    #[must_use]
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// Entries in the order of the pattern.
    #[must_use]
    pub fn entries(&self) -> &[f64] {
        &self.entries
    }

    /// Rows on and below the diagonal of a column, with their entries.
    #[inline]
    pub fn column(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.pattern.starts()[column]..self.pattern.starts()[column + 1];
        let rows = self.pattern.rows()[range.clone()].iter().map(|row| *row as usize);
        rows.zip(self.entries[range].iter().copied())
    }

    /// Product with a vector.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size()];
        for (column, own) in x.iter().enumerate().take(self.size()) {
            let mut sum = 0.0;
            for (row, entry) in self.column(column) {
                if row == column {
                    sum += entry * own;
                } else {
                    product[row] += entry * own;
                    sum += entry * x[row];
                }
            }
            product[column] += sum;
        }
        product
    }

    /// Product with vectors stored row by row, `width` to a row.
    #[must_use]
    pub fn times_block(&self, x: &[f64], width: usize) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        for column in 0..self.size() {
            let own = &x[column * width..][..width];
            for (row, entry) in self.column(column) {
                let (upper, lower) = product.split_at_mut(row * width);
                lower.iter_mut().zip(own).for_each(|(sum, x)| *sum += entry * x);
                if row != column {
                    let other = &x[row * width..][..width];
                    upper[column * width..].iter_mut().zip(other).for_each(|(sum, x)| *sum += entry * x);
                }
            }
        }
        product
    }

    /// Every entry times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let entries = self.entries.iter().map(|entry| factor * entry).collect();
        Self { pattern: Arc::clone(&self.pattern), entries: Arc::new(entries) }
    }

    /// `A + s B` for a matrix `B` on the same pattern.
    ///
    /// # Errors
    /// [`SymmetricError::Patterns`] if the patterns differ.
    pub fn plus(&self, share: f64, other: &Self) -> Result<Self, SymmetricError> {
        if !Arc::ptr_eq(&self.pattern, &other.pattern) && self.pattern != other.pattern {
            return Err(SymmetricError::Patterns { left: self.size(), right: other.size() });
        }
        let entries = self.entries.iter().zip(other.entries.iter()).map(|(a, b)| a + share * b).collect();
        Ok(Self { pattern: Arc::clone(&self.pattern), entries: Arc::new(entries) })
    }

    /// The diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        let starts = &self.pattern.starts()[..self.size()];
        starts.iter().map(|place| self.entries[*place]).collect()
    }

    /// Largest sum of absolute values in a row, which no eigenvalue exceeds.
    #[must_use]
    pub fn norm(&self) -> f64 {
        let mut sums = vec![0.0; self.size()];
        for column in 0..self.size() {
            for (row, entry) in self.column(column) {
                sums[row] += entry.abs();
                if row != column {
                    sums[column] += entry.abs();
                }
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }
}

impl From<&SparseRows<f64>> for Symmetric {
    /// The lower triangle of a matrix whose upper triangle is its mirror image.
    fn from(matrix: &SparseRows<f64>) -> Self {
        let upper = |row: usize| matrix.row(row).filter(move |(column, _)| *column > row);
        let pattern = Pattern::of_columns(matrix.size(), |row, rows| {
            rows.push(row as u32);
            rows.extend(upper(row).map(|(column, _)| column as u32));
        });
        let diagonal = matrix.diagonal();
        let entries = (0..matrix.size())
            .flat_map(|row| [diagonal[row]].into_iter().chain(upper(row).map(|(_, entry)| *entry)));
        Self { entries: Arc::new(entries.collect()), pattern: Arc::new(pattern) }
    }
}
