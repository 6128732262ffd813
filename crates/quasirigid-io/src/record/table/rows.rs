//! Log of rows of a run in work: numbers of 8 bytes, little-endian, row after row, to which a run appends. Of a run that was cut off
//! every whole row is there; a run goes on from rows that have the checksum of its checkpoint.

use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;

use super::super::RecordError;
use super::super::folder::unusable;
use super::Rows;
use crate::disk::{open_regular, settle};

/// Bytes that are kept back before they are written.
const BUFFER: usize = 1 << 20;

/// Log to which rows are appended.
#[derive(Debug)]
pub struct RowLog {
    path: PathBuf,
    file: File,
    width: usize,
    rows: u64,
    checksum: Hasher,
    waiting: Vec<u8>,
}

impl RowLog {
    /// Starts a log of rows of so many numbers, in place of an older one.
    ///
    /// # Errors
    /// Those of the system.
    pub fn create(path: &Path, width: usize) -> io::Result<Self> {
        let file = File::create(path)?;
        Ok(Self { path: path.to_owned(), file, width, rows: 0, checksum: Hasher::new(), waiting: Vec::new() })
    }

    /// Goes on with a log: keeps its first rows, which have a checksum, and drops the others.
    ///
    /// # Errors
    /// Those of the system, [`io::ErrorKind::UnexpectedEof`] where the log is shorter, and [`io::ErrorKind::InvalidData`] where its rows
    /// have another checksum; the log then stays as it is.
    pub fn resume(path: &Path, width: usize, rows: u64, checksum: u32) -> io::Result<Self> {
        open_regular(path)?;
        let mut file = OpenOptions::new().read(true).write(true).open(path)?;
        let length = rows.checked_mul(8 * width as u64).ok_or(io::ErrorKind::InvalidInput)?;
        if file.metadata()?.len() < length {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        let (mut found, mut bytes, mut left) = (Hasher::new(), vec![0; BUFFER], length);
        while left > 0 {
            let next = &mut bytes[..left.min(BUFFER as u64) as usize];
            file.read_exact(next)?;
            found.update(next);
            left -= next.len() as u64;
        }
        if found.clone().finalize() != checksum {
            return Err(io::ErrorKind::InvalidData.into());
        }
        file.set_len(length)?; // the file is read up to there, and goes on from there
        Ok(Self { path: path.to_owned(), file, width, rows, checksum: found, waiting: Vec::new() })
    }

    /// Appends a row.
    ///
    /// # Errors
    /// Those of the system.
    pub fn push(&mut self, row: &[f64]) -> io::Result<()> {
        self.waiting.extend(row.iter().flat_map(|number| number.to_le_bytes()));
        self.rows += 1;
        if self.waiting.len() >= BUFFER { self.write() } else { Ok(()) }
    }

    /// Rows of the log.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// CRC-32 of the rows that are written.
    #[must_use]
    pub fn checksum(&self) -> u32 {
        self.checksum.clone().finalize()
    }

    /// Waits until every row is on the disk.
    ///
    /// # Errors
    /// Those of the system.
    pub fn settle(&mut self) -> io::Result<()> {
        self.write()?;
        settle(&self.file)
    }

    /// The rows as a table.
    ///
    /// # Errors
    /// Those of the system.
    pub fn into_table(mut self) -> io::Result<RowTable> {
        self.write()?;
        Ok(RowTable { path: self.path, width: self.width, rows: self.rows })
    }

    fn write(&mut self) -> io::Result<()> {
        self.file.write_all(&self.waiting)?;
        self.checksum.update(&self.waiting);
        self.waiting.clear();
        Ok(())
    }
}

/// Rows of a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowTable {
    path: PathBuf,
    width: usize,
    rows: u64,
}

impl RowTable {
    /// The whole rows of a log.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn open(path: &Path, width: usize) -> Result<Self, RecordError> {
        let length =
            open_regular(path).and_then(|log| log.metadata()).map_err(|error| unusable(path, &error))?.len();
        Ok(Self { path: path.to_owned(), width, rows: length / (8 * width.max(1) as u64) })
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Passes every row, in order.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn for_each(&self, mut take: impl FnMut(&[f64])) -> Result<(), RecordError> {
        self.each(&mut |row| {
            take(row);
            Ok(())
        })
    }
}

impl Rows for RowTable {
    fn each(&self, take: &mut dyn FnMut(&[f64]) -> Result<(), RecordError>) -> Result<(), RecordError> {
        let unread = |error: io::Error| unusable(&self.path, &error);
        let mut input = BufReader::with_capacity(BUFFER, open_regular(&self.path).map_err(unread)?);
        let mut bytes = vec![0; 8 * self.width];
        let mut row = vec![0.0; self.width];
        for _ in 0..self.rows {
            input.read_exact(&mut bytes).map_err(unread)?;
            let (numbers, _) = bytes.as_chunks();
            row.iter_mut().zip(numbers).for_each(|(number, bytes)| *number = f64::from_le_bytes(*bytes));
            take(&row)?;
        }
        Ok(())
    }
}
