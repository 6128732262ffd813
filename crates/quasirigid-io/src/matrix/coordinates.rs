//! Matrices as bare lines: `row column value`, or `node component node component value`, as Abaqus writes them by `*MATRIX OUTPUT`.
//! A file gives one triangle or both, and does not say which: entries of one triangle alone stand for both.
//! Abaqus Analysis Guide, *Generating matrices*: formats COORDINATE, LABELS and MATRIX INPUT.

use std::collections::BTreeSet;

use super::error::{Fault, MatrixProblem, Place, Row};
use super::listed::{Listed, LocatedProblem, Symmetry};
use super::text::number;
use super::{Dof, MatrixFile};
use crate::text_file::{lines, size, text, whole};

/// Whether a text begins with a line of such a matrix.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let lines = bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let mut data =
        lines.filter(|line| !line.is_empty() && !line.starts_with(b"*") && !line.starts_with(b"#"));
    let Some(Ok(line)) = data.next().map(std::str::from_utf8) else { return false };
    let words = words(line);
    let whole = |words: &[&str]| words.iter().all(|word| word.parse::<i64>().is_ok());
    let (Some(value), 3 | 5) = (words.last(), words.len()) else { return false };
    whole(&words[..words.len() - 1]) && number(value, Row::Coordinates).is_ok()
}

fn words(line: &str) -> Vec<&str> {
    line.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty()).collect()
}

pub(super) fn read(bytes: &[u8]) -> Result<MatrixFile, Fault> {
    let text = text::<MatrixProblem>(bytes)?;
    let data = || lines(text).filter(|(_, line)| !line.starts_with(['*', '#']));
    let labelled = data().next().is_some_and(|(_, line)| words(line).len() == 5);
    let read = if labelled { labels(data()) } else { numbers(data) };
    read.map_err(|(line, problem)| (Place::Line(line), problem))
}

/// Lines `row column value`.
fn numbers<'a, L: Iterator<Item = (usize, &'a str)>>(
    data: impl Fn() -> L,
) -> Result<MatrixFile, LocatedProblem> {
    let mut last = 0;
    for (at, line) in data() {
        let (row, column, _) = term(line).map_err(|problem| (at, problem))?;
        last = last.max(row.max(column).saturating_add(1));
    }
    let mut listed = Listed::new(last, last).map_err(|problem| (1, problem))?;
    let mut triangles = [false; 2];
    for (at, line) in data() {
        let (row, column, word) = term(line).map_err(|problem| (at, problem))?;
        let value = number(word, Row::Coordinates).map_err(|problem| (at, problem))?;
        triangles[usize::from(row > column)] |= row != column;
        listed.add(row, column, value, at)?;
    }
    listed.unique(symmetry(triangles))
}

/// Row and column, from 0, and the word of the value.
fn term(line: &str) -> Result<(usize, usize, &str), MatrixProblem> {
    let words = words(line);
    let [row, column, value] = words[..] else {
        return Err(MatrixProblem::Values { found: words.len(), row: Row::Coordinates });
    };
    let index = |word| size(word, Row::Coordinates)?.checked_sub(1).ok_or(MatrixProblem::Zero);
    Ok((index(row)?, index(column)?, value))
}

/// Lines `node component node component value`.
fn labels<'a>(data: impl Iterator<Item = (usize, &'a str)>) -> Result<MatrixFile, LocatedProblem> {
    let mut terms = Vec::new();
    for (at, line) in data {
        let refused = |problem| (at, problem);
        let words = words(line);
        let [node, component, other, second, value] = words[..] else {
            return Err((at, MatrixProblem::Values { found: words.len(), row: Row::Labels }));
        };
        let row = dof(node, component).map_err(refused)?;
        let column = dof(other, second).map_err(refused)?;
        terms.push((row, column, number(value, Row::Labels).map_err(refused)?, at));
    }
    let dofs: BTreeSet<Dof> = terms.iter().flat_map(|(row, column, ..)| [*row, *column]).collect();
    let dofs: Vec<Dof> = dofs.into_iter().collect();
    let index = |dof: Dof| dofs.partition_point(|other| *other < dof);
    let mut listed = Listed::new(dofs.len(), dofs.len()).map_err(|problem| (1, problem))?;
    let mut triangles = [false; 2];
    for (row, column, value, at) in terms {
        let (row, column) = (index(row), index(column));
        triangles[usize::from(row > column)] |= row != column;
        listed.add(row, column, value, at)?;
    }
    let matrix = listed.unique(symmetry(triangles))?;
    Ok(MatrixFile { labels: Some(dofs), ..matrix })
}

fn dof(node: &str, component: &str) -> Result<Dof, MatrixProblem> {
    let node = whole(node, Row::Labels)?;
    match whole(component, Row::Labels)? {
        component @ 1..=6 => Ok(Dof { node, component: component as u8 }),
        found => Err(MatrixProblem::Component { found: found.to_string().into() }),
    }
}

/// One triangle stands for both, two for themselves.
fn symmetry(triangles: [bool; 2]) -> Symmetry {
    if triangles == [true, true] { Symmetry::General } else { Symmetry::Symmetric }
}
