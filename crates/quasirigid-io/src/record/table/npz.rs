//! NPZ tables of histories: an archive with one NumPy array of doubles for each column, stored without compression, as `numpy.load` reads.
//! An archive that another program has compressed is read up to a hundred times its size.

use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::super::folder::unusable;
use super::super::{Column, RecordError};
use super::{Rows, Take};
use crate::disk::open_regular;
use crate::npy::{MAGIC, header, member, text};
use crate::text_file::unpacked_limit;

/// Array that says in JSON what went into the table.
const INPUTS: &str = "inputs";

/// Array of an archive, made of the rows of a table.
pub struct Array<'a> {
    /// Name in the archive.
    pub name: &'a str,
    /// Type of its numbers, as NumPy writes it.
    pub kind: &'static str,
    /// Numbers of a row, of an array of two dimensions.
    pub width: Option<usize>,
    /// Appends the bytes of a row.
    pub bytes: &'a dyn Fn(&[f64], &mut Vec<u8>),
}

/// Writes the columns of a table into a file, with what went into it.
pub fn write(
    file: &Path,
    out: &mut (impl Write + Seek),
    (columns, inputs): (&[Column], Option<&str>),
    rows: &dyn Rows,
) -> Result<(), RecordError> {
    let number =
        |place: usize| move |row: &[f64], bytes: &mut Vec<u8>| bytes.extend(row[place].to_le_bytes());
    let numbers: Vec<_> = (0..columns.len()).map(number).collect();
    let array = |(column, bytes)| {
        let column: &Column = column;
        Array { name: &column.name, kind: "<f8", width: None, bytes }
    };
    let arrays: Vec<Array<'_>> =
        columns.iter().zip(numbers.iter().map(|number| number as _)).map(array).collect();
    write_arrays(file, out, (&arrays, inputs), rows)
}

/// Writes arrays into a file, one pass over the rows of the table for each.
pub fn write_arrays(
    file: &Path,
    out: &mut (impl Write + Seek),
    (arrays, inputs): (&[Array<'_>], Option<&str>),
    rows: &dyn Rows,
) -> Result<(), RecordError> {
    let failed = |error: &io::Error| unusable(file, error);
    let mut count = 0_u64;
    rows.each(&mut |_| {
        count += 1;
        Ok(())
    })?;
    let widest = arrays.iter().filter_map(|array| array.width).max().unwrap_or(1) as u64;
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .large_file(count > u64::from(u32::MAX) / (16 * widest))
        .last_modified_time(zip::DateTime::default());
    let mut archive = ZipWriter::new(FailsOnce { out, position: 0, end: 0, failed: false });
    let mut bytes = Vec::new();
    for Array { name, kind, width, bytes: of } in arrays {
        let shape = width.map_or(format!("({count},)"), |width| format!("({count}, {width})"));
        archive.start_file(member(name), options).map_err(|error| failed(&error.into()))?;
        archive.write_all(&header(kind, &shape)).map_err(|error| failed(&error))?;
        rows.each(&mut |row| {
            bytes.clear();
            of(row, &mut bytes);
            archive.write_all(&bytes).map_err(|error| failed(&error))
        })?;
    }
    if let Some(inputs) = inputs {
        archive.start_file(member(INPUTS), options).map_err(|error| failed(&error.into()))?;
        archive.write_all(&text(inputs)).map_err(|error| failed(&error))?;
    }
    archive.finish().map(drop).map_err(|error| failed(&error.into()))
}

/// Output that fails once and from then on takes everything: the writer of archives prints on standard error what fails while it is
/// dropped, after a failure that is told.
struct FailsOnce<W> {
    out: W,
    position: u64,
    end: u64,
    failed: bool,
}

impl<W> FailsOnce<W> {
    fn noted<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        self.failed |= result.as_ref().is_err_and(|error| error.kind() != io::ErrorKind::Interrupted);
        result
    }
}

impl<W: Write> Write for FailsOnce<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = if self.failed { Ok(bytes.len()) } else { self.out.write(bytes) };
        let written = self.noted(written)?;
        self.position += written as u64;
        self.end = self.end.max(self.position);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = if self.failed { Ok(()) } else { self.out.flush() };
        self.noted(flushed)
    }
}

impl<W: Seek> Seek for FailsOnce<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let sought = match to {
            _ if !self.failed => self.out.seek(to),
            SeekFrom::Start(place) => Ok(place),
            SeekFrom::Current(by) => Ok(self.position.saturating_add_signed(by)),
            SeekFrom::End(by) => Ok(self.end.saturating_add_signed(by)),
        };
        self.position = self.noted(sought)?;
        Ok(self.position)
    }
}

/// Reads the rows of a file whose columns have the names of these, all at once.
pub fn read(file: &Path, columns: &[Column], take: Take<'_>) -> Result<(), RecordError> {
    let damaged = |problem: String| RecordError::Table { file: file.into(), problem };
    let opened = open_regular(file).map_err(|error| unusable(file, &error))?;
    let limit = unpacked_limit(opened.metadata().map_err(|error| unusable(file, &error))?.len());
    let mut left = limit;
    let mut archive = ZipArchive::new(opened).map_err(|error| damaged(error.to_string()))?;
    let mut read = |column: &Column| {
        let input = archive.by_name(&member(&column.name)).map_err(|error| damaged(error.to_string()))?;
        let mut bytes = Vec::new();
        input.take(left + 1).read_to_end(&mut bytes).map_err(|error| unusable(file, &error))?;
        left = left
            .checked_sub(bytes.len() as u64)
            .ok_or_else(|| damaged(format!("the archive unpacks to more than {} MiB", limit >> 20)))?;
        numbers(&bytes).ok_or_else(|| damaged(format!("column {:?} is not an array of doubles", column.name)))
    };
    let values = columns.iter().map(&mut read).collect::<Result<Vec<_>, _>>()?;
    let rows = values.first().map_or(0, Vec::len);
    if values.iter().any(|column| column.len() != rows) {
        return Err(damaged("columns of unequal length".to_owned()));
    }
    for place in 0..rows {
        take(&values.iter().map(|column| column[place]).collect::<Vec<_>>())?;
    }
    Ok(())
}

fn numbers(bytes: &[u8]) -> Option<Vec<f64>> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (length, rest) = rest.split_first_chunk()?;
    let (text, data) = rest.split_at_checked(u16::from_le_bytes(*length).into())?;
    let text = std::str::from_utf8(text).ok()?;
    if !(text.contains("'<f8'") && text.contains("'fortran_order': False")) {
        return None;
    }
    let (numbers, rest) = data.as_chunks();
    rest.is_empty().then(|| numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
}
