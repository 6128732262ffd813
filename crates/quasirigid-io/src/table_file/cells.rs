//! Columns of results: whole numbers, numbers, truth values and texts, each with values that may be missing, and their form in CSV.

use crc32fast::Hasher;

use super::formula::guarded;

/// Values of a column; none where a row has no value.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Counts, of which none is missing.
    Counts(Vec<i64>),
    /// Numbers.
    Numbers(Vec<Option<f64>>),
    /// Truth values.
    Booleans(Vec<Option<bool>>),
    /// Texts.
    Texts(Vec<Option<String>>),
}

/// Kind of the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// Number.
    Number,
    /// Truth value.
    Boolean,
    /// Text.
    Text,
}

/// Column of results.
#[derive(Clone, Debug, PartialEq)]
pub struct CellColumn {
    /// Name of the column.
    pub name: String,
    /// Unit of its numbers; empty for pure numbers, truth values and texts.
    pub unit: String,
    /// Values.
    pub cells: Cells,
}

impl CellColumn {
    /// Number of values.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.cells {
            Cells::Counts(values) => values.len(),
            Cells::Numbers(values) => values.len(),
            Cells::Booleans(values) => values.len(),
            Cells::Texts(values) => values.len(),
        }
    }

    /// Whether the column has no values.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// CRC-32 of the values, whatever the form in which a file holds them.
    pub(super) fn checksum(&self) -> u32 {
        let mut sum = Hasher::new();
        let mut add = |bytes: Option<&[u8]>| {
            let length = bytes.map_or(u64::MAX, |bytes| bytes.len() as u64);
            sum.update(&length.to_le_bytes());
            sum.update(bytes.unwrap_or_default());
        };
        match &self.cells {
            Cells::Counts(values) => values.iter().for_each(|count| add(Some(&count.to_le_bytes()))),
            Cells::Numbers(values) => {
                values
                    .iter()
                    .for_each(|value| add(value.map(f64::to_le_bytes).as_ref().map(|bytes| &bytes[..])));
            }
            Cells::Booleans(values) => {
                values.iter().for_each(|value| {
                    add(value.map(|truth| [u8::from(truth)]).as_ref().map(|byte| &byte[..]))
                });
            }
            Cells::Texts(values) => values.iter().for_each(|text| add(text.as_ref().map(String::as_bytes))),
        }
        sum.finalize()
    }

    /// The value of a row as text; empty where there is none.
    fn text(&self, row: usize) -> String {
        match &self.cells {
            Cells::Counts(values) => values[row].to_string(),
            Cells::Numbers(values) => values[row].map(|number| format!("{number:?}")).unwrap_or_default(),
            Cells::Booleans(values) => values[row].map(|truth| truth.to_string()).unwrap_or_default(),
            Cells::Texts(values) => guarded(values[row].as_deref().unwrap_or_default()).into_owned(),
        }
    }
}

/// Line of the names of columns, as CSV, each with its unit in brackets, as `evolve.time [s]`; a spreadsheet takes no name and no text for a
/// formula.
#[must_use]
pub fn csv_header(columns: &[CellColumn]) -> Vec<u8> {
    let title = |column: &CellColumn| match column.unit.as_str() {
        "" => guarded(&column.name).into_owned(),
        unit => guarded(&format!("{} [{unit}]", column.name)).into_owned(),
    };
    lines(std::iter::once(columns.iter().map(title).collect()))
}

/// Lines of the rows of columns, as CSV; the columns are equally long.
#[must_use]
pub fn csv_rows(columns: &[CellColumn]) -> Vec<u8> {
    let rows = columns.iter().map(CellColumn::len).min().unwrap_or(0);
    lines((0..rows).map(|row| columns.iter().map(|column| column.text(row)).collect()))
}

fn lines(records: impl Iterator<Item = Vec<String>>) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        writer.write_record(&record).expect("memory takes every record of one width");
    }
    writer.into_inner().expect("memory takes every byte")
}
