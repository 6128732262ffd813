//! Files of text and bytes: limits on their size, their lines and numbers, and the places of their problems.
//!
//! Matrices and meshes share this reader; each words its problems itself, as a `ReadProblem`.

use std::error;
use std::fmt;
use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::{Path, PathBuf};

use crate::files_read;
use crate::visible::shortened;

/// A file that cannot be used, with the place and the problem.
#[derive(Clone, Debug, thiserror::Error, PartialEq)]
#[error("{}{place}: {}", file.display(), shortened(&problem.to_string()))]
pub struct FileError<P: error::Error> {
    /// The file.
    pub file: PathBuf,
    /// Place in the file.
    pub place: Place,
    /// Problem at that place.
    pub problem: P,
}

impl<P: error::Error> FileError<P> {
    /// Names the file of a fault.
    pub(crate) fn new(file: &Path) -> impl Fn(Fault<P>) -> Self + Copy {
        move |(place, problem)| Self { file: file.to_owned(), place, problem }
    }
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The whole file.
    File,
    /// A line of a text, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
    /// A byte of a file inside an archive.
    Member(Box<Member>),
}

/// A place in a file inside an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// The file inside.
    pub name: String,
    /// The byte, from 0.
    pub byte: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(f, ":{line}"),
            Self::Byte(byte) => write!(f, ": byte {byte}"),
            Self::Member(member) => write!(f, ": {}: byte {}", member.name, member.byte),
        }
    }
}

/// What a file is that no reader here knows, in words; nothing of it is quoted.
pub(crate) fn kind_of(bytes: &[u8]) -> &'static str {
    let start = &bytes[..bytes.len().min(1024)];
    let begins = |word: &[u8]| start.get(..word.len()).is_some_and(|found| found.eq_ignore_ascii_case(word));
    if begins(b"<!doctype html") || begins(b"<html") {
        "a web page"
    } else if begins(b"version https://git-lfs") {
        "a pointer of Git LFS in place of the file"
    } else if begins(b"PK\x03\x04") {
        "a ZIP archive"
    } else if begins(b"\x1f\x8b") {
        "packed by gzip"
    } else if start.iter().all(|byte| byte.is_ascii_whitespace() || !byte.is_ascii_control()) {
        "text"
    } else {
        "binary"
    }
}

/// A problem at a place of a file that is yet to be named.
pub(crate) type Fault<P> = (Place, P);

/// Problems that every reader of files has, in its own words.
pub(crate) trait ReadProblem: error::Error {
    /// A file that is not read; at most `limit` bytes would be.
    fn unread(unread: Unread, limit: u64) -> Self;

    /// A byte that no text has.
    fn not_text(byte: u8) -> Self;
}

/// Why a table is not read, in words.
pub(crate) fn unread_table(unread: Unread, limit: u64) -> String {
    match unread {
        Unread::Unreadable(kind) => format!("{kind}; is the name right, and is the file readable?"),
        Unread::Folder | Unread::NoFile => "this is no regular file; give a table in text".to_owned(),
        Unread::TooLarge => format!("more than {} MiB; leave rows out", limit / (1024 * 1024)),
    }
}

/// A byte that no table in text has, in words.
pub(crate) fn no_text_table(byte: u8) -> String {
    format!("the byte 0x{byte:02X} is not UTF-8 text; save the table as UTF-8")
}

/// A kind of line, whose text says how it is written.
pub(crate) trait Line: Copy {
    /// Problems of the files that have such lines.
    type Problem: ReadProblem;

    /// A word that should be a number.
    fn not_a_number(self, found: String) -> Self::Problem;

    /// A number that is NaN or infinite.
    fn not_finite(self, found: String) -> Self::Problem;
}

/// Reason for not reading a file.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unread {
    Unreadable(ErrorKind),
    Folder,
    /// A pipe, a device or the like, which may never end.
    NoFile,
    /// A file with more bytes than the limit.
    TooLarge,
}

/// The bytes of a file on a disk, which are at most `limit`.
pub(crate) fn bytes_of<P: ReadProblem>(file: &Path, limit: u64) -> Result<Vec<u8>, FileError<P>> {
    let read = || {
        let metadata = std::fs::metadata(file).map_err(|error| Unread::Unreadable(error.kind()))?;
        if !metadata.is_file() && !metadata.is_dir() {
            return Err(Unread::NoFile);
        }
        stream_of(file, limit)
    };
    let bytes = read().map_err(|unread| FileError::new(file)((Place::File, P::unread(unread, limit))))?;
    files_read::note(file, &bytes);
    Ok(bytes)
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

/// Bytes that a compressed file may unpack to: a hundred for each of its own, and 64 MiB always.
pub(crate) fn unpacked_limit(size: u64) -> u64 {
    size.saturating_mul(100).max(64 * 1024 * 1024)
}

/// The bytes of a file as text, without a byte order mark.
pub(crate) fn text<P: ReadProblem>(bytes: &[u8]) -> Result<&str, Fault<P>> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let end = error.valid_up_to();
        let line = 1 + bytes[..end].iter().filter(|byte| **byte == b'\n').count();
        (Place::Line(line), P::not_text(bytes[end]))
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// Lines that are not blank, with their numbers from 1.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty())
}

/// The number of the last line.
pub(crate) fn last_line(text: &str) -> usize {
    text.lines().count().max(1)
}

/// A number that counts or labels something.
pub(crate) fn whole<L: Line>(word: &str, row: L) -> Result<u64, L::Problem> {
    word.parse().map_err(|_| row.not_a_number(word.to_owned()))
}

/// A number of rows or columns.
pub(crate) fn size<L: Line>(word: &str, row: L) -> Result<usize, L::Problem> {
    word.parse().map_err(|_| row.not_a_number(word.to_owned()))
}

/// A number; also with the exponent that Fortran writes, `1.5D-3`.
pub(crate) fn number<L: Line>(word: &str, row: L) -> Result<f64, L::Problem> {
    let fortran = |_| word.replace(['D', 'd'], "e").parse();
    word.parse().or_else(fortran).map_err(|_| row.not_a_number(word.to_owned()))
}

/// The number that a word stands for, if it is finite.
pub(crate) fn finite<L: Line>(value: f64, word: &str, row: L) -> Result<f64, L::Problem> {
    if value.is_finite() { Ok(value) } else { Err(row.not_finite(word.to_owned())) }
}
