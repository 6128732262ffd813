//! A record on disk: one folder, `record.json` and a table for each history, and one of the evolution.

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use quasirigid_math::memory;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::scene::{SCENE_VERSION, SceneRecord};
use super::table::{Extremes, RowTable, Rows, TableFormat, history_csv};
use super::{Column, EvolutionRecord, HistoryRecord, RECORD_FORMAT, RecordError, RunRecord};
use crate::disk::{is_no_file, read_regular, replace};
use crate::visible::shortened;

/// File of the evolution's rows, without the ending.
const EVOLUTION: &str = "evolution";
/// File of the backbone of the reduced equations about the spin, without the ending.
const BACKBONE: &str = "backbone";
/// Most rows of a table whose rows the record does not count; `evolve` writes up to a million.
const MAX_UNCOUNTED_ROWS: u64 = 2_000_000;
/// Bytes in memory for each byte of JSON: its text, and numbers of two digits as eight bytes in vectors that grow.
const IN_MEMORY: f64 = 8.0;
/// Ending of the log of rows of a run in work.
pub const ROW_LOG: &str = "rows";
/// Status of a history in work.
pub const UNFINISHED: &str = "unfinished";
/// File of everything but rows.
const RECORD: &str = "record.json";
/// File of what a viewer draws.
const SCENE: &str = "scene.json";

impl RunRecord {
    /// Writes the record into an existing empty folder, with its tables in these formats: the tables first, then `record.json`, so that a
    /// folder with a `record.json` is complete.
    ///
    /// # Errors
    /// [`RecordError`]; names and lengths are checked before the first file is made.
    pub fn write(&self, dir: &Path, formats: &[TableFormat]) -> Result<(), RecordError> {
        check_empty(dir)?;
        self.check_names()?;
        self.tables().try_for_each(|table| check_lengths(&table.stem, table.columns))?;
        if let Some(thinned) =
            self.histories.iter().find(|history| history.log.is_none() && !history.is_whole())
        {
            return Err(RecordError::Thinned { system: thinned.system.clone() });
        }
        let inputs = self.inputs.as_ref().map(serde_json::to_string).transpose().unwrap_or_default();
        for table in self.tables() {
            for format in formats {
                let file = dir.join(format!("{}.{}", table.stem, format.ending()));
                format.write(&file, (table.columns, inputs.as_deref()), table.rows())?;
            }
        }
        if let Some(scene) = &self.scene {
            create(&dir.join(SCENE), |out| Ok(serde_json::to_writer(out, scene)?))?;
        }
        create(&dir.join(RECORD), |out| {
            serde_json::to_writer_pretty(&mut *out, self)?;
            out.write_all(b"\n")
        })
    }

    /// Writes the record of a run in work over an older one, without tables of histories, which the run logs. The record is on the disk
    /// when this returns.
    ///
    /// # Errors
    /// [`RecordError`].
    pub fn write_unfinished(&self, dir: &Path) -> Result<(), RecordError> {
        let evolution = self.evolution.iter().map(|evolution| (EVOLUTION, &evolution.columns));
        let backbone = self.about_spin.iter().map(|about| (BACKBONE, &about.columns));
        for (stem, columns) in evolution.chain(backbone) {
            let file = dir.join(format!("{stem}.{}", TableFormat::Csv.ending()));
            replace(&file, |out| history_csv(columns, out)).map_err(|error| unusable(&file, &error))?;
        }
        let file = dir.join(RECORD);
        replace(&file, |out| Ok(serde_json::to_writer_pretty(out, self)?))
            .map_err(|error| unusable(&file, &error))
    }

