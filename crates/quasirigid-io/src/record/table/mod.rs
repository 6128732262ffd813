//! Tables of histories on disk: rows of numbers in four formats, read and written row by row, so that a table of any length needs little
//! memory.

mod csv;
mod extremes;
mod npz;
mod parquet;
mod rows;

use std::fs::File;
use std::io::{BufWriter, Cursor, Seek, Write};
use std::path::Path;

pub use csv::{history_csv, log_csv};
pub use extremes::{Extremes, MOST_ROWS};
pub(crate) use npz::{Array, write_arrays};
pub use rows::{RowLog, RowTable};

use super::folder::{check_lengths, unusable};
use super::{Column, RecordError};
use crate::model::Named;

/// Format of the tables of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TableFormat {
    /// Parquet: binary, compressed, units in its metadata.
    Parquet,
    /// CSV: text with the fewest digits that read back bit for bit.
    Csv,
    /// NPZ: an archive of one NumPy array for each column.
    Npz,
}

impl TableFormat {
    /// All of them, in the order in which a reader looks for them.
    pub const ALL: [Self; 3] = [Self::Parquet, Self::Csv, Self::Npz];

    /// Ending of the names of files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        self.name()
    }

    /// The table of columns of equal length as the bytes of a file; what went into it, a text in JSON, is told in files of Parquet and NPZ.
    ///
    /// # Errors
    /// [`RecordError::Ragged`], and [`RecordError::Table`] for columns that the format cannot hold.
    pub fn bytes(self, columns: &Vec<Column>, inputs: Option<&str>) -> Result<Vec<u8>, RecordError> {
        let name = format!("table.{}", self.ending());
        check_lengths(&name, columns)?;
        let mut out = Cursor::new(Vec::new());
        self.fill(Path::new(&name), &mut out, (columns, inputs), columns)?;
        Ok(out.into_inner())
    }

    /// Writes the rows of a log, row by row or column by column, so that they need no room in memory.
    ///
    /// # Errors
    /// [`RecordError::File`], of the log or of `out`, and [`RecordError::Table`] for columns that the format cannot hold.
    pub fn copy_log(
        self,
        out: &mut (impl Write + Seek + Send),
        (columns, inputs): (&[Column], Option<&str>),
        log: &RowTable,
    ) -> Result<(), RecordError> {
        self.fill(Path::new(&format!("table.{}", self.ending())), out, (columns, inputs), log)
    }

    /// Writes a table into a new file.
    pub(super) fn write(
        self,
        file: &Path,
        (columns, inputs): (&[Column], Option<&str>),
        rows: &dyn Rows,
    ) -> Result<(), RecordError> {
        let new = File::create_new(file).map_err(|error| unusable(file, &error))?;
        let mut out = BufWriter::new(new);
        self.fill(file, &mut out, (columns, inputs), rows)?;
        out.flush().map_err(|error| unusable(file, &error))
    }

    fn fill(
        self,
        file: &Path,
        out: &mut (impl Write + Seek + Send),
        (columns, inputs): (&[Column], Option<&str>),
        rows: &dyn Rows,
    ) -> Result<(), RecordError> {
        match self {
            _ if columns.is_empty() => Ok(()),
            Self::Parquet => parquet::write(file, out, (columns, inputs), rows),
            Self::Csv => csv::write(file, out, columns, rows),
            Self::Npz => npz::write(file, out, (columns, inputs), rows),
        }
    }

    /// Reads a table row by row.
    pub(super) fn read(self, file: &Path, columns: &[Column], take: Take<'_>) -> Result<(), RecordError> {
        match self {
            Self::Parquet | Self::Npz if columns.is_empty() => Ok(()),
            Self::Parquet => parquet::read(file, columns, take),
            Self::Csv => csv::read(file, columns, take),
            Self::Npz => npz::read(file, columns, take),
        }
    }
}

impl Named for TableFormat {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("csv", Self::Csv, "text with every digit"),
        ("parquet", Self::Parquet, "binary and compressed, units in its metadata"),
        ("npz", Self::Npz, "one NumPy array for each column"),
    ];
}

/// Receiver of rows; one that fails ends the reading.
pub(super) type Take<'a> = &'a mut dyn FnMut(&[f64]) -> Result<(), RecordError>;

/// Rows that can be gone through again and again.
pub(crate) trait Rows {
    /// Passes every row, in order; a receiver that fails ends it.
    fn each(&self, take: &mut dyn FnMut(&[f64]) -> Result<(), RecordError>) -> Result<(), RecordError>;
}

impl Rows for Vec<Column> {
    fn each(&self, take: &mut dyn FnMut(&[f64]) -> Result<(), RecordError>) -> Result<(), RecordError> {
        let rows = self.first().map_or(0, |column| column.values.len());
        let mut row = vec![0.0; self.len()];
        for place in 0..rows {
            row.iter_mut().zip(self).for_each(|(number, column)| *number = column.values[place]);
            take(&row)?;
        }
        Ok(())
    }
}
