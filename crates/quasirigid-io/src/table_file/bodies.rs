//! Tables of bodies: one row each, all values as texts, from text, VOTable, a workbook or Parquet.
//! A row that cannot be read is kept with its reason, so that one bad line in a million loses one answer and not the run.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::TableError;
use super::formula::unguarded;
use super::names::bracketed;
use super::parquet::undamaged;
use super::{text_table, votable, workbook};
use crate::disk::{is_no_file, open_regular};
use crate::text_file::unpacked_limit;

/// Bytes by which the format of a file is told.
const BEGINNING: u64 = 1024;

/// Table of bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyTable {
    /// Names of the columns.
    pub names: Vec<String>,
    /// Texts of each column, one for each row; empty where there is no value.
    pub columns: Vec<Vec<String>>,
    /// Unit of each column, where the file gives one; empty of pure numbers.
    pub units: Vec<Option<String>>,
    /// Rows that could not be read, by index from 0, each with the reason.
    pub unread: BTreeMap<usize, String>,
    /// What the reader made of the file, where that is not plain.
    pub notes: Vec<String>,
}

impl BodyTable {
    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Number of a column, by its whole name or by that without the unit in brackets, if that is the name of one.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<usize> {
        let whole = self.names.iter().position(|title| title == name);
        let plain = || {
            let is_meant = |title: &String| bracketed(title).is_some_and(|(plain, _)| plain == name);
            let mut meant = (0..self.names.len()).filter(|column| is_meant(&self.names[*column]));
            meant.next().filter(|_| meant.next().is_none())
        };
        whole.or_else(plain)
    }

    /// A table without rows, with the units that its names tell.
    pub(super) fn of(names: impl Iterator<Item = String>) -> Self {
        let names: Vec<String> = names.collect();
        let units = names.iter().map(|name| Some(bracketed(name)?.1)).collect();
        let columns = vec![Vec::new(); names.len()];
        Self { columns, names, units, unread: BTreeMap::new(), notes: Vec::new() }
    }

    /// Leaves out the columns without a name, which a comma at the end of every line makes, or the number of the row.
    fn without_unnamed(mut self) -> Self {
        let nameless: Vec<bool> = self.names.iter().map(String::is_empty).collect();
        for (column, values) in self.columns.iter().enumerate().filter(|(column, _)| nameless[*column]) {
            if values.iter().any(|value| !value.is_empty()) {
                self.notes.push(format!("column {} has values but no name, and is left out", column + 1));
            }
        }
        let mut keep = nameless.iter().map(|nameless| !nameless);
        self.names.retain(|_| keep.next().unwrap_or(true));
        let mut keep = nameless.iter().map(|nameless| !nameless);
        self.columns.retain(|_| keep.next().unwrap_or(true));
        let mut keep = nameless.iter().map(|nameless| !nameless);
        self.units.retain(|_| keep.next().unwrap_or(true));
        self
    }

    /// Numbers columns of the same name, as `F_1` and `F_2`, so that none is taken for another.
    fn numbered(mut self) -> Self {
        let mut counts = BTreeMap::<&str, usize>::new();
        self.names.iter().for_each(|name| *counts.entry(name).or_default() += 1);
        let twins: Vec<String> =
            counts.into_iter().filter(|(_, count)| *count > 1).map(|(name, _)| name.to_owned()).collect();
        for twin in twins {
            let mut numbers = (1..).map(|number| format!("{twin}_{number}"));
            for column in 0..self.names.len() {
                if self.names[column] == twin {
                    let name = numbers.by_ref().find(|name| !self.names.contains(name));
                    self.names[column] = name.unwrap_or_default();
                }
            }
            self.notes.push(format!("columns named {twin} are numbered: {twin}_1, {twin}_2 and so on"));
        }
        self
    }

    /// Adds the row of a line.
    pub(super) fn add(&mut self, line: usize, fields: Option<Vec<Vec<u8>>>) {
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

    pub(super) fn unread(&mut self, reason: String) {
        self.unread.insert(self.rows(), reason);
        self.columns.iter_mut().for_each(|column| column.push(String::new()));
    }
}

/// Reads a table: Parquet, a workbook of Excel (XLSX), a VOTable, or text with a header, by what the file begins with.
///
/// # Errors
/// [`TableError`] for a file that cannot be read, and for one without rows.
pub fn read_bodies(file: &Path) -> Result<BodyTable, TableError> {
    let mut begins = Vec::new();
    let unread = |cause: std::io::Error| TableError::File { file: file.to_owned(), kind: cause.kind() };
    open(file)?.take(BEGINNING).read_to_end(&mut begins).map_err(unread)?;
    let named = |ending: &str| file.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
    let table = if named("parquet") || begins.starts_with(b"PAR1") {
        of_parquet(file)?
    } else if begins.starts_with(b"PK\x03\x04") {
        workbook::read(file)?
    } else if votable::begins(&begins) {
        votable::read(file)?
    } else {
        text_table::read(file)?
    };
    let nameless = |(name, values): (&String, &Vec<String>)| {
        name.is_empty() && values.iter().any(|value| !value.is_empty())
    };
    if let (true, Some(index)) =
        (table.names.iter().all(String::is_empty), table.names.iter().zip(&table.columns).position(nameless))
    {
        return Err(TableError::Unnamed { file: file.to_owned(), column: index + 1 });
    }
    let table = table.without_unnamed().numbered();
    if table.rows() == 0 {
        return Err(TableError::Empty { file: file.to_owned() });
    }
    Ok(table)
}

/// Opens a file on a disk.
pub(super) fn open(file: &Path) -> Result<File, TableError> {
    open_regular(file).map_err(|cause| match is_no_file(&cause) {
        true => TableError::NoFile { file: file.to_owned() },
        false => TableError::File { file: file.to_owned(), kind: cause.kind() },
    })
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
