//! Files and lines of a deck: lines are numbered on through the files that it includes, so that a problem is told by file and line.

use std::path::PathBuf;

use crate::matrix::error::MatrixError;
use crate::matrix::listed::LocatedProblem;
use crate::text_file::Place;

/// The files of a deck, and the runs of their lines.
#[derive(Clone, Default)]
pub(crate) struct Places {
    pub files: Vec<PathBuf>,
    /// In the order in which they are read.
    pub runs: Vec<Run>,
    /// Byte from which each line comes, of a file that is no text.
    pub bytes: Vec<usize>,
}

/// Lines of a file that follow each other.
#[derive(Clone, Copy)]
pub(crate) struct Run {
    /// Index of the file.
    pub file: usize,
    /// Number of the first line in its file, and among all.
    pub lines: [usize; 2],
}

impl Places {
    /// The error of a problem on a line, or of the whole deck for line 0.
    pub fn located(&self, (line, problem): LocatedProblem) -> MatrixError {
        if let (0, Some(file)) = (line, self.files.first()) {
            return MatrixError { file: file.clone(), place: Place::File, problem };
        }
        if let Some(byte) = line.checked_sub(1).and_then(|line| self.bytes.get(line)) {
            let file = self.files.first().cloned().unwrap_or_default();
            return MatrixError { file, place: Place::Byte(*byte), problem };
        }
        let run = self.runs.partition_point(|run| run.lines[1] <= line).saturating_sub(1);
        let Some(run) = self.runs.get(run) else {
            return MatrixError { file: PathBuf::new(), place: Place::File, problem };
        };
        let place = Place::Line(run.lines[0] + line.saturating_sub(run.lines[1]));
        MatrixError { file: self.files[run.file].clone(), place, problem }
    }
}
