//! Folder of a run in work: logs of rows and frames, checkpoints, and the record so far, so that a run that was cut off can be read and
//! goes on with the same bits. The folder appears with the first checkpoint; a run of moments leaves none.

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use quasirigid::dynamics::Checkpoint;
use quasirigid_io::disk::{
    is_temporary, open_regular, parent, read_regular, replace, settle_folder, stands, tidy,
};
use quasirigid_io::record::{ROW_LOG, RowLog, RowTable, RunRecord, history_file};

use crate::error::StudyError;
use crate::hashed::Hashed;
use crate::study::Study;
use quasirigid_io::model::PartialRun;

/// Time between two checkpoints.
const PAUSE: Duration = Duration::from_secs(1);
/// Ending of the log of frames.
const FRAMES: &str = "frames";
/// Ending of checkpoints.
const CHECKPOINT: &str = "checkpoint";
/// File of the identity of the run, which its process locks.
const IDENTITY: &str = "run.identity";
/// Beginning of a checkpoint file.
const MAGIC: &[u8; 8] = b"QRCHECK2";

/// Place of a run in work, and whether it goes on from there.
#[derive(Clone, Debug)]
pub struct Keeping {
    /// Folder of the run in work.
    pub folder: PathBuf,
    /// Whether the run goes on from what is there.
    pub resume: bool,
}

impl Keeping {
    /// Beside the folder of the record.
    #[must_use]
    pub fn beside(folder: &Path, resume: bool) -> Self {
        let mut name = folder.file_name().unwrap_or_default().to_owned();
        name.push("-unfinished");
        Self { folder: folder.with_file_name(name), resume }
    }
}

/// Folder of a run in work.
#[derive(Debug)]
pub(crate) struct KeptRun {
    folder: PathBuf,
    identity: String,
    resumes: bool,
    /// The record as far as it is known; written into the folder.
    record: Option<RunRecord>,
    /// Lock of the folder, once it is made.
    lock: Option<File>,
}

impl KeptRun {
    /// Of a study with these settings.
    ///
    /// # Errors
    /// [`StudyError::KeptRun`] where a folder is there that this run does not go on from, or none is that it should.
    pub fn open(keeping: &Keeping, study: &Study, asked: &PartialRun) -> Result<Self, StudyError> {
        let Keeping { folder, resume } = keeping;
        let identity = identity(study, asked).map_err(wrong(folder))?;
        let mut run = Self { folder: folder.clone(), identity, resumes: *resume, record: None, lock: None };
        let problem = |problem: &'static str| StudyError::KeptRun { folder: folder.clone(), problem };
        match (folder.exists(), resume) {
            (false, false) => {}
            (false, true) => return Err(problem("there is no run here to continue")),
            (true, false) if is_in_work(folder) => {} // by another process, beside whose folder this run makes its own
            (true, false) => {
                return Err(problem(
                    "an interrupted run is here; continue it with {resume}, or remove the folder",
                ));
            }
            (true, true) => {
                let Ok(known) = read_regular(&folder.join(IDENTITY)) else {
                    return Err(problem("there is no run here to continue"));
                };
                if known != run.identity.as_bytes() {
                    return Err(problem(
                        "the run here has another model, other settings, or another version of the program",
                    ));
                }
                run.lock()?;
                tidy(folder);
            }
        }
        Ok(run)
    }

    /// Takes the record so far, with the history that begins.
    pub fn begin(&mut self, record: RunRecord) -> Result<(), StudyError> {
        self.record = Some(record);
        if self.lock.is_some() { self.write_record() } else { Ok(()) }
    }

    /// Makes the folder, if it is not there.
    fn make(&mut self) -> Result<(), StudyError> {
        if self.lock.is_some() {
            return Ok(());
        }
        self.create()?;
        let path = self.folder.join(IDENTITY);
        replace(&path, |out| out.write_all(self.identity.as_bytes())).map_err(wrong(&path))?;
        self.lock()?;
        settle_folder(parent(&self.folder)).map_err(wrong(&self.folder))?;
        self.write_record()
    }

