//! Files that were read on the way to a result, each with length and SHA-256 of the very bytes that the reader had.
//! Readers of shapes, meshes and matrices open their files in one place, `text_file`, which notes each here, those that a deck includes too.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// A file that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRead {
    /// Path as the reader opened it.
    pub path: PathBuf,
    /// Length (bytes).
    pub bytes: u64,
    /// SHA-256 of the contents, in hexadecimal.
    pub sha256: String,
}

thread_local! {
    /// Files read in the innermost [`listed`] of this thread; none outside of one.
    static FILES: RefCell<Option<Vec<FileRead>>> = const { RefCell::new(None) };
}

/// Does work, and lists the files that it read on this thread, each once, in the order of reading.
pub(crate) fn listed<T>(work: impl FnOnce() -> T) -> (T, Vec<FileRead>) {
    let outer = FILES.replace(Some(Vec::new()));
    let done = work();
    (done, FILES.replace(outer).unwrap_or_default())
}

/// Notes a file with the bytes that were read of it.
pub(crate) fn note(path: &Path, bytes: &[u8]) {
    FILES.with_borrow_mut(|files| {
        if let Some(files) = files.as_mut().filter(|files| files.iter().all(|file| file.path != path)) {
            files.push(FileRead { path: path.to_owned(), bytes: bytes.len() as u64, sha256: sha256(bytes) });
        }
    });
}

/// SHA-256 of bytes, in hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_noted_once_and_only_where_somebody_lists_them() {
        note(Path::new("before"), b"x");
        let ((), files) = listed(|| {
            note(Path::new("a"), b"abc");
            note(Path::new("a"), b"abc");
            note(Path::new("b"), b"");
        });
        let names: Vec<_> = files.iter().map(|file| (file.path.to_str(), file.bytes)).collect();
        assert_eq!(names, [(Some("a"), 3), (Some("b"), 0)]);
        // of "abc": FIPS 180-4, example B.1
        assert_eq!(files[0].sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!(listed(|| ()).1, []);
    }
}
