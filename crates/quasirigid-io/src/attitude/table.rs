//! Histories as tables with the columns of our own, from any program.

use std::path::Path;

use super::error::{AttitudeProblem, Fault};
use super::{AttitudeHistory, AttitudeRecord};
use crate::table_file::{BodyTable, TableError, read_bodies};
use crate::text_file::Place;

/// Whether a file is a table, by its beginning or its ending.
pub fn begins(file: &Path, bytes: &[u8]) -> bool {
    let named = |ending| file.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
    bytes.starts_with(b"PAR1") || named("csv") || named("parquet")
}

/// Reads a table; the columns of the angular velocity may be missing, all three.
pub fn read(file: &Path) -> Result<AttitudeHistory, Fault> {
    let whole = |problem| (Place::File, problem);
    let table = read_bodies(file).map_err(|error| match error {
        TableError::Empty { .. } => whole(AttitudeProblem::Empty),
        other => whole(AttitudeProblem::Table(other)),
    })?;
    if let Some(reason) = table.unread.values().next() {
        return Err(whole(AttitudeProblem::Row { reason: reason.clone() }));
    }
    let columns = ["t", "qw", "qx", "qy", "qz", "wx", "wy", "wz"].map(|name| (name, table.column(name)));
    let (needed, rates) = columns.split_at(5);
    let missing = |(name, column): &(&'static str, Option<usize>)| column.is_none().then_some(*name);
    if let Some(name) = needed.iter().find_map(missing) {
        return Err(whole(AttitudeProblem::Column { name }));
    }
    let has_rates = rates.iter().any(|(_, column)| column.is_some());
    if let Some(name) = rates.iter().find_map(missing).filter(|_| has_rates) {
        return Err(whole(AttitudeProblem::Column { name }));
    }
    let mut history = AttitudeHistory::default();
    for row in 0..table.rows() {
        let mut numbers = [0.0; 8];
        for (number, (name, column)) in numbers.iter_mut().zip(columns) {
            if let Some(column) = column {
                *number = cell(&table, row, (name, column)).map_err(whole)?;
            }
        }
        let [t, w, x, y, z, rates @ ..] = numbers;
        let record =
            AttitudeRecord { t, attitude: [w, x, y, z], angular_velocity: has_rates.then_some(rates) };
        history.push(record).map_err(whole)?;
    }
    Ok(history)
}

fn cell(
    table: &BodyTable,
    row: usize,
    (name, column): (&'static str, usize),
) -> Result<f64, AttitudeProblem> {
    let text = table.columns[column][row].as_str();
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| AttitudeProblem::Cell { row: row + 1, name, found: text.into() })
}
