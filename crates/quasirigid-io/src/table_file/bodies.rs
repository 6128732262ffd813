//! Tables of bodies: one row each, all values as texts, from CSV or Parquet.
//! A row that cannot be read is kept with its reason, so that one bad line in a million loses one answer and not the run.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::TableError;
use super::formula::unguarded;
use super::parquet::undamaged;
use crate::text_file::unpacked_limit;

/// Table of bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyTable {
    /// Names of the columns.
    pub names: Vec<String>,
    /// Texts of each column, one for each row; empty where there is no value.
    pub columns: Vec<Vec<String>>,
    /// Rows that could not be read, by index from 0, each with the reason.
    pub unread: BTreeMap<usize, String>,
}

impl BodyTable {
    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    fn of(names: impl Iterator<Item = String>) -> Self {
        let names: Vec<String> = names.collect();
        Self { columns: vec![Vec::new(); names.len()], names, unread: BTreeMap::new() }
    }

    fn unread(&mut self, reason: String) {
        self.unread.insert(self.rows(), reason);
        self.columns.iter_mut().for_each(|column| column.push(String::new()));
    }
}

/// Reads a table, as Parquet if its name ends so, and as CSV with a header otherwise.
///
/// # Errors
/// [`TableError`] for a file that cannot be read, and for one without rows.
pub fn read_bodies(file: &Path) -> Result<BodyTable, TableError> {
    let parquet = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("parquet"));
    let table = if parquet { of_parquet(file)? } else { of_csv(file)? };
    if table.rows() == 0 {
        return Err(TableError::Empty { file: file.to_owned() });
    }
    let same = |(index, name): &(usize, &String)| table.names[..*index].contains(name);
    match table.names.iter().enumerate().find(same) {
        Some((_, name)) => Err(TableError::SameName { file: file.to_owned(), name: name.clone() }),
        None => Ok(table),
    }
}

/// Opens a file on a disk; a pipe or a device may never end.
fn open(file: &Path) -> Result<File, TableError> {
    let refused = |cause: std::io::Error| TableError::File { file: file.to_owned(), kind: cause.kind() };
    if !file.metadata().map_err(refused)?.is_file() {
        return Err(TableError::NoFile { file: file.to_owned() });
    }
    File::open(file).map_err(refused)
}

fn of_csv(file: &Path) -> Result<BodyTable, TableError> {
    let refuse = |cause: csv::Error| TableError::Csv { file: file.to_owned(), cause: cause.to_string() };
    let mut reader = csv::ReaderBuilder::new()
        .flexible(true)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(open(file)?);
    let header = reader.byte_headers().map_err(refuse)?.clone();
    let name =
        |bytes: &[u8]| unguarded(String::from_utf8_lossy(bytes).trim_start_matches('\u{feff}')).into_owned();
    let mut table = BodyTable::of(header.iter().map(name));
    let mut record = csv::ByteRecord::new();
    while reader.read_byte_record(&mut record).map_err(refuse)? {
        let line = record.position().map_or(0, csv::Position::line);
        if record.len() != table.names.len() {
            let (found, expected) = (record.len(), table.names.len());
            table.unread(format!(
                "line {line} of the table has {found} values, but the header has {expected}"
            ));
        } else if record.iter().any(|bytes| std::str::from_utf8(bytes).is_err()) {
            table.unread(format!("line {line} of the table is not UTF-8 text"));
        } else {
            for (column, bytes) in table.columns.iter_mut().zip(&record) {
                column.push(unguarded(&String::from_utf8_lossy(bytes)).into_owned());
            }
        }
    }
    Ok(table)
}

fn of_parquet(file: &Path) -> Result<BodyTable, TableError> {
    let opened = open(file)?;
    let limit = unpacked_limit(opened.metadata().map_or(0, |metadata| metadata.len()));
    let mut left = limit;
    undamaged(file, || {
        let reader = SerializedFileReader::new(opened)?;
        let fields = reader.metadata().file_metadata().schema().get_fields().to_vec();
        let mut table = BodyTable::of(fields.iter().map(|field| field.name().to_owned()));
        // rows without columns would be counted for as long as the file says
        if fields.is_empty() {
            return Ok(table);
        }
        for row in reader.get_row_iter(None)? {
            for (column, (_, field)) in table.columns.iter_mut().zip(row?.get_column_iter()) {
                let text = text(field);
                let size = (size_of::<String>() + text.len()) as u64;
                left = left.checked_sub(size).ok_or_else(|| {
                    ParquetError::General(format!("the table unpacks to more than {} MiB", limit >> 20))
                })?;
                column.push(text);
            }
        }
        Ok(table)
    })
}

/// Text of a value that keeps every bit of a number.
fn text(field: &Field) -> String {
    match field {
        Field::Null => String::new(),
        Field::Str(text) => text.clone(),
        Field::Double(number) => format!("{number:?}"),
        Field::Float(number) => format!("{:?}", f64::from(*number)),
        other => other.to_string(),
    }
}
