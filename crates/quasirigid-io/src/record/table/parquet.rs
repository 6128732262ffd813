//! Parquet tables of histories: required columns of doubles, units in the metadata, row groups of bounded size.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::super::folder::unusable;
use super::super::{Column, RecordError};
use super::{Rows, Take};
use crate::disk::open_regular;

/// Rows of a group that is written, and rows that are read at once.
const GROUP: usize = 65_536;
/// Key of the metadata under which the units stand, a JSON object by name of the column.
const UNITS: &str = "quasirigid.units";
/// Key of the metadata under which stands what went into the table, in JSON.
const INPUTS: &str = "quasirigid.inputs";

/// Writes rows into a file.
pub fn write(
    file: &Path,
    out: &mut (impl Write + Send),
    (columns, inputs): (&[Column], Option<&str>),
    rows: &dyn Rows,
) -> Result<(), RecordError> {
    let failed = |error: ParquetError| unwritten(file, &error);
    let mut writer = writer(out, columns, inputs).map_err(failed)?;
    let mut group: Vec<Vec<f64>> = columns.iter().map(|_| Vec::new()).collect();
    rows.each(&mut |row| {
        group.iter_mut().zip(row).for_each(|(column, number)| column.push(*number));
        match group.first() {
            Some(first) if first.len() == GROUP => flush(&mut writer, &mut group).map_err(failed),
            _ => Ok(()),
        }
    })?;
    flush(&mut writer, &mut group).map_err(failed)?;
    writer.close().map(drop).map_err(failed)
}

fn writer<W: Write + Send>(
    out: W,
    columns: &[Column],
    inputs: Option<&str>,
) -> Result<SerializedFileWriter<W>, ParquetError> {
    let units: BTreeMap<&str, &str> =
        columns.iter().map(|column| (column.name.as_str(), column.unit.as_str())).collect();
    let units = serde_json::to_string(&units).map_err(|cause| ParquetError::General(cause.to_string()))?;
    let inputs = inputs.map(|inputs| KeyValue::new(INPUTS.to_owned(), inputs.to_owned()));
    let pairs = std::iter::once(KeyValue::new(UNITS.to_owned(), units)).chain(inputs).collect();
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(pairs))
        .build();
    let field = |column: &Column| {
        let builder = Type::primitive_type_builder(&column.name, Physical::DOUBLE);
        builder.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("rows").with_fields(fields).build()?;
    SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))
}

fn flush<W: Write + Send>(
    writer: &mut SerializedFileWriter<W>,
    columns: &mut [Vec<f64>],
) -> Result<(), ParquetError> {
    if columns.first().is_none_or(Vec::is_empty) {
        return Ok(());
    }
    let mut group = writer.next_row_group()?;
    for values in columns {
        let Some(mut place) = group.next_column()? else { break };
        if let ColumnWriter::DoubleColumnWriter(out) = place.untyped() {
            out.write_batch(values, None, None)?;
        }
        place.close()?;
        values.clear();
    }
    group.close().map(drop)
}

/// A table that cannot be written: the system says why, or the library.
fn unwritten(file: &Path, error: &ParquetError) -> RecordError {
    let system = match error {
        ParquetError::External(cause) => cause.downcast_ref::<io::Error>(),
        _ => None,
    };
    system.map_or_else(|| damaged(file, error), |cause| unusable(file, cause))
}

/// Reads the rows of a file whose columns have the names of these. Of damaged metadata the library panics, which is an error like others.
pub fn read(file: &Path, columns: &[Column], take: Take<'_>) -> Result<(), RecordError> {
    let reading = panic::catch_unwind(AssertUnwindSafe(|| read_undamaged(file, columns, take)));
    reading.unwrap_or_else(|_| Err(damaged(file, &"damaged metadata")))
}

fn read_undamaged(file: &Path, columns: &[Column], take: Take<'_>) -> Result<(), RecordError> {
    let failed = |error: ParquetError| damaged(file, &error);
    let opened = open_regular(file).map_err(|error| unusable(file, &error))?;
    let reader = SerializedFileReader::new(opened).map_err(failed)?;
    let described = reader.metadata().file_metadata().schema_descr();
    let found: Vec<String> = described.columns().iter().map(|column| column.name().to_owned()).collect();
    let expected: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    if found != expected {
        return Err(RecordError::Header { file: file.into(), expected, found });
    }
    let mut row = vec![0.0; columns.len()];
    for number in 0..reader.num_row_groups() {
        let mut group = Group::new(&reader, number, columns.len()).map_err(failed)?;
        while group.next().map_err(failed)? {
            for place in 0..group.values.first().map_or(0, Vec::len) {
                for (value, column) in row.iter_mut().zip(&group.values) {
                    *value = *column.get(place).ok_or_else(|| damaged(file, &"columns of unequal length"))?;
                }
                take(&row)?;
            }
        }
    }
    Ok(())
}

/// Row group, read some rows at a time: a few bytes may stand for any number of equal values.
struct Group {
    columns: Vec<ColumnReaderImpl<DoubleType>>,
    /// The rows read last, column by column.
    values: Vec<Vec<f64>>,
    left: usize,
}

impl Group {
    fn new(reader: &SerializedFileReader<File>, number: usize, columns: usize) -> Result<Self, ParquetError> {
        let group = reader.get_row_group(number)?;
        let column = |index: usize| match group.get_column_reader(index)? {
            ColumnReader::DoubleColumnReader(reader) => Ok(reader),
            _ => Err(ParquetError::General("a column that is not numeric".to_owned())),
        };
        Ok(Self {
            columns: (0..columns).map(column).collect::<Result<_, _>>()?,
            values: vec![Vec::new(); columns],
            left: usize::try_from(group.metadata().num_rows()).unwrap_or(0),
        })
    }

    /// Reads the next rows; none are left where there are none in any column.
    fn next(&mut self) -> Result<bool, ParquetError> {
        let wanted = self.left.min(GROUP);
        for (reader, values) in self.columns.iter_mut().zip(&mut self.values) {
            values.clear();
            while values.len() < wanted {
                let (read, ..) =
                    reader.read_records(wanted - values.len(), Some(&mut Vec::new()), None, values)?;
                if read == 0 {
                    break;
                }
            }
        }
        self.left -= wanted;
        Ok(self.values.iter().any(|values| !values.is_empty()))
    }
}

fn damaged(file: &Path, cause: &dyn std::fmt::Display) -> RecordError {
    RecordError::Table { file: file.into(), problem: cause.to_string() }
}
