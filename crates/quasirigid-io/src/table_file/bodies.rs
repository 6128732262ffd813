//! Tables of bodies: one row each, all values as texts, from CSV or Parquet.
//! A row that cannot be read is kept with its reason, so that one bad line in a million loses one answer and not the run.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::TableError;
use super::formula::unguarded;
use super::line::fields;
use super::parquet::undamaged;
use crate::disk::{is_no_file, open_regular};
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

    /// Leaves out the columns without name and values, which a comma at the end of every line makes.
    fn without_unnamed(self) -> Self {
        let named = |(name, values): &(String, Vec<String>)| {
            !(name.is_empty() && values.iter().all(String::is_empty))
        };
        let (names, columns) = self.names.into_iter().zip(self.columns).filter(named).unzip();
        Self { names, columns, unread: self.unread }
    }

    /// Adds the row of a line.
    fn add(&mut self, line: usize, fields: Option<Vec<Vec<u8>>>) {
        let Some(mut fields) = fields else {
            return self
                .unread(format!("a quotation mark in line {line} of the table is not closed on that line"));
        };
        let expected = self.names.len();
        while fields.len() > expected && fields.last().is_some_and(Vec::is_empty) {
            fields.pop(); // commas at the end of the line
        }
        if fields.len() != expected {
            let found = fields.len();
            return self.unread(format!(
                "line {line} of the table has {found} values, but the header has {expected}"
            ));
        }
        let Ok(texts) = fields.into_iter().map(String::from_utf8).collect::<Result<Vec<_>, _>>() else {
            return self.unread(format!("line {line} of the table is not UTF-8 text"));
        };
        for (column, text) in self.columns.iter_mut().zip(&texts) {
            column.push(unguarded(text).into_owned());
        }
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
    let nameless = |(name, values): (&String, &Vec<String>)| {
        name.is_empty() && values.iter().any(|value| !value.is_empty())
    };
    if let Some(index) = table.names.iter().zip(&table.columns).position(nameless) {
        return Err(TableError::Unnamed { file: file.to_owned(), column: index + 1 });
    }
    let table = table.without_unnamed();
    if table.rows() == 0 {
        return Err(TableError::Empty { file: file.to_owned() });
    }
    let same = |(index, name): &(usize, &String)| table.names[..*index].contains(name);
    match table.names.iter().enumerate().find(same) {
        Some((_, name)) => Err(TableError::SameName { file: file.to_owned(), name: name.clone() }),
        None => Ok(table),
    }
}

/// Opens a file on a disk.
pub(super) fn open(file: &Path) -> Result<File, TableError> {
    open_regular(file).map_err(|cause| match is_no_file(&cause) {
        true => TableError::NoFile { file: file.to_owned() },
        false => TableError::File { file: file.to_owned(), kind: cause.kind() },
    })
}

fn of_csv(file: &Path) -> Result<BodyTable, TableError> {
    let refuse = |cause: io::Error| TableError::File { file: file.to_owned(), kind: cause.kind() };
    let mut input = BufReader::new(open(file)?);
    let (mut text, mut number) = (Vec::new(), 0);
    let mut table: Option<BodyTable> = None;
    while input.read_until(b'\n', &mut text).map_err(refuse)? > 0 {
        number += 1;
        let marked = if number == 1 { text.strip_prefix(b"\xef\xbb\xbf") } else { None };
        let lines = marked.unwrap_or(&text).split(|byte| matches!(byte, b'\r' | b'\n'));
        for line in lines.filter(|line| !line.is_empty() && !line.starts_with(b"#")) {
            match &mut table {
                Some(table) => table.add(number, fields(line)),
                None => {
                    let names = fields(line).ok_or_else(|| TableError::Names { file: file.to_owned() })?;
                    let name = |name: &Vec<u8>| unguarded(&String::from_utf8_lossy(name)).into_owned();
                    table = Some(BodyTable::of(names.iter().map(name)));
                }
            }
        }
        text.clear();
    }
    Ok(table.unwrap_or_default())
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
