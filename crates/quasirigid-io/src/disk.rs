//! Files that appear only when they are whole, and wait until they and their names are on the disk, so that a loss of power takes nothing
//! that was said to be written. Every writer of results settles its files here.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

/// Beginning and ending of the names of temporary files.
const BEGINNING: &str = ".quasirigid-";
const ENDING: &str = ".tmp";

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

/// Waits until the names in a folder are on the disk. A folder that may be written but not read is trusted, and so is a system that
/// opens no folders.
///
/// # Errors
/// Those of the system.
pub fn settle_folder(folder: &Path) -> io::Result<()> {
    if !cfg!(unix) {
        return Ok(());
    }
    match File::open(folder) {
        Ok(folder) => settle(&folder),
        Err(error) if error.kind() == ErrorKind::PermissionDenied => Ok(()),
        Err(error) => Err(error),
    }
}

/// Waits until the files in a folder, their contents and their names, are on the disk.
///
/// # Errors
/// Those of the system.
pub fn settle_files(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        settle(&File::open(entry?.path())?)?;
    }
    settle_folder(folder)
}

/// What is read in place of a file: a folder, or a pipe or a device, which may never end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("this is not a regular file but a folder, a pipe or a device")]
struct NoFile;

/// Opens a file on a disk. Records, tables and logs, which are read to their end, are opened here: a pipe would be waited for, and a device
/// read for ever, also where a link leads to it.
///
/// # Errors
/// Those of the system, and one that [`is_no_file`] knows.
pub fn open_regular(path: &Path) -> io::Result<File> {
    if path.metadata()?.is_file() {
        File::open(path)
    } else {
        Err(io::Error::new(ErrorKind::InvalidInput, NoFile))
    }
}

/// Whether an error says that a folder, a pipe or a device stands in place of a file.
#[must_use]
pub fn is_no_file(error: &io::Error) -> bool {
    error.get_ref().is_some_and(|cause| cause.is::<NoFile>())
}

/// The bytes of a file on a disk.
///
/// # Errors
/// Those of [`open_regular`] and of the system.
pub fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Folder of a file.
#[must_use]
pub fn parent(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes a file that appears only when it is whole and on the disk, over an older one of its name.
///
/// # Errors
/// Those of the system and of `write`; the older file then stays.
pub fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let (file, temporary) = temporary(parent(path))?;
    let mut out = BufWriter::new(&file);
    let written = write(&mut out).and_then(|()| out.flush()).and_then(|()| settle(&file));
    written.and_then(|()| fs::rename(&temporary, path)).inspect_err(|_| drop(fs::remove_file(&temporary)))?;
    settle_folder(parent(path))
}

/// A new file, locked as long as it is open: a file of that kind without a lock is the leftover of a killed process.
fn temporary(folder: &Path) -> io::Result<(File, PathBuf)> {
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    loop {
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!("{BEGINNING}{}-{number}{ENDING}", process::id()));
        match File::create_new(&path) {
            // of a process of this number that was killed, or lives on another machine
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
            Ok(file) => {
                let found = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
                if !found && stands(&file, &path) {
                    return Ok((file, path)); // no other process took it for a leftover before it was locked
                }
            }
        }
    }
}

/// Whether a name is that of a temporary file.
#[must_use]
pub fn is_temporary(name: &str) -> bool {
    name.starts_with(BEGINNING) && name.ends_with(ENDING)
}

/// Removes the temporary files that killed processes left in a folder. Where the file system has no locks they stay.
pub fn tidy(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let regular = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !(regular && entry.file_name().to_str().is_some_and(is_temporary)) {
            continue;
        }
        let file = OpenOptions::new().write(true).open(entry.path());
        if file.is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether an open file still stands at its place, and no other in its stead.
#[must_use]
pub fn stands(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let (Ok(one), Ok(other)) = (file.metadata(), path.symlink_metadata()) else { return false };
        (one.dev(), one.ino()) == (other.dev(), other.ino())
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        path.exists()
    }
}

/// Whether an error says that the system or the file system has no such operation.
#[must_use]
pub fn no_such_call(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::InvalidInput)
}
