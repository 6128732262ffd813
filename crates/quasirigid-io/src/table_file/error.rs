use std::io::ErrorKind;
use std::path::PathBuf;

use thiserror::Error;

/// Table that cannot be read or written.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TableError {
    /// A file that the operating system refuses.
    #[error("{}: {}", file.display(), refused(*kind))]
    File {
        /// The file.
        file: PathBuf,
        /// Error kind that the operating system reports.
        kind: ErrorKind,
    },
    /// A folder, a pipe or a device in place of a file.
    #[error("{}: this is not a regular file but a folder, a pipe or a device", file.display())]
    NoFile {
        /// The path.
        file: PathBuf,
    },
    /// A CSV file with a quotation mark in the line of the names that is not closed on it.
    #[error("{}: a quotation mark in the line of the names is not closed on that line; close it", file.display())]
    Names {
        /// The file.
        file: PathBuf,
    },
    /// A VOTable or a workbook that cannot be read.
    #[error("{}: {problem}", file.display())]
    Form {
        /// The file.
        file: PathBuf,
        /// Problem, with advice.
        problem: String,
    },
    /// A Parquet file that cannot be read or written.
    #[error("{}: {cause}; files without compression or with Snappy are read", file.display())]
    Parquet {
        /// The file.
        file: PathBuf,
        /// Message of the library.
        cause: String,
    },
    /// A table without rows.
    #[error("{}: the table has no rows; give one for each body", file.display())]
    Empty {
        /// The file.
        file: PathBuf,
    },
    /// A column with values and without a name.
    #[error("{}: column {column} has values but no name; name it in the first line", file.display())]
    Unnamed {
        /// The file.
        file: PathBuf,
        /// Number of the column, from 1.
        column: usize,
    },
}

fn refused(kind: ErrorKind) -> String {
    match kind {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        kind => kind.to_string(),
    }
}
