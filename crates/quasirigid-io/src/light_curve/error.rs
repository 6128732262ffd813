//! Problems of files of light curves.

use thiserror::Error;

use crate::table_file::TableError;
use crate::text_file::{FileError, ReadProblem, Unread, no_text_table, unread_table};

/// A file that is no light curve, with the place and the problem.
pub type LightCurveFileError = FileError<LightCurveProblem>;

/// Problem of a file of a light curve.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LightCurveProblem {
    /// A file that cannot be read at all.
    #[error("{0}")]
    Unread(String),
    /// A file of another kind.
    #[error("this is {kind}; give a table in text, or a file lc.txt of DAMIT")]
    Kind {
        /// What the file is.
        kind: &'static str,
    },
    /// A file without rows.
    #[error("there are no times in this file; give at least one row below the heading")]
    Empty,
    /// A table whose heading cannot be read.
    #[error("{0}")]
    Table(TableError),
    /// A table without the columns of a light curve.
    #[error("{0}")]
    Columns(String),
    /// A line without its numbers.
    #[error("{0}")]
    Line(String),
    /// A row that no light curve has.
    #[error("row {row}: {problem}")]
    Row {
        /// Row, from 1.
        row: usize,
        /// What is wrong.
        problem: String,
    },
}

impl ReadProblem for LightCurveProblem {
    fn unread(unread: Unread, limit: u64) -> Self {
        Self::Unread(unread_table(unread, limit))
    }

    fn not_text(byte: u8) -> Self {
        Self::Unread(no_text_table(byte))
    }
}

/// What is wrong with a time, a place or a brightness, in words.
pub(super) fn wrong(sun: [f64; 3], observer: [f64; 3], brightness: Option<f64>) -> Option<String> {
    let nowhere = |place: [f64; 3]| {
        let size = place.into_iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
        !(size > 0.0 && size.is_finite())
    };
    if nowhere(sun) {
        return Some(
            "the Sun is at the body, which has no light from there; give its place as seen from the body"
                .into(),
        );
    }
    if nowhere(observer) {
        return Some("the observer is at the body; give its place as seen from the body".into());
    }
    let value = brightness.filter(|value| !(*value > 0.0 && value.is_finite()))?;
    Some(format!("the brightness {value} is not positive; give intensities, or a column `magnitude`"))
}
