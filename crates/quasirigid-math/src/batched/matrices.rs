//! Eight square matrices of one size, side by side.

use crate::eigen::Dense;
use crate::lanes::Lanes;

/// Square matrices in lanes, by rows, with a row and a column of zeros at the end, which reflections of three rows may take beside the last two.
pub(super) struct Matrices {
    size: usize,
    entries: Vec<Lanes>,
}

impl Matrices {
    /// Up to eight matrices; zeros in the lanes that are left.
    #[inline(always)]
    pub fn of(matrices: &[Dense]) -> Self {
        let size = matrices.first().map_or(0, Dense::size);
        let mut all = Self { size, entries: vec![Lanes::splat(0.0); (size + 1) * (size + 1)] };
        for row in 0..size {
            for column in 0..size {
                let mut entry = Lanes::splat(0.0);
                for (lane, matrix) in matrices.iter().enumerate() {
                    entry.0[lane] = matrix.at(row, column);
                }
                all.set(row, column, entry);
            }
        }
        all
    }

    /// Divides each matrix by the power of two that brings its largest entry to between one and two; with these powers.
    #[inline(always)]
    pub fn normalize(&mut self) -> Lanes {
        let largest = self.entries.iter().fold(Lanes::splat(0.0), |largest, entry| entry.abs().max(largest));
        let unit = largest.map(power_of_two);
        let inverse = unit.map(f64::recip);
        self.entries.iter_mut().for_each(|entry| *entry = *entry * inverse);
        unit
    }

    /// Number of rows and columns.
    #[inline(always)]
    pub fn size(&self) -> usize {
        self.size
    }

    /// An entry in every lane.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> Lanes {
        self.entries[row * (self.size + 1) + column]
    }

    /// Replaces an entry in every lane.
    #[inline(always)]
    pub fn set(&mut self, row: usize, column: usize, entry: Lanes) {
        self.entries[row * (self.size + 1) + column] = entry;
    }

    /// Rows from one on, and the length of each.
    #[inline(always)]
    pub fn rows_mut(&mut self, from: usize) -> std::slice::ChunksExactMut<'_, Lanes> {
        self.entries[from * (self.size + 1)..].chunks_exact_mut(self.size + 1)
    }
}

/// Largest power of two that is at most a number and has an inverse; one for zero.
fn power_of_two(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    let power = f64::from_bits(number.to_bits() & EXPONENT);
    if number == 0.0 { 1.0 } else { power.clamp(f64::MIN_POSITIVE, 0.25 / f64::MIN_POSITIVE) }
}
