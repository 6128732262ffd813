//! Errors of histories of other programs: the problem, the place in the file, the advice.

use std::io::ErrorKind;

use thiserror::Error;

use crate::attitude::AttitudeProblem;
use crate::table_file::TableError;
use crate::text_file::{self, FileError, ReadProblem, Unread};
use crate::visible::Excerpt;

/// A file from which no history can be read, with the place and the problem.
pub type HistoryFileError = FileError<HistoryFileProblem>;

/// A problem at a place of a file that is yet to be named.
pub(super) type Fault = text_file::Fault<HistoryFileProblem>;

/// Problem of a file with a history.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HistoryFileProblem {
    /// A file that cannot be read at all.
    #[error("{kind}; is the name right, and is the file readable?")]
    Unreadable {
        /// Error kind that the operating system reports.
        kind: ErrorKind,
    },
    /// A folder, a pipe or a device in place of a file.
    #[error("this is not a regular file but a folder, a pipe or a device; give a file")]
    NoFile,
    /// A file above the largest size that is read.
    #[error("more than {} MiB, the most that is read; leave rows or columns out", limit / (1024 * 1024))]
    TooLarge {
        /// Largest size that is read (bytes).
        limit: u64,
    },
    /// A byte that no text has.
    #[error("the byte 0x{byte:02X} is not UTF-8 text; save the table as UTF-8, or is the file damaged?")]
    NotText {
        /// The byte.
        byte: u8,
    },
    /// A file of another kind.
    #[error("this is {kind}; give a table in text, Parquet, NPZ, or an attitude file (AEM, STK)")]
    Kind {
        /// What the file is.
        kind: &'static str,
    },
    /// A table whose heading cannot be read.
    #[error("{0}")]
    Table(TableError),
    /// An attitude file that cannot be read.
    #[error(transparent)]
    Attitude(AttitudeProblem),
    /// A table without rows.
    #[error("the table has no rows; was the run cut off?")]
    Empty,
    /// A table without a column that is needed.
    #[error(
        "no column is {what}; there are {}; name the columns t, wx, wy, wz, or t, qw, qx, qy, qz, or all of them",
        listed(known)
    )]
    Missing {
        /// What the column would hold.
        what: &'static str,
        /// Names of the columns.
        known: Vec<String>,
    },
    /// Columns that hold the same.
    #[error("the columns {first:?} and {second:?} are both {what}; leave one out, or name it otherwise")]
    Twice {
        /// What both hold.
        what: &'static str,
        /// Name of the one.
        first: Excerpt,
        /// Name of the other.
        second: Excerpt,
    },
    /// A unit of another dimension, or none at all.
    #[error(
        "the column {name:?}: {unit:?} is no unit of {what}; write rad/s, deg/s, rpm or rev/s for rates, s or ms for times"
    )]
    Unit {
        /// Name of the column.
        name: Excerpt,
        /// Unit found.
        unit: Excerpt,
        /// What the column holds.
        what: &'static str,
    },
    /// Rates in different units.
    #[error("the rates are in {first:?} and in {second:?}; write them in one unit")]
    Units {
        /// Unit of the first rate.
        first: Excerpt,
        /// Another unit.
        second: Excerpt,
    },
    /// A cell that is no finite number.
    #[error("{name}: {found:?} is not a finite number; cut the history before it")]
    Cell {
        /// Name of the column.
        name: Excerpt,
        /// Text of the cell.
        found: Excerpt,
    },
    /// A line with another number of values than the heading.
    #[error("{found}; was the file cut off in writing?")]
    Width {
        /// Numbers of values.
        found: String,
    },
    /// A row that does not follow the one before.
    #[error("row {row}: the time {t} does not follow {before}; sort the rows, and give each time once")]
    Order {
        /// Row, from 1.
        row: usize,
        /// Its time, in the unit of the file.
        t: f64,
        /// Time of the row before.
        before: f64,
    },
    /// A quaternion that is far from a unit quaternion.
    #[error(
        "row {row}: the quaternion has the norm {norm}, but an attitude is a unit quaternion; are the columns right?"
    )]
    NotUnit {
        /// Row, from 1.
        row: usize,
        /// The norm.
        norm: f64,
    },
    /// Arrays of an archive that are no columns of one table.
    #[error("{detail}; give arrays of equal length: t, and w or omega of shape (n, 3) or wx, wy, wz")]
    Arrays {
        /// What is wrong.
        detail: String,
    },
}

/// Names in a message.
fn listed(names: &[String]) -> String {
    const MOST: usize = 12;
    let shown: Vec<String> =
        names.iter().take(MOST).map(|name| format!("{:?}", Excerpt::from(name.as_str()))).collect();
    let more = if names.len() > MOST { " and others" } else { "" };
    format!("{}{more}", shown.join(", "))
}

impl ReadProblem for HistoryFileProblem {
    fn unread(unread: Unread, limit: u64) -> Self {
        match unread {
            Unread::Unreadable(kind) => Self::Unreadable { kind },
            Unread::Folder | Unread::NoFile => Self::NoFile,
            Unread::TooLarge => Self::TooLarge { limit },
        }
    }

    fn not_text(byte: u8) -> Self {
        Self::NotText { byte }
    }
}
