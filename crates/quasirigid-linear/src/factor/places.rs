//! Places of the rows of an update in the panel of a supernode above, as runs of rows that are neighbours in both.

use std::ops::Range;

use super::supernodes::Supernode;
use super::triangle::Real;

/// Places of some ascending rows among those of a panel, ascending too.
pub(super) struct Places {
    places: Vec<usize>,
    /// Last row of the run of each row, and one more.
    ends: Vec<usize>,
}

impl Places {
    /// Places of rows in the panel of a supernode that has them all.
    pub fn of(rows: &[usize], panel: Supernode<'_>) -> Self {
        let end = panel.columns().end;
        let mut below = panel.below.iter().zip(panel.width..);
        let place = |row: &usize| {
            if *row < end {
                return row - panel.start;
            }
            below.find(|(other, _)| *other == row).map_or(usize::MAX, |(_, place)| place)
        };
        let places: Vec<usize> = rows.iter().map(place).collect();
        let mut ends = vec![places.len(); places.len()];
        for row in (1..places.len()).rev() {
            ends[row - 1] = if places[row] == places[row - 1] + 1 { ends[row] } else { row };
        }
        Self { places, ends }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Place of a row.
    pub fn at(&self, row: usize) -> usize {
        self.places[row]
    }

    /// Rows whose places are less than one.
    pub fn before(&self, place: usize) -> usize {
        self.places.partition_point(|own| *own < place)
    }

    /// Adds an entry for each of some rows to a column of the panel, of which the first `above` rows are left out.
    pub fn add<T: Real>(&self, rows: Range<usize>, entries: &[T], column: &mut [T], above: usize) {
        self.runs(rows, entries, column, above, |sum, entry| *sum += entry);
    }

    /// Subtracts as [`Places::add`] adds.
    pub fn subtract<T: Real>(&self, rows: Range<usize>, entries: &[T], column: &mut [T], above: usize) {
        self.runs(rows, entries, column, above, |sum, entry| *sum -= entry);
    }

    #[inline]
    fn runs<T: Real>(
        &self,
        rows: Range<usize>,
        mut entries: &[T],
        column: &mut [T],
        above: usize,
        each: impl Fn(&mut T, T),
    ) {
        let mut row = rows.start;
        while row < rows.end {
            let end = self.ends[row].min(rows.end);
            let (own, others) = entries.split_at(end - row);
            let sums = &mut column[self.places[row] - above..][..own.len()];
            sums.iter_mut().zip(own).for_each(|(sum, entry)| each(sum, *entry));
            (row, entries) = (end, others);
        }
    }
}