    /// Formats of the tables where none are asked for: CSV, or Parquet beside a history that is not kept whole.
    #[must_use]
    pub fn usual_formats(&self) -> &'static [TableFormat] {
        let long = self.histories.iter().any(|history| history.log.is_some());
        if long { &[TableFormat::Parquet] } else { &[TableFormat::Csv] }
    }

    /// Reads a record that [`write`](Self::write) wrote, finite numbers bit for bit; of a table of more than [`MOST_ROWS`](super::MOST_ROWS) rows those with
    /// the extremes of each of a thousand intervals. Other files in the folder are ignored. The folder of a run in work is read up to the
    /// last row there.
    ///
    /// # Errors
    /// [`RecordError`] with the file, and the line where there is one.
    pub fn read(dir: &Path) -> Result<Self, RecordError> {
        let mut record: Self = read_record(dir.join(RECORD))?;
        let scene = dir.join(SCENE);
        if scene.exists() {
            record.scene = Some(read_scene(scene)?);
        }
        record.check_names()?;
        record.evolution.iter_mut().for_each(EvolutionRecord::restore_unknown);
        for history in &mut record.histories {
            read_history(dir, history)?;
        }
        let evolution = record.evolution.iter_mut().map(|evolution| (EVOLUTION, &mut evolution.columns));
        let backbone = record.about_spin.iter_mut().map(|about| (BACKBONE, &mut about.columns));
        for (stem, columns) in evolution.chain(backbone) {
            let (file, format) = found(dir, stem)?;
            let mut rows = Extremes::new(columns, 0);
            format.read(&file, columns, &mut |row| {
                if rows.rows() == MAX_UNCOUNTED_ROWS {
                    return Err(RecordError::TooLong { file: file.clone(), most: MAX_UNCOUNTED_ROWS });
                }
                rows.push(row);
                Ok(())
            })?;
            *columns = rows.into_columns();
        }
        Ok(record)
    }

    /// Names of the files that [`write`](Self::write) makes, with tables in any format.
    #[must_use]
    pub fn files(&self) -> Vec<String> {
        let tables = self
            .tables()
            .flat_map(|table| TableFormat::ALL.map(|format| format!("{}.{}", table.stem, format.ending())));
        let scene = self.scene.iter().map(|_| SCENE.to_owned());
        tables.chain(scene).chain([RECORD.to_owned()]).collect()
    }

    /// Every table.
    fn tables(&self) -> impl Iterator<Item = Table<'_>> {
        let histories = self.histories.iter().map(|history| Table {
            stem: history_stem(&history.system),
            columns: &history.columns,
            log: history.log.as_ref(),
        });
        let evolution = self.evolution.iter().map(|evolution| (EVOLUTION, &evolution.columns));
        let backbone = self.about_spin.iter().map(|about| (BACKBONE, &about.columns));
        let others = evolution.chain(backbone);
        histories.chain(others.map(|(stem, columns)| Table { stem: stem.into(), columns, log: None }))
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

/// A table of a record.
struct Table<'a> {
    /// Name of its files without the ending.
    stem: String,
    columns: &'a Vec<Column>,
    log: Option<&'a RowTable>,
}

impl<'a> Table<'a> {
    fn rows(&self) -> &'a dyn Rows {
        match self.log {
            Some(log) => log,
            None => self.columns,
        }
    }
}

/// The rows of a history, from its table, or from the log of a run in work.
fn read_history(dir: &Path, history: &mut HistoryRecord) -> Result<(), RecordError> {
    let log = dir.join(history_file(&history.system, ROW_LOG));
    if log.exists() {
        let table = RowTable::open(&log, history.columns.len())?;
        let mut rows = Extremes::new(&history.columns, table.rows());
        table.for_each(|row| rows.push(row))?;
        (history.rows, history.columns) = (table.rows(), rows.into_columns());
        if history.status == UNFINISHED {
            history.sum_up();
        }
    } else {
        let (file, format) = found(dir, &history_stem(&history.system))?;
        let mut count = Count::new(&file, history.rows);
        let mut rows = Extremes::new(&history.columns, history.rows);
        format.read(&file, &history.columns, &mut |row| {
            count.take()?;
            rows.push(row);
            Ok(())
        })?;
        count.end()?;
        history.columns = rows.into_columns();
    }
    Ok(())
}

/// Count of the rows of a table. A few bytes may stand for any number of rows, so the room in memory goes by what the record says.
struct Count<'a> {
    file: &'a Path,
    found: u64,
    /// Rows that the record says; zero where it does not.
    expected: u64,
}

impl<'a> Count<'a> {
    fn new(file: &'a Path, expected: u64) -> Self {
        Self { file, found: 0, expected }
    }

    /// Refuses a row that is too many.
    fn take(&mut self) -> Result<(), RecordError> {
        self.found += 1;
        match self.expected {
            0 if self.found > MAX_UNCOUNTED_ROWS => {
                Err(RecordError::TooLong { file: self.file.into(), most: MAX_UNCOUNTED_ROWS })
            }
            0 => Ok(()),
            expected if self.found > expected => Err(self.wrong()),
            _ => Ok(()),
        }
    }

    /// Refuses a table that ends too early.
    fn end(&self) -> Result<(), RecordError> {
        if self.expected == 0 || self.found == self.expected { Ok(()) } else { Err(self.wrong()) }
    }

    fn wrong(&self) -> RecordError {
        RecordError::Rows { file: self.file.into(), found: self.found, expected: self.expected }
    }
}

