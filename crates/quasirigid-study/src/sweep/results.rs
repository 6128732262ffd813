//! Results of a study, read back from its folder.

use std::path::Path;

use quasirigid_io::disk::read_regular;
use quasirigid_io::record::SweepRecord;
use quasirigid_io::table_file::CellColumn;

use super::SweepError;
use super::folder::{SUMMARY, read_parts};

/// Results of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// Columns of all rows, in the order of the files.
    pub columns: Vec<CellColumn>,
    /// Summary.
    pub summary: SweepRecord,
}

/// Reads the results of a study from its folder.
///
/// # Errors
/// [`SweepError::Unfinished`] for a folder without a summary, and [`SweepError`] for files that cannot be read.
pub fn read(folder: &Path) -> Result<Results, SweepError> {
    let path = folder.join(SUMMARY);
    let text = read_regular(&path).map_err(|cause| match cause.kind() {
        std::io::ErrorKind::NotFound => SweepError::Unfinished { folder: folder.to_owned() },
        _ => SweepError::Io { path: path.clone(), cause },
    })?;
    let summary = serde_json::from_slice::<SweepRecord>(&text);
    let summary = summary.map_err(|cause| SweepError::Io { path, cause: cause.into() })?;
    Ok(Results { columns: read_parts(folder, None)?, summary })
}
