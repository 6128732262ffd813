//! Arrays as NumPy and SciPy write them: `.npy`, and several of them in `.npz`. (NumPy Enhancement Proposal 1)

mod archive;
mod array;
mod header;
mod sparse;

pub(super) use archive::read_archive;
pub(crate) use array::Array;

use super::MatrixFile;
use super::error::{Fault, Place};
use super::listed::LocatedProblem;

/// The matrix in a `.npy` file.
pub(super) fn read(bytes: &[u8]) -> Result<MatrixFile, Fault> {
    dense(bytes).map_err(|(byte, problem)| (Place::Byte(byte), problem))
}

/// The matrix in an array of one dimension, a column, or of two.
fn dense(bytes: &[u8]) -> Result<MatrixFile, LocatedProblem> {
    Array::new(bytes)?.matrix()
}
