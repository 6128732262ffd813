//! Part in work: its rows with their answers so far, behind its journal, until all are there and the part is written.

use std::ops::Range;
use std::path::PathBuf;

use super::folder::Folder;
use super::journal::Journal;
use super::row::RowAnswer;
use super::{Sweep, SweepError};

/// Part in work, locked by this process.
#[derive(Debug)]
pub(super) struct PartInWork {
    part: u64,
    rows: Range<u64>,
    answers: Vec<Option<RowAnswer>>,
    journal: Journal,
    path: PathBuf,
}

/// State of a part that is asked for.
pub(super) enum Opened {
    /// The part is written.
    There,
    /// Another process has it in work.
    Elsewhere,
    /// It is ours.
    Work(PartInWork),
}

impl Opened {
    /// Opens a part with the rows that its journal has already.
    pub(super) fn part(sweep: &Sweep, folder: &Folder<'_>, part: u64) -> Result<Self, SweepError> {
        let path = folder.journal(part);
        let Some((journal, known)) = Journal::open(&path).map_err(SweepError::io(&path))? else {
            return Ok(Self::Elsewhere);
        };
        if folder.part(part).is_file() {
            // another process finished the part between two looks
            journal.remove().map_err(SweepError::io(&path))?;
            return Ok(Self::There);
        }
        let rows = folder.rows_of(part);
        let mut work =
            PartInWork { part, answers: rows.clone().map(|_| None).collect(), rows, journal, path };
        for answer in known.into_iter().filter(|answer| answer.fits(&sweep.outputs)) {
            if let Some(place) = work.place(answer.row) {
                work.answers[place] = Some(answer);
            }
        }
        Ok(Self::Work(work))
    }
}

impl PartInWork {
    /// Rows without an answer.
    pub(super) fn todo(&self) -> Vec<u64> {
        self.rows
            .clone()
            .zip(&self.answers)
            .filter(|(_, answer)| answer.is_none())
            .map(|(row, _)| row)
            .collect()
    }

    /// Keeps the answers of some of its rows; the number of those that are new.
    pub(super) fn keep(&mut self, mut answers: Vec<RowAnswer>) -> Result<u64, SweepError> {
        answers.retain(|answer| self.place(answer.row).is_some_and(|place| self.answers[place].is_none()));
        self.journal.write(&answers).map_err(SweepError::io(&self.path))?;
        let before = self.missing();
        for answer in answers {
            if let Some(place) = self.place(answer.row) {
                self.answers[place] = Some(answer);
            }
        }
        Ok(before - self.missing())
    }

    /// Waits until the answers that are kept are on the disk.
    pub(super) fn settle(&mut self) -> Result<(), SweepError> {
        self.journal.settle().map_err(SweepError::io(&self.path))
    }

    /// Number of rows without an answer.
    fn missing(&self) -> u64 {
        self.answers.iter().filter(|answer| answer.is_none()).count() as u64
    }

    /// Whether every row has its answer.
    pub(super) fn is_whole(&self) -> bool {
        self.missing() == 0
    }

    /// Writes the part, and removes its journal.
    pub(super) fn write(self, folder: &Folder<'_>) -> Result<(), SweepError> {
        let answers: Vec<RowAnswer> = self.answers.into_iter().flatten().collect();
        folder.write_part(self.part, &answers)?;
        self.journal.remove().map_err(SweepError::io(&self.path))
    }

    fn place(&self, row: u64) -> Option<usize> {
        self.rows.contains(&row).then(|| (row - self.rows.start) as usize)
    }
}
