//! Files as bytes, no more of them than a limit.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// Why a file is not read.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unread {
    Unreadable(ErrorKind),
    Folder,
    /// It is a pipe, a device or the like, which may never end.
    NoFile,
    /// It has more bytes than the limit.
    TooLarge,
}

/// The bytes of a file on a disk, which are at most `limit`.
pub(crate) fn bytes_of(file: &Path, limit: u64) -> Result<Vec<u8>, Unread> {
    let metadata = std::fs::metadata(file).map_err(|error| Unread::Unreadable(error.kind()))?;
    if !metadata.is_file() && !metadata.is_dir() {
        return Err(Unread::NoFile);
    }
    stream_of(file, limit)
}

/// The bytes of a file or a pipe, which are at most `limit`.
pub(crate) fn stream_of(file: &Path, limit: u64) -> Result<Vec<u8>, Unread> {
    let unreadable = |error: Error| Unread::Unreadable(error.kind());
    let metadata = std::fs::metadata(file).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(Unread::Folder);
    }
    if metadata.len() > limit {
        return Err(Unread::TooLarge);
    }
    all_of(File::open(file).map_err(unreadable)?, limit)
}

/// The bytes of a stream to its end, which are at most `limit`.
pub(crate) fn all_of(stream: impl Read, limit: u64) -> Result<Vec<u8>, Unread> {
    let mut bytes = Vec::new();
    let read = stream.take(limit + 1).read_to_end(&mut bytes);
    read.map_err(|error| Unread::Unreadable(error.kind()))?;
    if bytes.len() as u64 > limit { Err(Unread::TooLarge) } else { Ok(bytes) }
}
