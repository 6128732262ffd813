//! The rows of a history, or of the evolution, as CSV.

use std::fmt::Write as _;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use csv::{ByteRecord, ReaderBuilder, Writer};

use super::super::folder::unusable;
use super::super::{Column, RecordError};
use super::{RowTable, Rows, Take};
use crate::disk::open_regular;
use crate::table_file::{guarded, unguarded};

/// Writes the columns of a history, or of the evolution, as CSV: a header of names, then one line per row.
///
/// Numbers are printed with the fewest digits that read back bit for bit; those that are not finite as `NaN`, `inf`,
/// `-inf`. No columns make an empty file. A spreadsheet takes no name for a formula.
///
/// # Errors
/// [`ErrorKind::InvalidInput`] if the columns differ in length, before anything is written; otherwise what `out`
/// reports, a closed pipe included.
pub fn history_csv(columns: &[Column], out: impl Write) -> io::Result<()> {
    let rows = columns.first().map_or(0, |column| column.values.len());
    if columns.iter().any(|column| column.values.len() != rows) {
        return Err(ErrorKind::InvalidInput.into());
    }
    let Some(mut lines) = Lines::new(columns, out)? else { return Ok(()) };
    for row in 0..rows {
        lines.push(columns.iter().map(|column| column.values[row]))?;
    }
    lines.out.flush()
}

/// Writes the rows of a log as [`history_csv`] writes columns.
///
/// # Errors
/// What `out` reports, a closed pipe included, or the file of the log.
pub fn log_csv(columns: &[Column], log: &RowTable, out: impl Write) -> io::Result<()> {
    write(Path::new("table.csv"), out, columns, log).map_err(|error| match error {
        RecordError::File { kind, .. } => kind.into(),
        other => io::Error::other(other),
    })
}

/// Writes rows into a file.
pub fn write(file: &Path, out: impl Write, columns: &[Column], rows: &dyn Rows) -> Result<(), RecordError> {
    let failed = |error: io::Error| unusable(file, &error);
    let Some(mut lines) = Lines::new(columns, out).map_err(failed)? else { return Ok(()) };
    rows.each(&mut |row| lines.push(row.iter().copied()).map_err(failed))?;
    lines.out.flush().map_err(failed)
}

/// Lines of a table under the header of its names.
struct Lines<W: Write> {
    out: Writer<W>,
    digits: String,
}

impl<W: Write> Lines<W> {
    /// Writes the header; none of a table without columns.
    fn new(columns: &[Column], out: W) -> io::Result<Option<Self>> {
        if columns.is_empty() {
            return Ok(None);
        }
        let mut out = Writer::from_writer(out);
        out.write_record(columns.iter().map(|column| guarded(&column.name).into_owned())).map_err(cause)?;
        Ok(Some(Self { out, digits: String::new() }))
    }

    fn push(&mut self, row: impl Iterator<Item = f64>) -> io::Result<()> {
        for number in row {
            self.digits.clear();
            write!(self.digits, "{number:?}").expect("a String takes any text");
            self.out.write_field(&self.digits).map_err(cause)?;
        }
        self.out.write_record(None::<&[u8]>).map_err(cause)
    }
}

/// The error of the file that the CSV writer wraps into one of its own.
fn cause(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        _ => ErrorKind::InvalidInput.into(),
    }
}

/// Reads the rows of a file whose header is the names of the columns.
pub fn read(file: &Path, columns: &[Column], take: Take<'_>) -> Result<(), RecordError> {
    let unreadable = |error: csv::Error| unusable(file, &cause(error));
    let input = open_regular(file).map_err(|error| unusable(file, &error))?;
    let mut reader = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(input);
    let mut line = ByteRecord::new();
    reader.read_byte_record(&mut line).map_err(unreadable)?;
    check_header(columns, &line, file)?;
    let mut row = vec![0.0; columns.len()];
    while reader.read_byte_record(&mut line).map_err(unreadable)? {
        let place = line.position().map_or(0, csv::Position::line);
        if line.len() != columns.len() {
            return Err(RecordError::Width {
                file: file.into(),
                line: place,
                fields: line.len(),
                expected: columns.len(),
            });
        }
        for ((value, column), field) in row.iter_mut().zip(columns).zip(&line) {
            *value = number(field).ok_or_else(|| RecordError::NotANumber {
                file: file.into(),
                line: place,
                column: column.name.clone(),
                text: String::from_utf8_lossy(field).into(),
            })?;
        }
        take(&row)?;
    }
    Ok(())
}

fn check_header(columns: &[Column], header: &ByteRecord, file: &Path) -> Result<(), RecordError> {
    let expected: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    let found: Vec<String> =
        header.iter().map(|name| unguarded(&String::from_utf8_lossy(name)).into_owned()).collect();
    if found == expected { Ok(()) } else { Err(RecordError::Header { file: file.into(), expected, found }) }
}

fn number(field: &[u8]) -> Option<f64> {
    std::str::from_utf8(field).ok()?.parse().ok()
}