impl HistoryRecord {
    /// Every row of the history, from its table in the folder of the record.
    ///
    /// # Errors
    /// Those of [`RunRecord::read`].
    pub fn whole_table(&self, dir: &Path) -> Result<Vec<Column>, RecordError> {
        let (file, format) = found(dir, &history_stem(&self.system))?;
        let empty = |column: &Column| Column { values: Vec::new(), ..column.clone() };
        let names: Vec<Column> = self.columns.iter().map(empty).collect();
        let size = self.rows as f64 * (size_of::<f64>() * names.len()) as f64;
        memory::ask(size).map_err(|cause| RecordError::Memory { file: file.clone(), cause })?;
        let mut columns = names.clone();
        let mut count = Count::new(&file, self.rows);
        format.read(&file, &names, &mut |row| {
            count.take()?;
            columns.iter_mut().zip(row).for_each(|(column, number)| column.values.push(*number));
            Ok(())
        })?;
        count.end()?;
        Ok(columns)
    }
}

/// The file of a table, in the first format that is there.
fn found(dir: &Path, stem: &str) -> Result<(PathBuf, TableFormat), RecordError> {
    let file = |format: TableFormat| dir.join(format!("{stem}.{}", format.ending()));
    let there = TableFormat::ALL.into_iter().find(|format| file(*format).exists());
    there.map(|format| (file(format), format)).ok_or_else(|| RecordError::NoTable {
        folder: dir.into(),
        table: stem.into(),
        endings: TableFormat::ALL.map(TableFormat::ending),
    })
}

/// Reads the numbers of a record. The number of its layout is looked at first, since another layout would fail elsewhere, in words that
/// lead astray; likewise of a scene.
fn read_record(file: PathBuf) -> Result<RunRecord, RecordError> {
    #[derive(Deserialize)]
    struct Layout {
        format: Option<u32>,
    }
    let text = read_text(&file)?;
    let Layout { format } = parse(&file, &text)?;
    match format {
        Some(format) if !(1..=RECORD_FORMAT).contains(&format) => {
            Err(RecordError::Format { file, format, known: RECORD_FORMAT })
        }
        _ => parse(&file, &text), // records of the first versions have no number
    }
}

fn read_scene(file: PathBuf) -> Result<SceneRecord, RecordError> {
    #[derive(Deserialize)]
    struct Layout {
        version: u32,
    }
    let text = read_text(&file)?;
    let Layout { version } = parse(&file, &text)?;
    if version != SCENE_VERSION {
        return Err(RecordError::SceneVersion { file, version });
    }
    let scene: SceneRecord = parse(&file, &text)?;
    match scene.damage() {
        None => Ok(scene),
        Some(part) => {
            Err(RecordError::Table { file, problem: format!("{part} do not fit the rest of the scene") })
        }
    }
}

/// The text of a file, if memory has room for it and for what stands in it.
fn read_text(file: &Path) -> Result<Vec<u8>, RecordError> {
    let unread = |error: io::Error| unusable(file, &error);
    let size = file.metadata().map_err(unread)?.len();
    memory::ask(IN_MEMORY * size as f64).map_err(|cause| RecordError::Memory { file: file.into(), cause })?;
    read_regular(file).map_err(unread)
}

fn parse<T: DeserializeOwned>(file: &Path, text: &[u8]) -> Result<T, RecordError> {
    serde_json::from_slice(text).map_err(|error| RecordError::Json {
        line: error.line(),
        column: error.column(),
        problem: problem(&error),
        file: file.into(),
    })
}

pub(super) fn check_lengths(file: &str, columns: &[Column]) -> Result<(), RecordError> {
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

/// Name of the files of a history's rows, without the ending.
fn history_stem(system: &str) -> String {
    format!("history-{system}")
}

/// Name of a file of a history with this ending.
#[must_use]
pub fn history_file(system: &str, ending: &str) -> String {
    format!("{}.{ending}", history_stem(system))
}

pub(super) fn unusable(file: &Path, error: &io::Error) -> RecordError {
    match is_no_file(error) {
        true => RecordError::NoFile { file: file.into() },
        false => RecordError::File { file: file.into(), kind: error.kind() },
    }
}

/// The message without the place that serde_json adds at its end.
fn problem(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    shortened(text.strip_suffix(&place).unwrap_or(&text)).into()
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
        let error = crate::record::history_csv(&[column], Full).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        let said = unusable(Path::new("history-full.csv"), &error).to_string();
        assert!(said.starts_with("history-full.csv: no storage space; "), "{said}");
    }
}
