use std::io;
use std::path::PathBuf;

use quasirigid_io::model::ModelError;
use quasirigid_io::table_file::TableError;
use thiserror::Error;

/// Study of many bodies that cannot run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The study file.
    #[error("{0}")]
    File(ModelError),
    /// The model that the study varies.
    #[error("the model of the study: {0}")]
    Model(ModelError),
    /// A file of results.
    #[error("{0}")]
    Table(#[from] TableError),
    /// A study with more rows than are counted.
    #[error("the study has more than {most} rows; take fewer samples, or grids with fewer points")]
    TooLarge {
        /// Most rows of a study.
        most: u64,
    },
    /// A row that the study does not have.
    #[error("there is no row {row}: the study has {rows}, from 0 to {}", rows.saturating_sub(1))]
    NoRow {
        /// Row that was asked for.
        row: u64,
        /// Number of rows.
        rows: u64,
    },
    /// A folder with results of another study, model, table or version of the program.
    #[error("{} holds another study, or this one before a change of its model, its table or the program; choose another folder with -o", folder.display())]
    OtherStudy {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with results of this study.
    #[error("{} is there already, with results of this study; go on with --resume, or choose another folder with -o", folder.display())]
    Exists {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with other files.
    #[error("{} is there already and is no folder of a study, so nothing is written into it; choose another with -o", folder.display())]
    Foreign {
        /// The folder.
        folder: PathBuf,
    },
    /// A shard that is none.
    #[error("shard {index}/{count}: write K/N with K from 1 to N, such as 1/3")]
    Shard {
        /// Number of the shard, from 1.
        index: u64,
        /// Number of shards.
        count: u64,
    },
    /// Threads that the system does not give.
    #[error("no {threads} threads: {cause}; ask for fewer with --threads")]
    Threads {
        /// Number of threads.
        threads: usize,
        /// Message of the system.
        cause: String,
    },
    /// A file that cannot be written or read.
    #[error("{}: {cause}; may the folder be written, is the disk full?", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Cause.
        cause: io::Error,
    },
    /// A model without a table of uncertain keys.
    #[error("{}: the model has no [uncertainty]; add a table such as\n\n    [uncertainty]\n    \"material.rock.density\" = {{ normal = {{ mean = 2000, deviation = 300 }} }}\n", file.display())]
    Certain {
        /// The file.
        file: PathBuf,
    },
    /// Work that was told to end before the first row.
    #[error("interrupted before the first row was answered")]
    Interrupted,
}

impl SweepError {
    /// The mistakes in a study file or its model, if these failed.
    #[must_use]
    pub fn located(&self) -> Option<&ModelError> {
        match self {
            Self::File(error) | Self::Model(error) => Some(error),
            _ => None,
        }
    }

    pub(super) fn io(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        let path = path.into();
        move |cause| Self::Io { path, cause }
    }
}
