//! Errors of records: files that cannot be written, and files that are no record.
//! Each names its file, and the line where there is one; records are never overwritten, so a folder in use is an error.

use std::io::ErrorKind;
use std::path::PathBuf;

use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

use super::scene::SCENE_VERSION;
use crate::visible::{Excerpt, shortened};

/// Problem of a record that could not be written or read.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RecordError {
    /// The folder to write into does not exist, or is a file.
    #[error("{}: no such folder; create it first", folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder to write into holds something already.
    #[error("{}: not empty, it holds {found:?}; records are never overwritten, so name an empty folder", folder.display())]
    NotEmpty {
        /// The folder.
        folder: PathBuf,
        /// A file that the folder holds.
        found: String,
    },
    /// A history whose name cannot be part of a file name.
    #[error("history {system:?}: the name becomes part of a file name; use letters, digits, - and _ only")]
    SystemName {
        /// Name of the history.
        system: String,
    },
    /// Two histories that would share a file.
    #[error("two histories are named {system:?}; each needs a file of its own, so rename one")]
    SameSystem {
        /// Name of both.
        system: String,
    },
    /// Columns of unequal length.
    #[error("{file}: column {column:?} has {rows} rows, the first column {expected}; give all the same")]
    Ragged {
        /// Name of the file the columns would go to.
        file: String,
        /// The column that differs.
        column: String,
        /// Rows of the column.
        rows: usize,
        /// Rows of the first column.
        expected: usize,
    },
    /// A file that cannot be opened, read or written.
    #[error("{}: {kind}; is this the folder of a run, is it readable and writable, is the disk full?", file.display())]
    File {
        /// The file.
        file: PathBuf,
        /// Error kind that the operating system reports.
        kind: ErrorKind,
    },
    /// A folder, a pipe or a device in place of a file, perhaps behind a link.
    #[error("{}: this is not a regular file but a folder, a pipe or a device, which no run writes", file.display())]
    NoFile {
        /// The path.
        file: PathBuf,
    },
    /// A `record.json` that is no record.
    #[error("{}:{line}:{column}: {problem}; edited, cut short, or of another version? run the model again", file.display())]
    Json {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Message of the JSON reader.
        problem: String,
    },
    /// A record whose folder has a layout that is not known.
    #[error(
        "{}: record of format {format}, and {known} is the last that this program reads; use the quasirigid that made the run",
        file.display()
    )]
    Format {
        /// The file.
        file: PathBuf,
        /// Version of its layout.
        format: u32,
        /// Last version that is read.
        known: u32,
    },
    /// A scene of another version.
    #[error("{}: scene of version {version}, this program reads {SCENE_VERSION}; run the model again, or use the quasirigid that made the run", file.display())]
    SceneVersion {
        /// The file.
        file: PathBuf,
        /// Its version.
        version: u32,
    },
    /// A CSV file whose header differs from the columns that `record.json` lists.
    #[error("{}:1: columns are {}, record.json says {expected:?}; take both files from the same run", file.display(), shortened(&format!("{found:?}")))]
    Header {
        /// The file.
        file: PathBuf,
        /// Columns that `record.json` lists.
        expected: Vec<String>,
        /// Columns of the file.
        found: Vec<String>,
    },
    /// A row with too few or too many fields.
    #[error("{}:{line}: {fields} fields under {expected} columns; if the file was cut short, run the model again", file.display())]
    Width {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Fields of the row.
        fields: usize,
        /// Columns of the header.
        expected: usize,
    },
    /// A table with other rows than the record says.
    #[error("{}: {} rows, but record.json says {expected}; copy the whole folder, or run the model again", file.display(), found_rows(*found, *expected))]
    Rows {
        /// The file.
        file: PathBuf,
        /// Rows found: all, or the first that is too many.
        found: u64,
        /// Rows that `record.json` says.
        expected: u64,
    },
    /// A table of more rows than any run writes.
    #[error("{}: more than {most} rows, the most that a run writes; run the model again", file.display())]
    TooLong {
        /// The file.
        file: PathBuf,
        /// Most rows.
        most: u64,
    },
    /// A table that has no room in memory.
    #[error("{}: {cause}; ask for fewer rows", file.display())]
    Memory {
        /// The file.
        file: PathBuf,
        /// Memory that it takes.
        cause: TooMuchMemory,
    },
    /// A binary table that is damaged.
    #[error("{}: {problem}; if the file was cut short or edited, run the model again", file.display())]
    Table {
        /// The file.
        file: PathBuf,
        /// Message of its reader.
        problem: String,
    },
    /// A history of which only the extremes are at hand.
    #[error(
        "history {system:?}: of its rows this record has only the extremes, as it was read; copy the folder in place of writing it again"
    )]
    Thinned {
        /// Name of the history.
        system: String,
    },
    /// A table that is in none of the formats.
    #[error("{}: the rows are missing: there is no file {table}.{}; copy the whole folder, or run the model again", folder.display(), endings.join(&format!(", {table}.")))]
    NoTable {
        /// The folder.
        folder: PathBuf,
        /// Name of the file, without its ending.
        table: String,
        /// Endings looked for.
        endings: [&'static str; 3],
    },
    /// A field that is no number.
    #[error("{}:{line}: column {column:?}: {text:?} is not a number; write it like 1.5, 2e-7, NaN or inf", file.display())]
    NotANumber {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// The field.
        text: Excerpt,
    },
}

/// Rows found; a table is left at the first row that is too many.
fn found_rows(found: u64, expected: u64) -> String {
    if found > expected { format!("more than {expected}") } else { found.to_string() }
}
