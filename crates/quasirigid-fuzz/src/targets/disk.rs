//! A folder for readers that take a path.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

thread_local! {
    static FOLDER: TempDir = tempfile::tempdir().expect("the system gives a folder for files of a while");
}

/// Calls a function with a folder that has these files and no others.
pub fn with_files(files: &[(&str, &[u8])], work: impl FnOnce(&Path)) {
    FOLDER.with(|folder| {
        for entry in fs::read_dir(folder.path()).into_iter().flatten().flatten() {
            let path = entry.path();
            let gone = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
            gone.expect("the entry was made here");
        }
        for (name, bytes) in files {
            let path = folder.path().join(name);
            path.parent().map(fs::create_dir_all).transpose().expect("the folder is writable");
            fs::write(path, bytes).expect("the folder is writable");
        }
        work(folder.path());
    });
}

/// Calls a function with the path of a file.
pub fn with_file(name: &str, bytes: &[u8], work: impl FnOnce(&Path)) {
    with_files(&[(name, bytes)], |folder| work(&folder.join(name)));
}
