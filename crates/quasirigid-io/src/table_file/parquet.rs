//! Parquet files of results: one row group, one optional column per quantity, Snappy compression, units and origin in the metadata.
//! The bytes are the same for the same columns, so that an interrupted study that goes on ends with the files of one that did not stop.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::{FileMetaData, KeyValue};
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};
use quasirigid_math::memory;

use serde::de::DeserializeOwned;

use super::bodies::open;
use super::{CellColumn, Cells, TableError};
use crate::study_file::MOST_IN_PART;

/// Key of the metadata under which the units stand, a JSON object by name of the column.
const UNITS: &str = "quasirigid.units";
/// Key of the metadata under which the checksums of the values stand, a JSON object by name of the column.
const CHECKSUMS: &str = "quasirigid.crc32";
/// Rows that are read at once.
const BATCH: usize = 1 << 16;

/// Writes columns of equal length; `metadata` are further pairs of key and value for the file.
///
/// # Errors
/// [`TableError::Parquet`] if the writer refuses; `file` stands in the message.
pub fn write_parquet(
    file: &Path,
    out: impl Write + Send,
    columns: &[CellColumn],
    metadata: &[(&str, String)],
) -> Result<(), TableError> {
    written(out, columns, metadata)
        .map_err(|cause| TableError::Parquet { file: file.to_owned(), cause: cause.to_string() })
}

/// Reads the columns that [`write_parquet`] wrote, those of the names asked for or all of them, in the order of the file.
///
/// # Errors
/// [`TableError`] for a file that cannot be read, for one of another origin, and for values without the checksum that they had.
pub fn read_parquet(file: &Path, wanted: Option<&[&str]>) -> Result<Vec<CellColumn>, TableError> {
    let opened = open(file)?;
    undamaged(file, || read(opened, wanted))
}

/// Calls a reader of Parquet. Of damaged metadata the library panics, which is an error like others.
pub(crate) fn undamaged<T>(
    file: &Path,
    read: impl FnOnce() -> Result<T, ParquetError>,
) -> Result<T, TableError> {
    let damaged = |_| Err(ParquetError::General("damaged metadata".to_owned()));
    let reading = panic::catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(damaged);
    reading.map_err(|cause| TableError::Parquet { file: file.to_owned(), cause: cause.to_string() })
}

