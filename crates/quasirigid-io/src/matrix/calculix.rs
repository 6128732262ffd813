//! The stiffness (`.sti`) and the mass (`.mas`) that CalculiX stores: lines `row column value` of one triangle.

use super::MatrixFile;
use super::error::{Fault, MatrixProblem, Place, Row};
use super::listed::{Listed, Symmetry};
use super::text::{entry, number};
use crate::text_file::{lines, text};

pub(super) fn read(bytes: &[u8]) -> Result<MatrixFile, Fault> {
    let text = text::<MatrixProblem>(bytes)?;
    let mut last = 0;
    for (line, words) in lines(text) {
        let (row, column, _) = entry(words, Row::CalculiX).map_err(|problem| (Place::Line(line), problem))?;
        last = last.max(row).max(column);
    }
    // Each degree of freedom has a diagonal entry, zero or not: the greatest number is the size.
    let size = last.saturating_add(1);
    let mut listed = Listed::new(size, size).map_err(|problem| (Place::File, problem))?;
    let mut diagonals = 0;
    for (line, words) in lines(text) {
        let refused = |problem| (Place::Line(line), problem);
        let (row, column, word) = entry(words, Row::CalculiX).map_err(refused)?;
        let value = number(word, Row::CalculiX).map_err(refused)?;
        diagonals += usize::from(row == column);
        listed.add(row, column, value, line).map_err(|(_, problem)| refused(problem))?;
    }
    let matrix =
        listed.unique(Symmetry::Symmetric).map_err(|(line, problem)| (Place::Line(line), problem))?;
    if diagonals < size {
        return Err((Place::File, MatrixProblem::NoDiagonal { size, diagonals }));
    }
    Ok(matrix)
}
