//! Sparse matrices in the arrays that `scipy.sparse.save_npz` writes.

use std::collections::HashMap;

use super::Array;
use crate::matrix::MatrixFile;
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::{Listed, LocatedProblem};

/// The bytes of each array by its name.
#[derive(Default)]
pub(super) struct Parts(HashMap<&'static str, Vec<u8>>);

/// Arrays that a sparse matrix may have.
const NAMES: [&str; 7] = ["format", "shape", "data", "indices", "indptr", "row", "col"];

/// A problem, with the name of its array.
type In = (&'static str, LocatedProblem);

impl Parts {
    /// Keeps an array that belongs to a sparse matrix.
    pub fn add(&mut self, name: &str, bytes: &[u8]) {
        if let Some(known) = NAMES.into_iter().find(|known| *known == name) {
            self.0.insert(known, bytes.to_vec());
        }
    }

    fn array(&self, name: &'static str) -> Result<Array<'_>, In> {
        let missing = || (name, (0, MatrixProblem::SparsePart { part: name.to_owned() }));
        Array::new(self.0.get(name).ok_or_else(missing)?).map_err(|at| (name, at))
    }

    /// An array of one dimension.
    fn list(&self, name: &'static str) -> Result<Array<'_>, In> {
        let array = self.array(name)?;
        if array.shape.len() == 1 { Ok(array) } else { Err((name, array.misshapen("one of one dimension"))) }
    }
}

/// The matrix in these arrays; the values of one place add up.
pub(super) fn matrix(parts: &Parts) -> Result<MatrixFile, In> {
    let format = parts.array("format")?.text().unwrap_or_default();
    let shape = parts.list("shape")?;
    if shape.len() != 2 {
        return Err(("shape", shape.misshapen("(2)")));
    }
    let (rows, columns) = (index("shape", &shape, 0)?, index("shape", &shape, 1)?);
    let mut listed = Listed::new(rows, columns).map_err(|problem| ("shape", (shape.byte(0), problem)))?;
    match format.as_str() {
        "csr" => compressed(parts, rows, [1, 1], |i, j, value, at| listed.add(i, j, value, at))?,
        "csc" => compressed(parts, columns, [1, 1], |j, i, value, at| listed.add(i, j, value, at))?,
        "bsr" => {
            let data = parts.array("data")?;
            let &[_, height, width] = &data.shape[..] else {
                return Err(("data", data.misshapen("one of three dimensions")));
            };
            if !data.by_rows() || height == 0 || width == 0 || rows % height != 0 || columns % width != 0 {
                return Err(("data", data.misshapen("one of blocks that fill the matrix, by rows,")));
            }
            compressed(parts, rows / height, [height, width], |i, j, value, at| listed.add(i, j, value, at))?;
        }
        "coo" => coordinates(parts, |i, j, value, at| listed.add(i, j, value, at))?,
        _ => return Err(("format", (0, MatrixProblem::SparseFormat { found: format.into() }))),
    }
    Ok(listed.sum())
}

/// Adds the entries of lines (rows or columns) of blocks one after the other: line `l` has those from `indptr[l]` on.
fn compressed(
    parts: &Parts,
    lines: usize,
    [height, width]: [usize; 2],
    mut add: impl FnMut(usize, usize, f64, usize) -> Result<(), LocatedProblem>,
) -> Result<(), In> {
    let (pointers, indices, data) = (parts.list("indptr")?, parts.list("indices")?, parts.array("data")?);
    if pointers.len() != lines.saturating_add(1) {
        return Err(("indptr", pointers.misshapen(&format!("({})", lines.saturating_add(1)))));
    }
    let block = height * width;
    if data.len() != indices.len().saturating_mul(block) {
        return Err(("data", data.misshapen(&format!("{} values for {} indices", block, indices.len()))));
    }
    let mut end = pointer(&pointers, 0, 0..=0, indices.len())?;
    for line in 0..lines {
        let start = end;
        let last = if line + 1 == lines { indices.len() } else { start };
        end = pointer(&pointers, line + 1, last..=indices.len(), indices.len())?;
        for position in start..end {
            let across = index("indices", &indices, position)?;
            for inside in 0..block {
                let at = position * block + inside;
                let value = data.real(at).map_err(|at| ("data", at))?;
                let (i, j) = (
                    line * height + inside / width,
                    across.saturating_mul(width).saturating_add(inside % width),
                );
                add(i, j, value, indices.byte(position)).map_err(|at| ("indices", at))?;
            }
        }
    }
    Ok(())
}

/// Adds entries, each with its row and column.
fn coordinates(
    parts: &Parts,
    mut add: impl FnMut(usize, usize, f64, usize) -> Result<(), LocatedProblem>,
) -> Result<(), In> {
    let (rows, columns, data) = (parts.list("row")?, parts.list("col")?, parts.list("data")?);
    for (name, list) in [("row", &rows), ("col", &columns)] {
        if list.len() != data.len() {
            return Err((name, list.misshapen(&format!("({})", data.len()))));
        }
    }
    for position in 0..data.len() {
        let value = data.real(position).map_err(|at| ("data", at))?;
        let (i, j) = (index("row", &rows, position)?, index("col", &columns, position)?);
        add(i, j, value, rows.byte(position)).map_err(|at| ("row", at))?;
    }
    Ok(())
}

/// An integer that is not negative.
fn index(name: &'static str, array: &Array, position: usize) -> Result<usize, In> {
    let found = array.integer(position).map_err(|at| (name, at))?;
    usize::try_from(found).map_err(|_| (name, (array.byte(position), MatrixProblem::SparseIndex { found })))
}

/// A pointer within its bounds.
fn pointer(
    array: &Array,
    position: usize,
    bounds: std::ops::RangeInclusive<usize>,
    entries: usize,
) -> Result<usize, In> {
    let found = array.integer(position).map_err(|at| ("indptr", at))?;
    let within = usize::try_from(found).ok().filter(|pointer| bounds.contains(pointer));
    within.ok_or(("indptr", (array.byte(position), MatrixProblem::SparsePointer { found, entries })))
}