fn written(
    out: impl Write + Send,
    columns: &[CellColumn],
    metadata: &[(&str, String)],
) -> Result<(), ParquetError> {
    let units: BTreeMap<&str, &str> = columns
        .iter()
        .filter(|column| !column.unit.is_empty())
        .map(|c| (c.name.as_str(), c.unit.as_str()))
        .collect();
    let units = serde_json::to_string(&units).map_err(|cause| ParquetError::General(cause.to_string()))?;
    let checksums: BTreeMap<&str, u32> = columns.iter().map(|c| (c.name.as_str(), c.checksum())).collect();
    let checksums =
        serde_json::to_string(&checksums).map_err(|cause| ParquetError::General(cause.to_string()))?;
    let pairs = metadata.iter().map(|(key, value)| ((*key).to_owned(), value.clone()));
    let own = [(UNITS.to_owned(), units), (CHECKSUMS.to_owned(), checksums)];
    let pairs = pairs.chain(own).map(|(key, value)| KeyValue::new(key, value)).collect();
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(pairs))
        .build();
    let mut writer = SerializedFileWriter::new(out, schema(columns)?, Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in columns {
        let Some(mut place) = group.next_column()? else { break };
        match (place.untyped(), &column.cells) {
            (ColumnWriter::Int64ColumnWriter(out), Cells::Counts(values)) => {
                out.write_batch(values, None, None)?;
            }
            (ColumnWriter::DoubleColumnWriter(out), Cells::Numbers(values)) => {
                let (there, levels) = sparse(values, |number| *number);
                out.write_batch(&there, Some(&levels), None)?;
            }
            (ColumnWriter::BoolColumnWriter(out), Cells::Booleans(values)) => {
                let (there, levels) = sparse(values, |truth| *truth);
                out.write_batch(&there, Some(&levels), None)?;
            }
            (ColumnWriter::ByteArrayColumnWriter(out), Cells::Texts(values)) => {
                let (there, levels) = sparse(values, |text| ByteArray::from(text.as_str()));
                out.write_batch(&there, Some(&levels), None)?;
            }
            _ => return Err(ParquetError::General(format!("column {:?} has another type", column.name))),
        }
        place.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(())
}

/// The values that are there, and for each row 1 or 0: whether there is one.
fn sparse<T, U>(values: &[Option<T>], value: impl Fn(&T) -> U) -> (Vec<U>, Vec<i16>) {
    let there = values.iter().flatten().map(value).collect();
    (there, values.iter().map(|value| i16::from(value.is_some())).collect())
}

fn schema(columns: &[CellColumn]) -> Result<TypePtr, ParquetError> {
    let field = |column: &CellColumn| {
        let (physical, logical) = match column.cells {
            Cells::Counts(_) => (Physical::INT64, None),
            Cells::Numbers(_) => (Physical::DOUBLE, None),
            Cells::Booleans(_) => (Physical::BOOLEAN, None),
            Cells::Texts(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let required = matches!(column.cells, Cells::Counts(_));
        let repetition = if required { Repetition::REQUIRED } else { Repetition::OPTIONAL };
        let builder = Type::primitive_type_builder(&column.name, physical);
        builder.with_repetition(repetition).with_logical_type(logical).build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
    Ok(Arc::new(Type::group_type_builder("rows").with_fields(fields).build()?))
}

fn read(file: File, wanted: Option<&[&str]>) -> Result<Vec<CellColumn>, ParquetError> {
    let reader = SerializedFileReader::new(file)?;
    let metadata = reader.metadata().file_metadata();
    let units: BTreeMap<String, String> = by_name(metadata, UNITS)?;
    let checksums: BTreeMap<String, u32> = by_name(metadata, CHECKSUMS)?;
    let rows = reader
        .metadata()
        .row_groups()
        .iter()
        .fold(0, |rows: i64, group| rows.saturating_add(group.num_rows().max(0)));
    if rows as usize > MOST_IN_PART {
        let problem = format!("it has {rows} rows, and a part of a study has {MOST_IN_PART} at most");
        return Err(ParquetError::General(problem));
    }
    let mut columns = Vec::new();
    for (index, field) in metadata.schema_descr().columns().iter().enumerate() {
        let name = field.name().to_owned();
        if wanted.is_some_and(|wanted| !wanted.contains(&name.as_str())) {
            continue;
        }
        let mut cells = None;
        for group in 0..reader.num_row_groups() {
            read_group(reader.get_row_group(group)?.as_ref(), index, &mut cells)?;
        }
        let unit = units.get(&name).cloned().unwrap_or_default();
        columns.extend(cells.map(|cells| CellColumn { name, unit, cells }));
    }
    let altered = |column: &&CellColumn| {
        !checksums.is_empty() && checksums.get(&column.name) != Some(&column.checksum())
    };
    match columns.iter().find(altered) {
        Some(CellColumn { name, .. }) => Err(ParquetError::General(format!("column {name:?} is damaged"))),
        None => Ok(columns),
    }
}

/// Values by the name of the column, from a key of the metadata; none where the key is missing.
fn by_name<T: DeserializeOwned>(
    metadata: &FileMetaData,
    key: &str,
) -> Result<BTreeMap<String, T>, ParquetError> {
    let pairs = metadata.key_value_metadata();
    let text = pairs.and_then(|pairs| pairs.iter().find(|pair| pair.key == key)?.value.as_deref());
    let damaged = |_| ParquetError::General(format!("damaged metadata {key}"));
    text.map_or_else(|| Ok(BTreeMap::new()), |text| serde_json::from_str(text).map_err(damaged))
}

/// Appends the values of one column of one row group.
fn read_group(
    group: &dyn RowGroupReader,
    index: usize,
    cells: &mut Option<Cells>,
) -> Result<(), ParquetError> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    match group.get_column_reader(index)? {
        ColumnReader::Int64ColumnReader(reader) => {
            let (values, _) = records(reader, rows)?;
            if let Cells::Counts(all) = cells.get_or_insert(Cells::Counts(Vec::new())) {
                all.extend(values);
            }
        }
        ColumnReader::DoubleColumnReader(reader) => {
            let (values, levels) = records(reader, rows)?;
            if let Cells::Numbers(all) = cells.get_or_insert(Cells::Numbers(Vec::new())) {
                all.extend(dense(values, &levels));
            }
        }
        ColumnReader::BoolColumnReader(reader) => {
            let (values, levels) = records(reader, rows)?;
            if let Cells::Booleans(all) = cells.get_or_insert(Cells::Booleans(Vec::new())) {
                all.extend(dense(values, &levels));
            }
        }
        ColumnReader::ByteArrayColumnReader(reader) => {
            let (values, levels) = records(reader, rows)?;
            let size: usize = values.iter().map(|text| size_of::<Option<String>>() + text.len()).sum();
            memory::ask(size as f64).map_err(|cause| ParquetError::External(Box::new(cause)))?;
            let texts =
                values.iter().map(|text| text.as_utf8().map(str::to_owned)).collect::<Result<Vec<_>, _>>()?;
            if let Cells::Texts(all) = cells.get_or_insert(Cells::Texts(Vec::new())) {
                all.extend(dense(texts, &levels));
            }
        }
        _ => return Err(ParquetError::General("a column of a type that no study writes".to_owned())),
    }
    Ok(())
}

/// The values of so many rows, and the levels that say which rows have one. Memory grows with what is there, whatever the file announces.
fn records<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
) -> Result<(Vec<T::T>, Vec<i16>), ParquetError> {
    let (mut values, mut levels, mut done) = (Vec::new(), Vec::new(), 0);
    while done < rows {
        let (read, ..) = reader.read_records(BATCH.min(rows - done), Some(&mut levels), None, &mut values)?;
        if read == 0 {
            return Err(ParquetError::General(format!("a column ends after {done} of {rows} rows")));
        }
        done += read;
    }
    Ok((values, levels))
}

/// A value for each level: the next where the level is 1. A column of which no value may be missing has no levels.
fn dense<T>(values: Vec<T>, levels: &[i16]) -> Vec<Option<T>> {
    if levels.is_empty() {
        return values.into_iter().map(Some).collect();
    }
    let mut values = values.into_iter();
    levels.iter().map(|level| if *level == 1 { values.next() } else { None }).collect()
}
