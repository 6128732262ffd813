//! Files of meshes as bytes.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::error::{MeshError, MeshProblem, Place};

/// Largest file that is read (bytes): twenty million triangles as binary STL.
pub(super) const LARGEST: u64 = 1024 * 1024 * 1024;

/// The bytes of a file, which are at most [`LARGEST`].
pub(super) fn bytes_of(file: &Path) -> Result<Vec<u8>, MeshError> {
    let refused = |problem| MeshError { file: file.to_owned(), place: Place::File, problem };
    let unreadable = |error: std::io::Error| refused(MeshProblem::Unreadable { kind: error.kind() });
    let metadata = std::fs::metadata(file).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(refused(MeshProblem::Folder));
    }
    let mut bytes = Vec::new();
    if metadata.len() <= LARGEST {
        File::open(file)
            .and_then(|open| open.take(LARGEST + 1).read_to_end(&mut bytes))
            .map_err(unreadable)?;
    }
    if metadata.len().max(bytes.len() as u64) > LARGEST {
        return Err(refused(MeshProblem::TooLarge { limit: LARGEST }));
    }
    Ok(bytes)
}
