//! Rows of a history as records of an attitude file: checked once, then gone through as often as a format needs.

use std::ops::ControlFlow;

use super::AttitudeRecord;
use super::error::Unwritten;
use super::written::Labels;
use crate::record::{Column, RecordError, Rows};

/// Columns that every attitude file needs, and those of the angular velocity.
const NEEDED: [&str; 5] = ["t", "qw", "qx", "qy", "qz"];
const RATES: [&str; 3] = ["wx", "wy", "wz"];

/// Whether a table has angular velocities.
pub fn has_rates(columns: &[Column]) -> bool {
    RATES.iter().all(|name| columns.iter().any(|column| column.name == *name))
}

/// Records of a history.
pub struct Records<'a> {
    rows: &'a dyn Rows,
    needed: [usize; 5],
    /// Places of the angular velocity; none where it is not there or not wanted.
    rates: Option<[usize; 3]>,
    /// Number of records.
    pub count: usize,
    /// Times (s) of the first and the last.
    pub ends: [f64; 2],
}

impl<'a> Records<'a> {
    /// The records of a table that can be written with these labels.
    pub fn of(columns: &[Column], rows: &'a dyn Rows, labels: &Labels) -> Result<Self, Unwritten> {
        let place = |name: &'static str| {
            columns.iter().position(|column| column.name == name).ok_or(Unwritten::Column { name })
        };
        let [t, w, x, y, z] = NEEDED.map(place);
        let needed = [t?, w?, x?, y?, z?];
        let rates = match RATES.map(place) {
            [Ok(x), Ok(y), Ok(z)] if labels.rates => Some([x, y, z]),
            _ => None,
        };
        let mut records = Self { rows, needed, rates, count: 0, ends: [f64::NAN; 2] };
        let (mut count, mut ends, mut before) = (0, [f64::NAN; 2], None);
        records.each(&mut |record| {
            let AttitudeRecord { t, attitude, angular_velocity } = record;
            let numbers = [t].into_iter().chain(attitude).chain(angular_velocity.unwrap_or_default());
            if !numbers.into_iter().all(f64::is_finite) {
                return Err(Unwritten::NotFinite { t });
            }
            let epoch = labels.at(t)?;
            if before.is_some_and(|before| before >= epoch) {
                return Err(Unwritten::Order { t, before: ends[1] });
            }
            before = Some(epoch);
            ends = [if count == 0 { t } else { ends[0] }, t];
            count += 1;
            Ok(())
        })?;
        if count == 0 {
            return Err(Unwritten::Empty);
        }
        (records.count, records.ends) = (count, ends);
        Ok(records)
    }

    /// Whether the records have an angular velocity.
    pub fn have_rates(&self) -> bool {
        self.rates.is_some()
    }

    /// Passes every record, in order; a receiver that fails ends it.
    pub fn each(
        &self,
        take: &mut dyn FnMut(AttitudeRecord) -> Result<(), Unwritten>,
    ) -> Result<(), Unwritten> {
        let mut failed = ControlFlow::Continue(());
        self.rows.each(&mut |row| {
            if failed.is_continue()
                && let Err(error) = take(self.record(row))
            {
                failed = ControlFlow::Break(error);
            }
            Ok::<(), RecordError>(())
        })?;
        match failed {
            ControlFlow::Break(error) => Err(error),
            ControlFlow::Continue(()) => Ok(()),
        }
    }

    /// The record of a row.
    pub fn record(&self, row: &[f64]) -> AttitudeRecord {
        let [t, attitude @ ..] = self.needed.map(|place| row[place]);
        AttitudeRecord {
            t,
            attitude,
            angular_velocity: self.rates.map(|places| places.map(|place| row[place])),
        }
    }

    /// The rows as they are.
    pub fn rows(&self) -> &'a dyn Rows {
        self.rows
    }
}
