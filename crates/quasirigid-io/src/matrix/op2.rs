//! Matrices of the NASTRAN module `OUTPUT2`: each column is a record of strings, with the first row before the values of each.
//! Beside them stand the real modes of the file, as matrices of their own names.

use std::collections::BTreeMap;

use super::error::{Fault, MatrixProblem, Place};
use super::listed::{Listed, LocatedProblem, Symmetry};
use super::{Dof, MatrixFile};
use crate::nastran::modes::Modes;
use crate::nastran::op2::{Block, Tape, axes, modes};
use crate::nastran::printed;

/// Block of the parts of an external superelement, each with its own name inside.
const EXTERNAL: &str = "EXTDB";
/// Tables of grid points and of their rows.
const ROWS: [&str; 2] = ["EQEXIN", "EQEXINS"];

/// The matrix of this name, or the only one.
pub(super) fn read(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, Fault> {
    matrix(bytes, name).map_err(|(byte, problem)| (Place::Byte(byte), problem))
}

/// The modes of a print file or a punch file.
pub(super) fn read_printed(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, Fault> {
    let read = || of_modes(printed::modes(bytes)?, name, Vec::new());
    read().map_err(|(line, problem)| (if line == 0 { Place::File } else { Place::Line(line) }, problem))
}

fn matrix(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, LocatedProblem> {
    let tape = Tape::read(bytes)?;
    let matrices: Vec<&Block> = tape.blocks.iter().filter(|block| is_matrix(block)).collect();
    let named = |block: &&Block| name.is_none_or(|name| name_of(block).eq_ignore_ascii_case(name));
    let mut wanted = matrices.iter().copied().filter(named);
    let (first, second) = (wanted.next(), wanted.next());
    let names: Vec<String> = matrices.iter().map(|block| name_of(block).to_owned()).collect();
    match (first, second, name) {
        (Some(_), Some(second), Some(name)) => {
            Err((second.at, MatrixProblem::SameName { name: name.to_owned() }))
        }
        (Some(block), None, _) if name.is_some() || modes(&tape)?.names().is_empty() => {
            of_block(&tape, block)
        }
        _ => {
            let mut modes = modes(&tape)?;
            if modes.basic {
                axes(bytes, &mut modes)?;
            }
            of_modes(modes, name, names)
        }
    }
}

/// The column or the shapes of modes, beside matrices of other names.
fn of_modes(modes: Modes, name: Option<&str>, names: Vec<String>) -> Result<MatrixFile, LocatedProblem> {
    let names = [names, modes.names()].concat();
    if names.is_empty() {
        return Err((0, MatrixProblem::NoModes));
    }
    let name = match name {
        None if names.len() > 1 => return Err((0, MatrixProblem::WhichMatrix { names })),
        None => &names[0],
        Some(name) => name,
    };
    let missing = || (0, MatrixProblem::NoSuchMatrix { name: name.to_owned(), names: names.clone() });
    modes.matrix(name)?.ok_or_else(missing)
}

fn is_matrix(block: &Block) -> bool {
    block.records.iter().any(|record| record.column)
}

fn name_of(block: &Block) -> &str {
    &block.names[usize::from(block.names[0] == EXTERNAL)]
}

/// The matrix of one of these names, if the file has one.
pub(crate) fn named(tape: &Tape, names: &[&str]) -> Result<Option<MatrixFile>, LocatedProblem> {
    tape.block(names).map(|block| of_block(tape, block)).transpose()
}

/// Columns, rows, form and type stand in the trailer; the first record has names, each other one is a column.
fn of_block(tape: &Tape, block: &Block) -> Result<MatrixFile, LocatedProblem> {
    let [_, columns, rows, _, kind, ..] = block.trailer;
    let double = match kind {
        1 => false,
        2 => true,
        3 | 4 => return Err((block.at, MatrixProblem::Complex)),
        _ => return Err((block.at, MatrixProblem::Type { found: kind.to_string().into() })),
    };
    let size = |count: i64| usize::try_from(count).unwrap_or(0);
    let mut listed = Listed::new(size(rows), size(columns)).map_err(|problem| (block.at, problem))?;
    for (column, record) in block.records.iter().skip(1).enumerate() {
        for piece in record.pieces.iter().filter(|_| record.column) {
            let words = tape.piece(piece);
            let row = words.integer(0).and_then(|row| usize::try_from(row).ok()?.checked_sub(1));
            let row = row.ok_or((words.at, MatrixProblem::Zero))?;
            let step = if double && !words.is_long() { 2 } else { 1 };
            for (index, place) in (1..words.len()).step_by(step).enumerate() {
                let value = if double { words.double(place) } else { words.real(place) };
                let Some(value) = value else { continue };
                if !value.is_finite() {
                    return Err((words.at, MatrixProblem::NotFinite { found: value.to_string().into() }));
                }
                listed.add(row.saturating_add(index), column, value, words.at)?;
            }
        }
    }
    let matrix = listed.unique(Symmetry::General)?;
    let labels = labels(tape).filter(|labels| labels.len() == matrix.rows);
    Ok(MatrixFile { labels, ..matrix })
}

/// Degrees of freedom of the rows of matrices between all of them: pairs of a grid point and ten times its first row with its type.
fn labels(tape: &Tape) -> Option<Vec<Dof>> {
    let table = tape.words(tape.block(&ROWS)?.records.get(2)?);
    let mut points = BTreeMap::new();
    for pair in 0..table.len() / 2 {
        let (node, code) = (table.integer(2 * pair)?, table.integer(2 * pair + 1)?);
        points.insert(code / 10, (u64::try_from(node).ok()?, code % 10));
    }
    let mut labels = Vec::new();
    for (first, (node, kind)) in points {
        if usize::try_from(first).ok()? != labels.len() + 1 {
            return None;
        }
        let components = if kind == 1 { 1..=6 } else { 0..=0 };
        labels.extend(components.map(|component| Dof { node, component }));
    }
    // rows are numbered as the solver likes, but labels ascend
    labels.is_sorted().then_some(labels)
}
