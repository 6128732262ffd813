//! Errors of attitude files: the problem, the place in the file, the advice; and reasons for which a history cannot be written.

use std::fmt::{self, Display, Formatter};
use std::io::{self, ErrorKind};

use thiserror::Error;

use super::epoch::{Epoch, NoEpoch};
use crate::record::RecordError;
use crate::table_file::TableError;
use crate::text_file::{self, FileError, ReadProblem, Unread};
use crate::visible::Excerpt;

/// A file from which no attitudes can be read, with the place and the problem.
pub type AttitudeError = FileError<AttitudeProblem>;

/// A problem at a place of a file that is yet to be named.
pub(super) type Fault = text_file::Fault<AttitudeProblem>;

/// Problem of an attitude file.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum AttitudeProblem {
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
    #[error("more than {} MiB, the most that is read; cut the history", limit / (1024 * 1024))]
    TooLarge {
        /// Largest size that is read (bytes).
        limit: u64,
    },
    /// A byte that no text has.
    #[error("the byte 0x{byte:02X} is not UTF-8 text; save the text as UTF-8, or is the file damaged?")]
    NotText {
        /// The byte.
        byte: u8,
    },
    /// A file whose beginning is that of no known format.
    #[error(
        "this begins neither as an AEM (CCSDS_AEM_VERS) nor as an attitude file of STK (stk.v.), and is no table; {}",
        if *is_xml { "save the message as keywords and values (KVN), not as XML" } else { "give one of these" }
    )]
    NotAttitude {
        /// Whether it begins as XML does.
        is_xml: bool,
    },
    /// A file without records.
    #[error("the file has no records; was it cut off in writing or copying?")]
    Empty,
    /// A line that has no place here.
    #[error("{found:?} is not allowed here; {line}")]
    Unexpected {
        /// Text found there.
        found: Excerpt,
        /// Kind of line expected there.
        line: Line,
    },
    /// A file that ends too early.
    #[error("the file ends here; {line}; was it cut off in writing or copying?")]
    Ends {
        /// Kind of line expected there.
        line: Line,
    },
    /// A keyword that is missing.
    #[error("{keyword} is missing before this line; add it")]
    Missing {
        /// The keyword.
        keyword: &'static str,
    },
    /// A value of a keyword that is not read.
    #[error("{keyword} = {found:?} is not read; {advice}")]
    Value {
        /// The keyword.
        keyword: &'static str,
        /// Its value.
        found: Excerpt,
        /// Values that are read, or another remedy.
        advice: &'static str,
    },
    /// Segments of different objects or frames.
    #[error("{keyword} differs from that of the segment before; give each segment a file of its own")]
    Differs {
        /// The keyword.
        keyword: &'static str,
    },
    /// A text that should be an epoch.
    #[error("{found:?}: {problem}")]
    Epoch {
        /// The text.
        found: Excerpt,
        /// The problem.
        problem: NoEpoch,
    },
    /// Epochs of UTC on both sides of a leap second.
    #[error("a leap second ends at {leap} UTC, within the history; give the epochs in TAI")]
    LeapSecond {
        /// End of the leap second.
        leap: Epoch,
    },
    /// A word that should be a number.
    #[error("{found:?} is not a finite number; {line}")]
    NotANumber {
        /// The word.
        found: Excerpt,
        /// Kind of line.
        line: Line,
    },
    /// Too few values, or too many.
    #[error("{found} values; {line}")]
    Values {
        /// Number of values found.
        found: usize,
        /// Kind of line.
        line: Line,
    },
    /// A quaternion that is far from a unit quaternion.
    #[error(
        "the quaternion has the norm {norm}, but an attitude is a unit quaternion; is the order of the columns right?"
    )]
    NotUnit {
        /// The norm.
        norm: f64,
    },
    /// A record that does not follow the one before.
    #[error("the time {t} s does not follow {before} s; sort the records, and give each time once")]
    Order {
        /// Time of the record (s).
        t: f64,
        /// Time of the record before (s).
        before: f64,
    },
    /// A number of records that is not the one announced.
    #[error("{found} records, but NumberOfAttitudePoints is {announced}; was the file cut off?")]
    Count {
        /// Number of records.
        found: usize,
        /// Number that the file announces.
        announced: usize,
    },
    /// A table that cannot be read.
    #[error("{0}")]
    Table(TableError),
    /// A table without a column that is needed.
    #[error("there is no column {name:?}; a history has t, qw, qx, qy and qz, and perhaps wx, wy and wz")]
    Column {
        /// Name of the column.
        name: &'static str,
    },
    /// A row of a table that cannot be read.
    #[error("{reason}; mend the line")]
    Row {
        /// The reason.
        reason: String,
    },
    /// A cell of a table that is no number.
    #[error("row {row}, column {name:?}: {found:?} is not a finite number")]
    Cell {
        /// Row, from 1.
        row: usize,
        /// Name of the column.
        name: &'static str,
        /// Text of the cell.
        found: Excerpt,
    },
}