    /// Makes a new folder, beside one that has appeared meanwhile.
    fn create(&mut self) -> Result<(), StudyError> {
        let asked = self.folder.clone();
        for number in 2.. {
            match fs::create_dir(&self.folder) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists && number < 1000 => {
                    let mut name = asked.file_name().unwrap_or_default().to_owned();
                    name.push(format!("-{number}"));
                    self.folder = asked.with_file_name(name);
                }
                made => return made.map_err(wrong(&asked)),
            }
        }
        Ok(())
    }

    fn lock(&mut self) -> Result<(), StudyError> {
        let path = self.folder.join(IDENTITY);
        let file = open_regular(&path).map_err(wrong(&path))?;
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            let problem = "another process is working on this run";
            return Err(StudyError::KeptRun { folder: self.folder.clone(), problem });
        }
        self.lock = Some(file);
        Ok(())
    }

    fn write_record(&self) -> Result<(), StudyError> {
        match &self.record {
            Some(record) => Ok(record.write_unfinished(&self.folder)?),
            None => Ok(()),
        }
    }

    fn path(&self, system: &str, ending: &str) -> PathBuf {
        self.folder.join(history_file(system, ending))
    }

    /// Whether the folder has been made.
    pub fn is_there(&self) -> bool {
        self.lock.is_some()
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Whether the folder stands where this run has it in work, and no other in its stead.
    fn stands(&self) -> bool {
        self.lock.as_ref().is_some_and(|lock| stands(lock, &self.folder.join(IDENTITY)))
    }

    /// Refuses to go on with a folder that was removed, moved or replaced.
    fn check(&self) -> Result<(), StudyError> {
        let problem = "the folder of the run was removed, moved or replaced while the run went on; what was moved can be put back, and gone \
                       on with by {resume}";
        let gone = || StudyError::KeptRun { folder: self.folder.clone(), problem };
        self.stands().then_some(()).ok_or_else(gone)
    }

    /// Removes the files of the run, and the folder if nothing else is in it. A folder that stands there instead is left alone.
    pub fn remove(self) {
        if !self.stands() {
            return;
        }
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if entry.file_name().to_str().is_some_and(is_of_run) {
                let _ = fs::remove_file(entry.path());
            }
        }
        let _ = fs::remove_dir(&self.folder);
    }
}

/// Log of a history: its rows, its frames and its last checkpoint.
#[derive(Debug)]
pub(crate) struct HistoryLog<'r> {
    run: &'r mut KeptRun,
    system: &'static str,
    /// Numbers of a row and of a frame.
    widths: [usize; 2],
    logs: Option<[RowLog; 2]>,
    last: Instant,
}

/// State of a history that goes on.
pub(crate) struct Resumed {
    /// Rows and frames up to the checkpoint.
    pub tables: [RowTable; 2],
    /// The checkpoint.
    pub checkpoint: Checkpoint,
}

impl<'r> HistoryLog<'r> {
    /// Log of a history with rows and frames of so many numbers, and what it goes on from.
    pub fn open(
        run: &'r mut KeptRun,
        system: &'static str,
        widths: [usize; 2],
    ) -> Result<(Self, Option<Resumed>), StudyError> {
        let mut log = Self { run, system, widths, logs: None, last: Instant::now() };
        let file = log.run.path(system, CHECKPOINT);
        if !log.run.resumes || !file.exists() {
            return Ok((log, None));
        }
        let broken = || StudyError::KeptRun {
            folder: log.run.folder.clone(),
            problem: "its checkpoint is damaged; remove the folder and start anew",
        };
        let mut checkpoint = read(&read_regular(&file).map_err(wrong(&file))?).ok_or_else(broken)?;
        let mut logged = || Some((checkpoint.load_count()?, u32::try_from(checkpoint.load_count()?).ok()?));
        let (Some(rows), Some(frames)) = (logged(), logged()) else { return Err(broken()) };
        log.open_logs([Some(rows), Some(frames)])?;
        let [rows, frames] = [ROW_LOG, FRAMES].map(|ending| log.run.path(system, ending));
        let tables = [RowTable::open(&rows, widths[0])?, RowTable::open(&frames, widths[1])?];
        Ok((log, Some(Resumed { tables, checkpoint })))
    }

    /// Opens the logs: new ones, or those that have so many rows with these checksums.
    fn open_logs(&mut self, [rows, frames]: [Option<(u64, u32)>; 2]) -> Result<(), StudyError> {
        let open = |ending: &str, width: usize, logged: Option<(u64, u32)>| {
            let path = self.run.path(self.system, ending);
            let log = match logged {
                Some((count, checksum)) => RowLog::resume(&path, width, count, checksum),
                None => RowLog::create(&path, width),
            };
            log.map_err(wrong(&path))
        };
        let [row, frame] = self.widths;
        self.logs = Some([open(ROW_LOG, row, rows)?, open(FRAMES, frame, frames)?]);
        Ok(())
    }

    /// Whether the log is on the disk.
    pub fn is_open(&self) -> bool {
        self.logs.is_some()
    }

    /// Makes the folder and starts the log; the rows and frames so far are to be pushed.
    pub fn start(&mut self) -> Result<(), StudyError> {
        self.run.make()?;
        self.open_logs([None, None])
    }

    /// Logs a row.
    pub fn row(&mut self, row: &[f64]) -> Result<(), StudyError> {
        self.push(0, row)
    }

    /// Logs a frame.
    pub fn frame(&mut self, frame: &[f64]) -> Result<(), StudyError> {
        self.push(1, frame)
    }

