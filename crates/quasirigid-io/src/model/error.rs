use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::{Diagnostic, Source};

/// A model file that cannot be used.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ModelError {
    /// The file cannot be read at all.
    #[error("{}: {problem}", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Reason of the failure.
        problem: FileProblem,
    },
    /// The file is not a model.
    #[error("{}", Listing { model, diagnostics })]
    Invalid {
        /// The file and its text.
        model: Source,
        /// Diagnostics of the model, in the order of the file.
        diagnostics: Vec<Diagnostic>,
    },
}

/// Problem of a model file that cannot be read.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum FileProblem {
    /// There is no such file.
    #[error("there is no such file")]
    Missing,
    /// A folder in place of a file.
    #[error("this is a folder; give the model file inside it")]
    Folder,
    /// A file above the largest size that is read.
    #[error("the file is larger than {} MiB, the most a model file may have", limit / (1024 * 1024))]
    TooLarge {
        /// Largest size that is read (bytes).
        limit: u64,
    },
    /// The operating system refuses.
    #[error("the file cannot be read: {kind}")]
    Refused {
        /// Error kind that the operating system reports.
        kind: io::ErrorKind,
    },
}

/// One line `file:line:column: message` per diagnostic, and the help in a line below.
struct Listing<'a> {
    model: &'a Source,
    diagnostics: &'a [Diagnostic],
}

impl fmt::Display for Listing<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.diagnostics.iter().enumerate() {
            let (line, column) = diagnostic.position(&self.model.text);
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{}:{line}:{column}: {}", self.model.file.display(), diagnostic.message)?;
            if let Some(help) = &diagnostic.help {
                write!(f, "\n  {help}")?;
            }
        }
        Ok(())
    }
}
