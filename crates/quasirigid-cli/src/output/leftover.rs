//! Leftovers of killed runs: told from the temporary files of living ones by a lock that ends with its process.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use quasirigid_io::disk::read_regular;

use super::place::put;

/// Prefix of the names of all temporary files and folders.
pub const PREFIX: &str = ".quasirigid-";
/// File in a temporary folder that its process locks, and the one that names the place of the folder.
const LOCK: &str = "lock";
const PLACE: &str = "place";
/// Age before which a file without a lock may be about to get one.
const FRESH: Duration = Duration::from_secs(60);

/// The folder inside a temporary one that is built, then holds the older record until that is removed.
pub const BUILDING: &str = "new";

/// Temporary files and folders of this process. While the mutex is locked, results are being put in their places.
static OWN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Keeps the program from being ended as long as the guard lives.
pub fn undisturbed() -> MutexGuard<'static, Vec<PathBuf>> {
    OWN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Remembers a file or folder to be removed should the program be ended.
pub fn remember(path: &Path) {
    undisturbed().push(path.into());
}

/// Removes the unfinished files of this process, and ends it, once no result is being put in its place.
pub fn abandon(end: impl FnOnce()) {
    let own = undisturbed();
    for path in own.iter() {
        let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    }
    end();
}

/// Marks a temporary folder as one of a living process, and notes the place of its result.
pub fn claim(folder: &Path, place: &Path) -> io::Result<File> {
    let unlocked = folder.join("unlocked");
    let file = File::create(&unlocked)?;
    let _ = file.try_lock(); // where the file system has no locks nothing is ever taken for a leftover
    fs::write(folder.join(PLACE), place.file_name().unwrap_or_default().as_encoded_bytes())?;
    fs::rename(unlocked, folder.join(LOCK))?;
    Ok(file)
}

/// Removes the leftovers of killed runs in a folder. An older record that was between two places goes back.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let ours = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().starts_with(PREFIX);
    for entry in entries.flatten().filter(ours) {
        let path = entry.path();
        match entry.file_type() {
            Ok(kind) if kind.is_dir() => sweep_folder(&path),
            Ok(kind) if kind.is_file() && is_old(&entry) && dead(&path) => drop(fs::remove_file(&path)),
            _ => {}
        }
    }
}

fn sweep_folder(path: &Path) {
    if !dead(&path.join(LOCK)) {
        return;
    }
    let aside = path.join(format!("{BUILDING}-aside"));
    if let (true, Some(place)) = (aside.exists(), place_of(path))
        && put(&aside, &place).is_err_and(|error| error.kind() != io::ErrorKind::AlreadyExists)
    {
        return; // the older record stays where it is, rather than nowhere
    }
    let _ = fs::remove_dir_all(path);
}

/// Place of the folder that was being built.
fn place_of(path: &Path) -> Option<PathBuf> {
    let name = String::from_utf8(read_regular(&path.join(PLACE)).ok()?).ok()?;
    let plain = Path::new(&name).file_name().is_some_and(|plain| plain == name.as_str());
    plain.then(|| path.with_file_name(name))
}

/// Whether no process holds the lock of a file.
fn dead(path: &Path) -> bool {
    let regular = path.symlink_metadata().is_ok_and(|metadata| metadata.is_file());
    regular && File::open(path).is_ok_and(|file| file.try_lock().is_ok())
}

fn is_old(entry: &fs::DirEntry) -> bool {
    let written = entry.metadata().and_then(|metadata| metadata.modified());
    written.is_ok_and(|written| written.elapsed().is_ok_and(|age| age > FRESH))
}
