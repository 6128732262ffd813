//! Rows answered by other processes: blocks of rows for the workers of a cluster, and their answers brought together.
//! An answer travels as lines of a journal, which keep every bit, so that the files are those of a run in one process.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::folder::{Folder, tidy};
use super::journal::{line, read};
use super::part::{Opened, PartInWork};
use super::row::RowAnswer;
use super::run::{Finished, finished};
use super::{Sweep, SweepError};

impl Sweep {
    /// Answers rows, one after the other: lines of a journal, for [`Collector::keep`].
    ///
    /// # Errors
    /// [`SweepError::NoRow`].
    pub fn answer_lines(&self, rows: &[u64]) -> Result<Vec<u8>, SweepError> {
        let lines = rows.iter().map(|row| self.answer(*row).map(|answer| line(&answer)));
        lines.collect::<Result<String, _>>().map(String::into_bytes)
    }
}

/// Collector of rows that other processes answer, into the folder of the study.
///
/// ```
/// use std::sync::Arc;
///
/// use quasirigid_study::sweep::{Collector, Sweep};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/axial-mass/model.toml");
/// # let study = folder.path().join("study.toml");
/// # std::fs::write(&study, format!("model = {model:?}\n[vary]\n\"run.order\" = {{ list = [1, 3] }}\n[answer]\nquantities = [\"check.valid\"]\n"))?;
/// let sweep = Arc::new(Sweep::open(&study, &mut ())?);
/// let mut collector = Collector::open(Arc::clone(&sweep), &folder.path().join("results"), false)?;
/// while let Some(rows) = collector.next(100)? {
///     collector.keep(&sweep.answer_lines(&rows)?)?; // on any machine
/// }
/// assert!(collector.finish()?.summary.is_some());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Collector {
    sweep: Arc<Sweep>,
    path: PathBuf,
    /// Parts with rows in work.
    open: BTreeMap<u64, PartInWork>,
    /// Rows of the part that was opened last that nobody has.
    waiting: Vec<u64>,
    next_part: u64,
    elsewhere: u64,
    done: u64,
}

impl Collector {
    /// Opens the folder of a study, or makes it; one with results is opened only to go on.
    ///
    /// # Errors
    /// [`SweepError`] for a folder that belongs to something else.
    pub fn open(sweep: Arc<Sweep>, folder: &Path, resume: bool) -> Result<Self, SweepError> {
        Folder::open(folder, &sweep, resume)?;
        tidy(folder);
        let path = folder.to_owned();
        let (open, waiting) = (BTreeMap::new(), Vec::new());
        Ok(Self { sweep, path, open, waiting, next_part: 0, elsewhere: 0, done: 0 })
    }

    /// Number of rows with an answer, among the parts that were opened.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done
    }

    /// Rows that nobody has yet, all of one part; none once every row is given out.
    ///
    /// # Errors
    /// [`SweepError`] for a journal that cannot be read.
    pub fn next(&mut self, most: usize) -> Result<Option<Vec<u64>>, SweepError> {
        while self.waiting.is_empty() {
            let sweep = Arc::clone(&self.sweep);
            let folder = Folder::at(&self.path, &sweep);
            let part = self.next_part;
            if part >= folder.parts() {
                return Ok(None);
            }
            self.next_part += 1;
            let rows = folder.rows_of(part);
            self.done += rows.end - rows.start;
            if folder.part(part).is_file() {
                folder.check_part(part)?;
                folder.drop_journal(part);
                continue;
            }
            match Opened::part(&sweep, &folder, part)? {
                Opened::There => {}
                Opened::Elsewhere => self.elsewhere += 1,
                Opened::Work(work) if work.is_whole() => work.write(&folder)?,
                Opened::Work(work) => {
                    self.waiting = work.todo();
                    self.done -= self.waiting.len() as u64;
                    self.open.insert(part, work);
                }
            }
        }
        let rest = self.waiting.split_off(most.clamp(1, self.waiting.len()));
        Ok(Some(std::mem::replace(&mut self.waiting, rest)))
    }

    /// Keeps the answers of rows, and writes the parts that are whole.
    ///
    /// # Errors
    /// [`SweepError::Answer`] for a result of another study, and for files that cannot be written.
    pub fn keep(&mut self, lines: &[u8]) -> Result<(), SweepError> {
        let sweep = Arc::clone(&self.sweep);
        let folder = Folder::at(&self.path, &sweep);
        let answer = |line: &[u8]| read(line).filter(|answer| answer.fits(&sweep.outputs));
        let answers =
            lines.split_inclusive(|byte| *byte == b'\n').map(|line| answer(line).ok_or(SweepError::Answer));
        let mut by_part: BTreeMap<u64, Vec<RowAnswer>> = BTreeMap::new();
        for answer in answers {
            let answer = answer?;
            by_part.entry(folder.part_of(answer.row)).or_default().push(answer);
        }
        for (part, answers) in by_part {
            let Some(work) = self.open.get_mut(&part) else { continue };
            self.done += work.keep(answers)?;
            if work.is_whole()
                && let Some(work) = self.open.remove(&part)
            {
                work.write(&folder)?;
            }
        }
        Ok(())
    }

    /// Ends the collection, with the summary if every part is there.
    ///
    /// # Errors
    /// [`SweepError`] for files that cannot be written.
    pub fn finish(mut self) -> Result<Finished, SweepError> {
        self.open.values_mut().try_for_each(PartInWork::settle)?;
        let folder = Folder::at(&self.path, &self.sweep);
        finished(&self.sweep, &folder, self.elsewhere, !self.open.is_empty())
    }
}
