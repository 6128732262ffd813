//! A record on disk: one folder, `record.json` and a CSV file per history, and one of the evolution.

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use super::scene::{SCENE_VERSION, SceneRecord};
use super::table::{history_csv, read_rows};
use super::{Column, EvolutionRecord, RecordError, RunRecord};

/// File of the evolution's rows.
const EVOLUTION: &str = "evolution.csv";
/// File of everything but rows.
const RECORD: &str = "record.json";
/// File of what a viewer draws.
const SCENE: &str = "scene.json";

impl RunRecord {
    /// Writes the record into an existing empty folder: the CSV files first, then `record.json`, so that a folder
    /// with a `record.json` is complete.
    ///
    /// # Errors
    /// [`RecordError`]; names and lengths are checked before the first file is made.
    pub fn write(&self, dir: &Path) -> Result<(), RecordError> {
        check_empty(dir)?;
        self.check_names()?;
        let tables: Vec<_> = self.tables().collect();
        tables.iter().try_for_each(|(file, columns)| check_lengths(file, columns))?;
        for (file, columns) in tables {
            create(&dir.join(file), |out| history_csv(columns, out))?;
        }
        if let Some(scene) = &self.scene {
            create(&dir.join(SCENE), |out| Ok(serde_json::to_writer(out, scene)?))?;
        }
        create(&dir.join(RECORD), |out| {
            serde_json::to_writer_pretty(&mut *out, self)?;
            out.write_all(b"\n")
        })
    }

    /// Reads a record that [`write`](Self::write) wrote, finite numbers bit for bit. Other files in the folder are ignored.
    ///
    /// # Errors
    /// [`RecordError`] with the file, and the line where there is one.
    pub fn read(dir: &Path) -> Result<Self, RecordError> {
        let mut record: Self = read_json(dir.join(RECORD))?;
        let scene = dir.join(SCENE);
        if scene.exists() {
            record.scene = Some(read_scene(scene)?);
        }
        record.check_names()?;
        record.evolution.iter_mut().for_each(EvolutionRecord::restore_unknown);
        for (file, columns) in record.tables_mut() {
            let file = dir.join(file);
            let input = File::open(&file).map_err(|error| unusable(&file, &error))?;
            read_rows(columns, input, &file)?;
        }
        Ok(record)
    }

    /// Names of the files that [`write`](Self::write) makes.
    #[must_use]
    pub fn files(&self) -> Vec<String> {
        let tables = self.tables().map(|(file, _)| file);
        let scene = self.scene.iter().map(|_| SCENE.to_owned());
        tables.chain(scene).chain([RECORD.to_owned()]).collect()
    }

    /// Every CSV file with its columns.
    fn tables(&self) -> impl Iterator<Item = (String, &Vec<Column>)> {
        let histories =
            self.histories.iter().map(|history| (history_file(&history.system), &history.columns));
        histories.chain(self.evolution.iter().map(|evolution| (EVOLUTION.into(), &evolution.columns)))
    }

    /// Every CSV file with its columns, to be filled.
    fn tables_mut(&mut self) -> impl Iterator<Item = (String, &mut Vec<Column>)> {
        let histories =
            self.histories.iter_mut().map(|history| (history_file(&history.system), &mut history.columns));
        histories.chain(self.evolution.iter_mut().map(|evolution| (EVOLUTION.into(), &mut evolution.columns)))
    }

    fn check_names(&self) -> Result<(), RecordError> {
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
        }
        Ok(())
    }
}

fn read_json<T: DeserializeOwned>(file: PathBuf) -> Result<T, RecordError> {
    let text = fs::read(&file).map_err(|error| unusable(&file, &error))?;
    serde_json::from_slice(&text).map_err(|error| RecordError::Json {
        line: error.line(),
        column: error.column(),
        problem: problem(&error),
        file,
    })
}

fn read_scene(file: PathBuf) -> Result<SceneRecord, RecordError> {
    let scene: SceneRecord = read_json(file.clone())?;
    if scene.version > SCENE_VERSION {
        return Err(RecordError::SceneVersion { file, version: scene.version });
    }
    Ok(scene)
}

fn check_lengths(file: &str, columns: &[Column]) -> Result<(), RecordError> {
    let expected = columns.first().map_or(0, |column| column.values.len());
    match columns.iter().find(|column| column.values.len() != expected) {
        None => Ok(()),
        Some(column) => Err(RecordError::Ragged {
            file: file.into(),
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

fn history_file(system: &str) -> String {
    format!("history-{system}.csv")
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A disk that is full, behind the buffer of a writer of tables.
    struct Full;

    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::Error::from_raw_os_error(28))
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn full_disk_is_called_so() {
        let column = Column { name: "t".into(), unit: "s".into(), values: vec![0.0; 100_000] };
        let error = history_csv(&[column], Full).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        let said = unusable(Path::new("history-full.csv"), &error).to_string();
        assert!(said.starts_with("history-full.csv: no storage space; "), "{said}");
    }
}
