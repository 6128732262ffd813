//! The rows of a history, or of the evolution, as CSV.

use std::fmt::Write as _;
use std::io::{self, ErrorKind, Read, Write};
use std::path::Path;

use csv::{ByteRecord, ReaderBuilder, Writer};

use super::{Column, RecordError};

/// Writes the columns of a history, or of the evolution, as CSV: a header of names, then one line per row.
///
/// Numbers are printed with the fewest digits that read back bit for bit; those that are not finite as `NaN`, `inf`,
/// `-inf`. No columns make an empty file.
///
/// # Errors
/// [`ErrorKind::InvalidInput`] if the columns differ in length, before anything is written; otherwise what `out`
/// reports, a closed pipe included.
pub fn history_csv(columns: &[Column], out: impl Write) -> io::Result<()> {
    let Some(first) = columns.first() else {
        return Ok(());
    };
    let rows = first.values.len();
    if columns.iter().any(|column| column.values.len() != rows) {
        return Err(ErrorKind::InvalidInput.into());
    }
    let mut writer = Writer::from_writer(out);
    writer.write_record(columns.iter().map(|column| &column.name)).map_err(cause)?;
    let mut digits = String::new();
    for row in 0..rows {
        for column in columns {
            digits.clear();
            write!(digits, "{:?}", column.values[row]).expect("a String takes any text");
            writer.write_field(&digits).map_err(cause)?;
        }
        writer.write_record(None::<&[u8]>).map_err(cause)?;
    }
    writer.flush()
}

/// The error of the file that the CSV writer wraps into one of its own.
fn cause(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        _ => ErrorKind::InvalidInput.into(),
    }
}

/// Fills the columns with the rows of a CSV file, whose header must be their names.
pub(super) fn read_rows(columns: &mut [Column], input: impl Read, file: &Path) -> Result<(), RecordError> {
    let unreadable = |error: csv::Error| RecordError::File { file: file.into(), kind: cause(error).kind() };
    let mut reader = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(input);
    let mut row = ByteRecord::new();
    reader.read_byte_record(&mut row).map_err(unreadable)?;
    check_header(columns, &row, file)?;
    while reader.read_byte_record(&mut row).map_err(unreadable)? {
        let line = row.position().map_or(0, csv::Position::line);
        if row.len() != columns.len() {
            return Err(RecordError::Width {
                file: file.into(),
                line,
                fields: row.len(),
                expected: columns.len(),
            });
        }
        for (column, field) in columns.iter_mut().zip(&row) {
            let value = number(field).ok_or_else(|| RecordError::NotANumber {
                file: file.into(),
                line,
                column: column.name.clone(),
                text: String::from_utf8_lossy(field).into(),
            })?;
            column.values.push(value);
        }
    }
    Ok(())
}

fn check_header(columns: &[Column], header: &ByteRecord, file: &Path) -> Result<(), RecordError> {
    let expected: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    let found: Vec<String> = header.iter().map(|name| String::from_utf8_lossy(name).into()).collect();
    if found == expected { Ok(()) } else { Err(RecordError::Header { file: file.into(), expected, found }) }
}

fn number(field: &[u8]) -> Option<f64> {
    std::str::from_utf8(field).ok()?.parse().ok()
}
