//! Waits until files and the names in folders are on the disk, so that a loss of power takes nothing that was said to be written.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::Path;

/// Waits until the contents of a file are on the disk. A file system without this operation is trusted.
///
/// # Errors
/// Those of the system.
pub fn settle(file: &File) -> io::Result<()> {
    match file.sync_all() {
        Err(error) if no_such_call(&error) => Ok(()),
        other => other,
    }
}

/// Waits until the names in a folder are on the disk; where folders cannot be opened the system does that itself.
///
/// # Errors
/// Those of the system.
pub fn settle_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) { settle(&File::open(folder)?) } else { Ok(()) }
}

/// Whether an error says that the system or the file system has no such operation.
#[must_use]
pub fn no_such_call(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::InvalidInput)
}