    fn push(&mut self, log: usize, row: &[f64]) -> Result<(), StudyError> {
        match &mut self.logs {
            Some(logs) => logs[log].push(row).map_err(wrong(&self.run.folder)),
            None => Ok(()),
        }
    }

    /// Whether a checkpoint is due.
    pub fn is_due(&self) -> bool {
        self.last.elapsed() >= PAUSE
    }

    /// Puts a checkpoint on the disk, after the rows that it continues.
    pub fn checkpoint(&mut self, state: &Checkpoint) -> Result<(), StudyError> {
        let Some(logs) = &mut self.logs else { return Ok(()) };
        self.run.check()?;
        logs.iter_mut().try_for_each(RowLog::settle).map_err(wrong(&self.run.folder))?;
        let mut whole = Checkpoint::default();
        for log in &*logs {
            whole.save_count(log.rows());
            whole.save_count(log.checksum().into());
        }
        whole.save_rest(state);
        let path = self.run.path(self.system, CHECKPOINT);
        replace(&path, |out| write(out, whole.words())).map_err(wrong(&path))?;
        self.last = Instant::now();
        Ok(())
    }

    /// The rows as a table.
    pub fn into_rows(self) -> Result<Option<RowTable>, StudyError> {
        let Some([rows, _]) = self.logs else { return Ok(None) };
        rows.into_table().map(Some).map_err(wrong(&self.run.folder))
    }
}

/// Whether a living process has a folder in work. One without an identity is being made by it, or is of no run.
fn is_in_work(folder: &Path) -> bool {
    match open_regular(&folder.join(IDENTITY)) {
        Ok(file) => matches!(file.try_lock(), Err(TryLockError::WouldBlock)),
        Err(error) => error.kind() == ErrorKind::NotFound,
    }
}

/// Whether a name is that of a file that a run in work makes, or a report of it.
fn is_of_run(name: &str) -> bool {
    let history = name.strip_prefix("history-").and_then(|rest| rest.rsplit_once('.'));
    let named = ["record.json", "evolution.csv", "backbone.csv", "report.html", IDENTITY].contains(&name);
    named
        || is_temporary(name)
        || history.is_some_and(|(_, ending)| [ROW_LOG, FRAMES, CHECKPOINT].contains(&ending))
}

fn write(out: &mut dyn Write, words: &[u64]) -> io::Result<()> {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    out.write_all(MAGIC)?;
    out.write_all(&crc32fast::hash(&bytes).to_le_bytes())?;
    out.write_all(&bytes)
}

fn read(bytes: &[u8]) -> Option<Checkpoint> {
    let (checksum, bytes) = bytes.strip_prefix(MAGIC)?.split_first_chunk()?;
    let (words, rest) = bytes.as_chunks();
    let whole = rest.is_empty() && u32::from_le_bytes(*checksum) == crc32fast::hash(bytes);
    whole.then(|| Checkpoint::from_words(words.iter().map(|word| u64::from_le_bytes(*word)).collect()))
}

/// Checksum of everything that the bits of a run depend on.
fn identity(study: &Study, asked: &PartialRun) -> io::Result<String> {
    let source = &study.model.source;
    let folder = source.file.parent().unwrap_or(Path::new(""));
    let mut hash = Hashed::default();
    hash.text(env!("CARGO_PKG_VERSION"));
    hash.text(&source.sha256);
    hash.text(&format!("{asked:?} {}", study.order));
    for name in source.files_in(folder) {
        hash.text(&name);
        hash.file(&folder.join(name))?;
    }
    Ok(hash.finish())
}

fn wrong(path: &Path) -> impl FnOnce(io::Error) -> StudyError {
    let path = path.to_owned();
    move |cause| match cause.kind() {
        ErrorKind::UnexpectedEof => StudyError::KeptRun {
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            problem: "its rows are cut short; remove the folder and start anew",
        },
        ErrorKind::InvalidData => StudyError::KeptRun {
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            problem: "its rows are damaged; remove the folder and start anew",
        },
        _ => StudyError::Write { path, cause },
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// The end of a run comes after its last checkpoint, at which the folder was looked at.
    #[cfg(unix)]
    #[test]
    fn folder_in_the_place_of_a_run_that_ends_is_left_alone() {
        let above = tempfile::tempdir().unwrap();
        let folder = above.path().join("out-unfinished");
        let identity = String::new();
        let mut run = KeptRun { folder: folder.clone(), identity, resumes: false, record: None, lock: None };
        run.make().unwrap();
        fs::rename(&folder, above.path().join("moved")).unwrap();
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join("record.json"), "precious").unwrap();
        run.remove();
        assert_eq!(fs::read_to_string(folder.join("record.json")).unwrap(), "precious");
    }
}
