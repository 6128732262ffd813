//! Journal of a part in work: one line for each row as it finishes, with every bit of its numbers and a checksum.
//! A line that a killed run left unfinished fails its checksum and is dropped, so that a kill loses the rows in work and no other.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use quasirigid_io::disk::{open_regular, parent, settle, settle_folder, stands};
use serde_json::{Value, json};

use super::cell::Cell;
use super::row::RowAnswer;
use crate::asked::Status;

/// Longest time for which rows are not yet on the disk: what a loss of power takes.
const PAUSE: Duration = Duration::from_secs(1);

/// Journal of a part, locked by this process as long as it is open.
#[derive(Debug)]
pub(super) struct Journal {
    file: File,
    path: PathBuf,
    /// Time at which the rows were on the disk.
    settled: Instant,
}

impl Journal {
    /// Opens the journal of a part with the rows that are in it already; none if another process has it.
    pub(super) fn open(path: &Path) -> io::Result<Option<(Self, Vec<RowAnswer>)>> {
        if path.exists() {
            open_regular(path)?;
        }
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        match file.try_lock() {
            Err(std::fs::TryLockError::WouldBlock) => return Ok(None),
            Err(std::fs::TryLockError::Error(_)) | Ok(()) => {} // where the file system has no locks nobody can be told apart
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let mut rows = Vec::new();
        let mut whole = 0;
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            let Some(row) = read(line) else { break };
            rows.push(row);
            whole += line.len();
        }
        file.set_len(whole as u64)?;
        file.seek(SeekFrom::End(0))?;
        Ok(Some((Self { file, path: path.to_owned(), settled: Instant::now() }, rows)))
    }

    /// Writes rows.
    pub(super) fn write(&mut self, rows: &[RowAnswer]) -> io::Result<()> {
        let lines: String = rows.iter().map(line).collect();
        self.file.write_all(lines.as_bytes())?;
        if self.settled.elapsed() >= PAUSE { self.settle() } else { Ok(()) }
    }

    /// Waits until the rows are on the disk. A journal that was removed, or is in another place by now, is an error: its rows are lost.
    pub(super) fn settle(&mut self) -> io::Result<()> {
        if !stands(&self.file, &self.path) {
            return Err(io::ErrorKind::NotFound.into());
        }
        settle(&self.file)?;
        settle_folder(parent(&self.path))?;
        self.settled = Instant::now();
        Ok(())
    }

    /// Removes the journal of a part that is written.
    pub(super) fn remove(self) -> io::Result<()> {
        match std::fs::remove_file(&self.path) {
            // another process that saw the part has removed it
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }
}

/// Line of a row.
pub(super) fn line(row: &RowAnswer) -> String {
    let cells: Vec<Value> = row.outputs.iter().map(cell_to_json).collect();
    let text = json!([row.row, row.status.word(), row.reason, row.note, cells]).to_string();
    format!("{:08x} {text}\n", crc32fast::hash(text.as_bytes()))
}

/// Row of a line; none if the line is not whole.
pub(super) fn read(line: &[u8]) -> Option<RowAnswer> {
    let line = std::str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (checksum, text) = line.split_once(' ')?;
    if u32::from_str_radix(checksum, 16).ok()? != crc32fast::hash(text.as_bytes()) {
        return None;
    }
    let (row, status, reason, note, cells): (u64, String, String, String, Vec<Value>) =
        serde_json::from_str(text).ok()?;
    let outputs = cells.iter().map(cell_of_json).collect::<Option<_>>()?;
    Some(RowAnswer { row, outputs, status: Status::of(&status)?, reason, note })
}

fn cell_to_json(cell: &Cell) -> Value {
    match cell {
        Cell::Missing => Value::Null,
        Cell::Number(number) => json!([number.to_bits()]),
        Cell::Boolean(truth) => json!(truth),
        Cell::Text(text) => json!(text),
    }
}

fn cell_of_json(value: &Value) -> Option<Cell> {
    Some(match value {
        Value::Null => Cell::Missing,
        Value::Bool(truth) => Cell::Boolean(*truth),
        Value::String(text) => Cell::Text(text.clone()),
        Value::Array(bits) => Cell::Number(f64::from_bits(bits.first()?.as_u64()?)),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(row: u64) -> RowAnswer {
        let outputs = vec![
            Cell::Number(0.1 + row as f64),
            Cell::Number(f64::INFINITY),
            Cell::Number(f64::from_bits(1)),
            Cell::Boolean(true),
            Cell::Text("a\nb \"c\" é".into()),
            Cell::Missing,
        ];
        RowAnswer { row, outputs, status: Status::Refused, reason: "no".into(), note: String::new() }
    }

    /// Whatever the length at which the file was cut, the whole lines are read and the rest is dropped.
    #[test]
    fn torn_tail_is_dropped_and_the_rest_is_exact() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("journal");
        let rows: Vec<RowAnswer> = (0..3).map(row).collect();
        let whole: String = rows.iter().map(line).collect();
        for cut in 0..=whole.len() {
            std::fs::write(&path, &whole.as_bytes()[..cut]).expect("a file");
            let (mut journal, found) = Journal::open(&path).expect("a file").expect("no other process");
            let kept = whole.as_bytes()[..cut].iter().filter(|byte| **byte == b'\n').count();
            assert_eq!(found, rows[..kept], "cut at {cut}");
            journal.write(&[row(9)]).expect("room");
            drop(journal);
            let (_journal, again) = Journal::open(&path).expect("a file").expect("no other process");
            assert_eq!(
                again.last(),
                Some(&row(9)),
                "what is written after a cut stands on a line of its own"
            );
        }
    }

    #[test]
    fn line_with_a_changed_byte_is_no_row() {
        let good = line(&row(1)).into_bytes();
        for at in 9..good.len() - 1 {
            let mut bad = good.clone();
            bad[at] ^= 1;
            assert_eq!(read(&bad), None, "byte {at}");
        }
    }

    #[test]
    fn journal_of_another_process_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("journal");
        let _held = Journal::open(&path).expect("a file").expect("free");
        assert!(Journal::open(&path).expect("a file").is_none());
    }
}
