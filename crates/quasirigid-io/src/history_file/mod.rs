//! Histories of rotation that other programs wrote: times, angular velocities, perhaps attitudes, and how finely they are written.
//!
//! Columns are known by many spellings. What a file does not say, such as the unit of its rates or the order of its quaternion, is left open
//! here, and found by mechanics elsewhere.

mod arrays;
mod columns;
mod error;
mod names;
mod parquet;
mod resolution;

use std::path::Path;

pub use error::{HistoryFileError, HistoryFileProblem};
pub use resolution::Resolution;

use crate::attitude::{AttitudeHistory, read_attitude};
use crate::files_read::sha256;
use crate::record::InputFileRecord;
use crate::table_file::{BadLine, TableError, Unnumbered, read_numbers};
use crate::text_file::{FileError, Place, bytes_of, kind_of};
use columns::{Chosen, Column};
use error::Fault;

/// Largest file that is read (bytes): some ten million rows.
const MAX_FILE: u64 = 2 * 1024 * 1024 * 1024;

/// History of rotation, as a file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct HistoryFile {
    /// Times, ascending: in s where the file names their unit, else as they stand there.
    pub t: Vec<f64>,
    /// Components of the angular velocity: in rad/s where the file names their unit, else as they stand there; empty where the file has
    /// attitudes alone.
    pub rates: Vec<[f64; 3]>,
    /// Unit quaternions in the order of the columns; empty where there are none.
    pub attitude: Vec<[f64; 4]>,
    /// Place of the scalar in a quaternion, as far as the names of the columns tell.
    pub order: QuaternionOrder,
    /// Unit of the times, where the file names it.
    pub time_unit: Option<String>,
    /// Unit of the rates, where the file names it.
    pub rate_unit: Option<String>,
    /// SI value of that unit, or 1.
    pub rate_factor: f64,
    /// Resolution of the rates in the unit of the file.
    pub resolution: Resolution,
    /// Half of the last place of a part of a quaternion next to 1.
    pub attitude_rounding: f64,
    /// What the reader made of the file, where that is not plain.
    pub notes: Vec<String>,
}

/// Place of the scalar in a quaternion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuaternionOrder {
    /// The scalar stands first, as the names of the columns say.
    ScalarFirst,
    /// The columns have numbers alone.
    Unknown,
}

impl HistoryFile {
    /// Most by which rounding may have changed the rates of a row, in the unit of `rates`, of a file that has them.
    #[must_use]
    pub fn rounding(&self, row: usize) -> [f64; 3] {
        let factor = self.rate_factor;
        std::array::from_fn(|axis| self.resolution.error(self.rates[row][axis] / factor) * factor)
    }
}

/// The file of a history as answers name it: its name, length and SHA-256.
///
/// # Errors
/// As [`read_history`].
pub fn identity(file: &Path) -> Result<InputFileRecord, HistoryFileError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
    Ok(InputFileRecord { name, bytes: bytes.len() as u64, sha256: sha256(&bytes) })
}

/// Reads a history: a table in text, a Parquet file, an archive of NumPy arrays (also of Basilisk), or an attitude file (AEM, STK). It has
/// angular velocities, attitudes or both.
///
/// # Errors
/// [`HistoryFileError`] says what is wrong and on which line.
pub fn read_history(file: &Path) -> Result<HistoryFile, HistoryFileError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    let named = |ending: &str| file.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
    let beginning = bytes.trim_ascii_start();
    let stk = beginning.get(..6).is_some_and(|start| start.eq_ignore_ascii_case(b"stk.v."));
    if stk || beginning.starts_with(b"CCSDS_AEM_VERS") {
        return of_attitude(file);
    }
    let read = if bytes.starts_with(b"PAR1") || named("parquet") {
        parquet::read(file)
    } else if bytes.starts_with(b"PK\x03\x04") {
        arrays::read(&bytes)
    } else {
        of_text(file, &bytes)
    };
    read.map_err(FileError::new(file))
}

fn of_text(file: &Path, bytes: &[u8]) -> Result<HistoryFile, Fault> {
    let kind = kind_of(bytes);
    if kind != "text" {
        return Err((Place::File, HistoryFileProblem::Kind { kind }));
    }
    let (mut chosen, mut titles) = (None, Vec::new());
    let read = read_numbers(file, bytes, |table| {
        let found = Chosen::of(&table.names, &table.units)?;
        titles = found.indices.iter().map(|index| table.names[*index].clone()).collect();
        let indices = found.indices.clone();
        chosen = Some(found);
        Ok(indices)
    });
    let (columns, notes) = read.map_err(|error| match error {
        Unnumbered::Table(TableError::Empty { .. }) => (Place::File, HistoryFileProblem::Empty),
        Unnumbered::Table(error) => (Place::File, HistoryFileProblem::Table(error)),
        Unnumbered::Unwanted(problem) => (Place::File, problem),
        Unnumbered::Line(BadLine { line, column, found }) => {
            let problem = match column {
                Some(place) => {
                    HistoryFileProblem::Cell { name: titles[place].as_str().into(), found: found.into() }
                }
                None => HistoryFileProblem::Width { found },
            };
            (Place::Line(line), problem)
        }
    })?;
    let columns = columns.into_iter().map(|column| Column {
        resolution: Resolution::Decimal { decimals: column.decimals, significant: column.significant },
        values: column.values,
    });
    chosen.map_or(Err((Place::File, HistoryFileProblem::Empty)), |chosen| {
        chosen.history(columns.collect(), notes)
    })
}

/// Places behind the point of rates in degrees per second that are tried.
const PLACES: std::ops::Range<i32> = 0..16;
/// Rows by which those places are judged.
const JUDGED: usize = 1000;

fn of_attitude(file: &Path) -> Result<HistoryFile, HistoryFileError> {
    let fault = FileError::new(file);
    let read = read_attitude(file);
    let AttitudeHistory { t, attitude, angular_velocity, .. } = read
        .map_err(|FileError { place, problem, .. }| fault((place, HistoryFileProblem::Attitude(problem))))?;
    // both formats write degrees per second
    let factor = 1_f64.to_radians();
    let step = angular_velocity.len().div_ceil(JUDGED).max(1);
    let judged: Vec<f64> =
        angular_velocity.iter().step_by(step).flatten().map(|rate| rate / factor).collect();
    let places = PLACES.into_iter().find(|places| {
        let scale = 10_f64.powi(*places);
        judged.iter().all(|rate| {
            (rate * scale - (rate * scale).round()).abs() <= 1e-15 * (rate * scale).abs().max(1.0) * 16.0
        })
    });
    let resolution =
        places.map_or(Resolution::Double, |decimals| Resolution::Decimal { decimals, significant: 16 });
    let rate_unit = (!angular_velocity.is_empty()).then(|| "deg/s".to_owned());
    Ok(HistoryFile {
        t,
        rates: angular_velocity,
        attitude,
        order: QuaternionOrder::ScalarFirst,
        time_unit: Some("s".to_owned()),
        rate_unit,
        rate_factor: factor,
        resolution,
        attitude_rounding: Resolution::Double.error(1.0),
        notes: Vec::new(),
    })
}
