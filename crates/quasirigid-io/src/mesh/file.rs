//! Files of meshes as bytes, and how they write numbers.

use std::path::Path;

use super::error::{MeshError, MeshProblem, Place};
use crate::file::{self, Unread};

/// Largest file that is read (bytes): twenty million triangles as binary STL.
pub(super) const LARGEST: u64 = 1024 * 1024 * 1024;

/// How the numbers of a file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The bytes of a file, which are at most [`LARGEST`].
pub(super) fn bytes_of(file: &Path) -> Result<Vec<u8>, MeshError> {
    let problem = |unread: Unread| match unread {
        Unread::Unreadable(kind) => MeshProblem::Unreadable { kind },
        Unread::Folder => MeshProblem::Folder,
        Unread::NoFile => MeshProblem::NoFile,
        Unread::TooLarge => MeshProblem::TooLarge { limit: LARGEST },
    };
    file::bytes_of(file, LARGEST).map_err(|unread| MeshError {
        file: file.to_owned(),
        place: Place::File,
        problem: problem(unread),
    })
}
