//! Extremes of a long table: of each interval of rows, those rows in which some column is lowest or highest. They are rows of the table,
//! so that a curve through them is its true envelope.

use super::super::Column;

/// Most rows of a table that are kept whole.
pub const MOST_ROWS: u64 = 100_000;
/// Intervals of a longer one.
const INTERVALS: u64 = 1_000;

/// Rows of a table as they come: all of a short one, the extremes of a long one.
#[derive(Clone, Debug)]
pub struct Extremes {
    columns: Vec<Column>,
    /// Rows of an interval; one of a table that is kept whole.
    interval: u64,
    rows: u64,
    /// The lowest and the highest row of each column in this interval, with its number.
    found: Vec<[(u64, Vec<f64>); 2]>,
}

impl Extremes {
    /// Of a table with these columns, whose values are ignored, and so many rows in all.
    #[must_use]
    pub fn new(columns: &[Column], rows: u64) -> Self {
        let empty = |column: &Column| Column { values: Vec::new(), ..column.clone() };
        Self {
            columns: columns.iter().map(empty).collect(),
            interval: if rows > MOST_ROWS { rows.div_ceil(INTERVALS) } else { 1 },
            rows: 0,
            found: Vec::new(),
        }
    }

    /// Takes the next row.
    pub fn push(&mut self, row: &[f64]) {
        self.rows += 1;
        if self.is_whole() {
            self.keep(row);
            return;
        }
        if self.found.is_empty() {
            let first = || (self.rows, row.to_vec());
            self.found = row.iter().map(|_| [first(), first()]).collect();
        }
        for (column, [lowest, highest]) in self.found.iter_mut().enumerate() {
            let value = row[column];
            if value < lowest.1[column] || lowest.1[column].is_nan() {
                replace(lowest, self.rows, row);
            }
            if value > highest.1[column] || highest.1[column].is_nan() {
                replace(highest, self.rows, row);
            }
        }
        if self.rows.is_multiple_of(self.interval) {
            self.close();
        }
    }

    /// Whether every row is kept.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.interval == 1
    }

    /// Rows taken so far.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Passes the rows kept, in order.
    ///
    /// # Errors
    /// Those of the receiver.
    pub fn each<E>(&self, mut take: impl FnMut(&[f64]) -> Result<(), E>) -> Result<(), E> {
        let rows = self.columns.first().map_or(0, |column| column.values.len());
        let row = |place: usize| self.columns.iter().map(move |column| column.values[place]);
        (0..rows).try_for_each(|place| take(&row(place).collect::<Vec<_>>()))
    }

    /// The columns with the rows kept.
    #[must_use]
    pub fn into_columns(mut self) -> Vec<Column> {
        self.close();
        self.columns
    }

    fn close(&mut self) {
        let mut rows: Vec<(u64, Vec<f64>)> = self.found.drain(..).flatten().collect();
        rows.sort_by_key(|(number, _)| *number);
        rows.dedup_by_key(|(number, _)| *number);
        rows.iter().for_each(|(_, row)| self.keep(row));
    }

    fn keep(&mut self, row: &[f64]) {
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(*value));
    }
}

fn replace(slot: &mut (u64, Vec<f64>), number: u64, row: &[f64]) {
    slot.0 = number;
    slot.1.copy_from_slice(row);
}
