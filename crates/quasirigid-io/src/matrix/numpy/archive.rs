//! `.npz` reader: a dense array by its name, or the arrays of one SciPy sparse matrix.
//! Unpacking stops at a hundred times the size of the archive, and 64 MiB at least: a malicious file cannot fill the memory.

use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::dense;
use super::sparse::{self, Parts};
use crate::matrix::error::{Fault, MatrixProblem, Place};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::{MAX_FILE, MatrixFile};
use crate::text_file::{Member, unpacked_limit};

/// The matrix of a `.npz` archive: a sparse one in its parts, or a dense one by its name.
pub(in crate::matrix) fn read_archive(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, Fault> {
    let mut archive = Archive::new(bytes)?;
    let names = archive.names();
    match name {
        None if names.iter().any(|name| name == "format") => sparse(&mut archive),
        None if names.len() > 1 => Err((Place::File, MatrixProblem::WhichMatrix { names })),
        None => match names.first() {
            Some(name) => archive.array(name, dense),
            None => Err((Place::File, MatrixProblem::Archive { detail: "it has no .npy file".to_owned() })),
        },
        Some(name) if names.iter().any(|known| known == name) => archive.array(name, dense),
        Some(name) => Err((Place::File, MatrixProblem::NoSuchMatrix { name: name.to_owned(), names })),
    }
}

/// The matrix in the parts that SciPy writes.
fn sparse(archive: &mut Archive) -> Result<MatrixFile, Fault> {
    let mut parts = Parts::default();
    for name in archive.names() {
        archive.array(&name, |bytes| {
            parts.add(&name, bytes);
            Ok(())
        })?;
    }
    sparse::matrix(&parts).map_err(|(part, (byte, problem))| (member(part, byte), problem))
}

/// Files in an archive, as bytes that may be compressed.
struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    /// Number of bytes that may still be unpacked.
    left: u64,
    /// Number of bytes that may be unpacked in all.
    limit: u64,
}

impl<'a> Archive<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        let refused = |error: zip::result::ZipError| (Place::File, archive(&error));
        let left = unpacked_limit(bytes.len() as u64).min(MAX_FILE);
        Ok(Self { zip: ZipArchive::new(Cursor::new(bytes)).map_err(refused)?, left, limit: left })
    }

    /// The arrays without their ending, in alphabetic order.
    fn names(&self) -> Vec<String> {
        let files = self.zip.file_names().flatten();
        let mut names: Vec<String> =
            files.filter_map(|name| name.strip_suffix(".npy").map(str::to_owned)).collect();
        names.sort();
        names
    }

    /// Something read from an array.
    fn array<T>(
        &mut self,
        name: &str,
        read: impl FnOnce(&[u8]) -> Result<T, LocatedProblem>,
    ) -> Result<T, Fault> {
        let refused = |problem| (member(name, 0), problem);
        let file = self.zip.by_name(&format!("{name}.npy")).map_err(|error| refused(archive(&error)))?;
        let mut bytes = Vec::new();
        let unpacked = file.take(self.left + 1).read_to_end(&mut bytes);
        unpacked.map_err(|error| refused(archive(&error)))?;
        let left = self.left.checked_sub(bytes.len() as u64);
        let limit = self.limit;
        self.left = left.ok_or_else(|| refused(MatrixProblem::Inflated { limit }))?;
        read(&bytes).map_err(|(byte, problem)| (member(name, byte), problem))
    }
}

fn archive(error: &impl ToString) -> MatrixProblem {
    MatrixProblem::Archive { detail: error.to_string() }
}

fn member(name: &str, byte: usize) -> Place {
    Place::Member(Box::new(Member { name: format!("{name}.npy"), byte }))
}