/// Kind of line, whose text says how it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// A keyword with its value.
    Keyword,
    /// `META_START`.
    MetaStart,
    /// A record of an AEM.
    AemRecord {
        /// Its columns.
        columns: &'static str,
    },
    /// A keyword of an STK file.
    StkKeyword,
    /// A record of an STK file.
    StkRecord {
        /// Its columns.
        columns: &'static str,
    },
}

impl Display for Line {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Keyword => f.write_str("a line is KEYWORD = value, COMMENT text, META_STOP or DATA_STOP"),
            Self::MetaStart => f.write_str("a segment begins with META_START"),
            Self::AemRecord { columns } => write!(f, "a record is the epoch and {columns}"),
            Self::StkKeyword => f.write_str("a line is a keyword of STK and its value"),
            Self::StkRecord { columns } => write!(f, "a record is the time in seconds and {columns}"),
        }
    }
}

impl text_file::Line for Line {
    type Problem = AttitudeProblem;

    fn not_a_number(self, found: String) -> AttitudeProblem {
        AttitudeProblem::NotANumber { found: found.into(), line: self }
    }

    fn not_finite(self, found: String) -> AttitudeProblem {
        AttitudeProblem::NotANumber { found: found.into(), line: self }
    }
}

impl ReadProblem for AttitudeProblem {
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

/// A history that cannot be written as an attitude file.
#[non_exhaustive]
#[derive(Debug, Error)]
pub enum Unwritten {
    /// A table without an attitude.
    #[error("the table has no column {name}, and an attitude file needs t, qw, qx, qy and qz")]
    Column {
        /// Name of the column.
        name: &'static str,
    },
    /// A table without rows.
    #[error("the table has no rows, and an attitude file has one at least")]
    Empty,
    /// A number that is NaN or infinite.
    #[error(
        "the row at t = {t} s has a number that is not finite, which an attitude file cannot say; end the history before"
    )]
    NotFinite {
        /// Time of the row (s).
        t: f64,
    },
    /// Rows at one time, or out of order.
    #[error(
        "the times {before} s and {t} s are the same epoch or out of order, and an attitude file needs ascending ones"
    )]
    Order {
        /// Time of a row (s).
        t: f64,
        /// Time of the row before (s).
        before: f64,
    },
    /// A time outside the calendar.
    #[error(
        "t = {t} s after {epoch} is outside the years 1 to 9999; give an earlier epoch, or a shorter history"
    )]
    Beyond {
        /// Time (s).
        t: f64,
        /// Epoch of time zero.
        epoch: Epoch,
    },
    /// A history across a leap second of UTC.
    #[error(
        "a leap second ends at {leap} UTC, within the history; give the time system TAI or TDB, or another epoch"
    )]
    LeapSecond {
        /// End of the leap second.
        leap: Epoch,
    },
    /// A time system that the format does not have.
    #[error("the format has no time system {system}; it takes {allowed}")]
    TimeSystem {
        /// Name of the time system.
        system: &'static str,
        /// Those of the format.
        allowed: &'static str,
    },
    /// A log of rows that cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// What the output reports.
    #[error(transparent)]
    File(#[from] io::Error),
}
