//! Bulk data of NASTRAN: cards of fields, and the matrices among them. (MSC Nastran Quick Reference Guide, *Bulk Data
//! Entries*, DMIG and GRID)

mod dmig;

use super::MatrixFile;
use super::error::{Fault, MatrixProblem, Place};
use crate::text_file::text;

/// The matrix in `DMIG` cards.
pub(super) fn read_dmig(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, Fault> {
    dmig::read(text::<MatrixProblem>(bytes)?, name).map_err(|(line, problem)| (Place::Line(line), problem))
}
