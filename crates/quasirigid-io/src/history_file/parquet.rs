//! Histories in Parquet files.

use std::path::Path;

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::columns::{Chosen, Column};
use super::error::{Fault, HistoryFileProblem};
use super::{HistoryFile, Resolution};
use crate::table_file::{TableError, undamaged};
use crate::text_file::Place;

/// Rows that are read at once.
const BATCH: usize = 1 << 16;

/// Reads the columns of a history.
pub(super) fn read(file: &Path) -> Result<HistoryFile, Fault> {
    let whole = |problem| (Place::File, problem);
    let table = |error: TableError| whole(HistoryFileProblem::Table(error));
    let opened = crate::disk::open_regular(file)
        .map_err(|error| whole(HistoryFileProblem::Unreadable { kind: error.kind() }))?;
    let reader = undamaged(file, || SerializedFileReader::new(opened)).map_err(table)?;
    let described = reader.metadata().file_metadata().schema_descr();
    let titles: Vec<String> = described.columns().iter().map(|column| column.name().to_owned()).collect();
    let chosen = Chosen::of(&titles, &[]).map_err(whole)?;
    let mut columns = Vec::new();
    for index in &chosen.indices {
        let read = undamaged(file, || column(&reader, *index)).map_err(table)?;
        let found = read.ok_or_else(|| {
            let found = "a missing value, or a column that is not of numbers,".into();
            whole(HistoryFileProblem::Cell { name: titles[*index].as_str().into(), found })
        })?;
        columns.push(found);
    }
    chosen.history(columns, Vec::new())
}

/// A column of finite numbers; none where it has others, or none.
fn column(
    reader: &SerializedFileReader<std::fs::File>,
    index: usize,
) -> Result<Option<Column>, ParquetError> {
    let (mut values, mut resolution) = (Vec::new(), Resolution::Double);
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        let whole = match group.get_column_reader(index)? {
            ColumnReader::DoubleColumnReader(reader) => take(reader, rows, &mut values, |value| value)?,
            ColumnReader::FloatColumnReader(reader) => {
                resolution = Resolution::Single;
                take(reader, rows, &mut values, f64::from)?
            }
            ColumnReader::Int32ColumnReader(reader) => take(reader, rows, &mut values, f64::from)?,
            ColumnReader::Int64ColumnReader(reader) => take(reader, rows, &mut values, |value| value as f64)?,
            _ => false,
        };
        if !whole {
            return Ok(None);
        }
    }
    Ok(values.iter().all(|value| value.is_finite()).then_some(Column { values, resolution }))
}

/// Appends the values of a row group; returns whether every row has one.
fn take<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    values: &mut Vec<f64>,
    number: impl Fn(T::T) -> f64,
) -> Result<bool, ParquetError> {
    let (mut done, mut found) = (0, 0);
    while done < rows {
        let (mut batch, mut levels) = (Vec::new(), Vec::new());
        let (read, ..) = reader.read_records(BATCH.min(rows - done), Some(&mut levels), None, &mut batch)?;
        if read == 0 {
            return Ok(false);
        }
        done += read;
        found += batch.len();
        values.extend(batch.into_iter().map(&number));
    }
    Ok(found == rows)
}
