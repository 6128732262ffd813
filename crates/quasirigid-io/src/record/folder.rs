//! A record on disk: one folder, `record.json` and a CSV file per history.

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::table::{history_csv, read_rows};
use super::{HistoryRecord, RecordError, RunRecord};

impl RunRecord {
    /// Writes the record into an existing empty folder: the histories first, then `record.json`, so that a folder
    /// with a `record.json` is complete.
    ///
    /// # Errors
    /// [`RecordError`]; names and lengths are checked before the first file is made.
    pub fn write(&self, dir: &Path) -> Result<(), RecordError> {
        check_empty(dir)?;
        self.check_histories()?;
        for history in &self.histories {
            create(&history_file(dir, history), |out| history_csv(&history.columns, out))?;
        }
        create(&dir.join("record.json"), |out| {
            serde_json::to_writer_pretty(&mut *out, self)?;
            out.write_all(b"\n")
        })
    }

    /// Reads back what [`write`](Self::write) wrote, bit for bit. Other files in the folder are ignored.
    ///
    /// # Errors
    /// [`RecordError`] with the file, and the line where there is one.
    pub fn read(dir: &Path) -> Result<Self, RecordError> {
        let file = dir.join("record.json");
        let text = fs::read(&file).map_err(|error| unusable(&file, &error))?;
        let mut record: Self = serde_json::from_slice(&text).map_err(|error| RecordError::Json {
            line: error.line(),
            column: error.column(),
            problem: problem(&error),
            file,
        })?;
        record.check_histories()?;
        for history in &mut record.histories {
            let file = history_file(dir, history);
            let input = File::open(&file).map_err(|error| unusable(&file, &error))?;
            read_rows(&mut history.columns, input, &file)?;
        }
        Ok(record)
    }

    fn check_histories(&self) -> Result<(), RecordError> {
        let mut seen = HashSet::new();
        for history in &self.histories {
            let system = history.system.clone();
            let plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '-' || letter == '_';
            if system.is_empty() || !system.chars().all(plain) {
                return Err(RecordError::SystemName { system });
            }
            if !seen.insert(system.to_ascii_lowercase()) {
                return Err(RecordError::SameSystem { system }); // some file systems fold case
            }
            check_lengths(history)?;
        }
        Ok(())
    }
}

fn check_lengths(history: &HistoryRecord) -> Result<(), RecordError> {
    let expected = history.columns.first().map_or(0, |column| column.values.len());
    match history.columns.iter().find(|column| column.values.len() != expected) {
        None => Ok(()),
        Some(column) => Err(RecordError::Ragged {
            system: history.system.clone(),
            column: column.name.clone(),
            rows: column.values.len(),
            expected,
        }),
    }
}

fn check_empty(dir: &Path) -> Result<(), RecordError> {
    if !dir.is_dir() {
        return Err(RecordError::NoFolder { folder: dir.into() });
    }
    let mut entries = fs::read_dir(dir).map_err(|error| unusable(dir, &error))?;
    match entries.next() {
        None => Ok(()),
        Some(entry) => Err(RecordError::NotEmpty {
            folder: dir.into(),
            found: entry.map_or_else(|_| "?".into(), |entry| entry.file_name().to_string_lossy().into()),
        }),
    }
}

/// Makes a new file and fills it; never overwrites one.
fn create(file: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), RecordError> {
    File::create_new(file)
        .and_then(|new| {
            let mut out = BufWriter::new(new);
            fill(&mut out)?;
            out.flush()
        })
        .map_err(|error| unusable(file, &error))
}

fn history_file(dir: &Path, history: &HistoryRecord) -> PathBuf {
    dir.join(format!("history-{}.csv", history.system))
}

fn unusable(file: &Path, error: &io::Error) -> RecordError {
    RecordError::File { file: file.into(), kind: error.kind() }
}

/// The message without the place that serde_json adds at its end.
fn problem(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    text.strip_suffix(&place).unwrap_or(&text).into()
}
