use std::io;
use std::path::PathBuf;

use quasirigid_io::model::ModelError;
use quasirigid_io::table_file::TableError;
use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

use crate::settings::{Setting, SettingError};

/// Study of many bodies that cannot run. The text names settings by their keys; [`told`](Self::told) has other names for them.
#[derive(Debug, Error)]
#[error("{}", self.told(&Setting::key))]
#[non_exhaustive]
pub enum SweepError {
    /// The study file.
    File(ModelError),
    /// The model that the study varies.
    Model(ModelError),
    /// A file of results.
    Table(TableError),
    /// A study with more rows than are counted.
    TooLarge {
        /// Most rows of a study.
        most: u64,
    },
    /// Rows that have no room in memory.
    Memory {
        /// Number of rows.
        rows: u64,
        /// Memory that they take.
        cause: TooMuchMemory,
    },
    /// A row that the study does not have.
    NoRow {
        /// Number of the row that was asked for, from 1.
        row: u64,
        /// Number of rows.
        rows: u64,
    },
    /// A folder with results of another study, model, table or version of the program.
    OtherStudy {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with results of this study.
    Exists {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder without a summary.
    Unfinished {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with other files.
    Foreign {
        /// The folder.
        folder: PathBuf,
    },
    /// A place for the results in a folder that does not exist.
    NoFolder {
        /// The folder of the results.
        folder: PathBuf,
        /// The folder above.
        above: PathBuf,
    },
    /// Two columns of the results that would have one name.
    SameColumn {
        /// The name.
        name: String,
    },
    /// A key that both the table and the study give.
    GivenTwice {
        /// The key.
        key: String,
    },
    /// A shard that is none.
    Shard {
        /// Number of the shard, from 1.
        index: u64,
        /// Number of shards.
        count: u64,
    },
    /// Threads that the system does not give.
    Threads {
        /// Number of threads.
        threads: usize,
        /// Message of the system.
        cause: String,
    },
    /// A file that cannot be written or read.
    Io {
        /// The file.
        path: PathBuf,
        /// Cause.
        cause: io::Error,
    },
    /// A part of the results that is damaged, or another.
    Part {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A model without a table of uncertain keys.
    Certain {
        /// The file.
        file: PathBuf,
    },
    /// A setting out of its range.
    Setting(SettingError),
    /// Lines that are no answers of this study: another version of the program answered.
    Answer,
    /// Work that was told to end before the first row.
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

    /// The text with the names that an interface has for settings.
    #[must_use]
    pub fn told(&self, name: &dyn Fn(Setting) -> &'static str) -> String {
        let folder_setting = name(Setting::Out);
        match self {
            Self::File(error) => error.to_string(),
            Self::Model(error) => format!("the model of the study: {error}"),
            Self::Table(error) => error.to_string(),
            Self::TooLarge { most } => {
                format!("the study has more than {most} rows; take fewer samples, or grids with fewer points")
            }
            Self::Memory { rows, cause } => {
                format!("{rows} rows are too many here: {cause}; take fewer samples")
            }
            Self::NoRow { row: 0, .. } => {
                "rows are counted from 1, as in the tables of the results: row 0 is now row 1".to_owned()
            }
            Self::NoRow { row, rows } => {
                format!("there is no row {row}: the study has {rows}, from 1 to {rows}")
            }
            Self::OtherStudy { folder } => format!(
                "{} holds another study, or this one before a change of its model, its files or the program; choose another folder with {folder_setting}",
                folder.display()
            ),
            Self::Exists { folder } => format!(
                "{} already exists, with results of this study; continue with {}, or choose another folder with {folder_setting}",
                folder.display(),
                name(Setting::Resume)
            ),
            Self::Unfinished { folder } => format!(
                "{} has no summary of a study: its rows are not all answered, or it is another folder; continue with {}",
                folder.display(),
                name(Setting::Resume)
            ),
            Self::Foreign { folder } => format!(
                "{} already exists and is not the folder of a study, so nothing is written into it; choose another with {folder_setting}",
                folder.display()
            ),
            Self::NoFolder { folder, above } => format!(
                "cannot write {}: there is no folder {}; create it first",
                folder.display(),
                above.display()
            ),
            Self::SameColumn { name } => format!(
                "two columns of the results would be named {name:?}; rename the column of the table, or leave out one of the two"
            ),
            Self::GivenTwice { key } => {
                format!("`{key}` is given by the table and varied by the study; leave out one of the two")
            }
            Self::Shard { index, count } => {
                format!("shard {index}/{count}: write K/N with K from 1 to N, such as 1/3")
            }
            Self::Threads { threads, cause } => {
                format!("no {threads} threads: {cause}; ask for fewer with {}", name(Setting::Threads))
            }
            Self::Io { path, cause } => {
                format!("{}: {cause}; is the folder writable, is the disk full?", path.display())
            }
            Self::Part { path, problem } => format!(
                "{}: {problem}; this is no longer the part that the study wrote: remove the file, and its rows are answered again with {}",
                path.display(),
                name(Setting::Resume)
            ),
            Self::Certain { file } => format!(
                "{}: the model has no [uncertainty]; add a table such as\n\n    [uncertainty]\n    \"material.rock.density\" = {{ normal = {{ mean = 2000, deviation = 300 }} }}\n",
                file.display()
            ),
            Self::Setting(cause) => cause.told(name),
            Self::Answer => {
                "a worker sent a result of another study; does it run the same version?".to_owned()
            }
            Self::Interrupted => "interrupted before the first row was answered".to_owned(),
        }
    }

    pub(super) fn io(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        let path = path.into();
        move |cause| Self::Io { path, cause }
    }
}

impl From<TableError> for SweepError {
    fn from(error: TableError) -> Self {
        Self::Table(error)
    }
}

impl From<SettingError> for SweepError {
    fn from(error: SettingError) -> Self {
        Self::Setting(error)
    }
}
