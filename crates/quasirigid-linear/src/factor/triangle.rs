//! Cholesky factor `L Lᵀ` of a sparse matrix; with its parts the only files of this module that name the sparse library.

use std::ops::{AddAssign, SubAssign};

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::prelude::default;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::{LltRef, SymbolicCholesky};
use faer::traits::RealField;
use faer::{Conj, MatMut, Par, Side};

use super::numeric;
use super::solution::Solution;
use super::structure::{Layout, Structure, lower, wide};
use crate::symmetric::Symmetric;

/// `L` of `L Lᵀ = S A S + s 1` with a diagonal `S` that makes the diagonal of `S A S` one.
#[derive(Clone, Debug)]
pub(crate) struct Triangle<T> {
    structure: Structure,
    entries: Vec<T>,
}

/// A number format in which a factor can be stored.
pub(crate) trait Real: RealField + Copy + AddAssign + SubAssign {
    fn rounded(value: f64) -> Self;
}

impl Real for f64 {
    fn rounded(value: f64) -> Self {
        value
    }
}

impl Real for f32 {
    fn rounded(value: f64) -> Self {
        value as Self
    }
}

impl<T: Real> Triangle<T> {
    /// Factors a scaled and shifted matrix; none if a pivot is not positive.
    pub fn new(structure: Structure, matrix: &Symmetric, scale: &[f64], shift: f64) -> Option<Self> {
        let entries = match structure.layout() {
            Layout::Columns { symbolic, .. } => by_columns(symbolic, matrix, scale, shift)?,
            Layout::Panels(panels) => numeric::factored(panels, (matrix, scale, shift))?,
        };
        Some(Self { structure, entries })
    }

    /// Solves in place for right-hand sides stored row by row, `width` to a row.
    pub fn solve(&self, right: &mut [T], width: usize) {
        match self.structure.layout() {
            Layout::Columns { symbolic, .. } => self.solve_by_columns(symbolic, right, width),
            Layout::Panels(panels) => {
                let order = &panels.order;
                let mut ordered: Vec<T> =
                    order.iter().flat_map(|unknown| &right[unknown * width..][..width]).copied().collect();
                Solution { panels, entries: &self.entries, width }.solve(&mut ordered);
                for (unknown, row) in order.iter().zip(ordered.chunks_exact(width)) {
                    right[unknown * width..][..width].copy_from_slice(row);
                }
            }
        }
    }

    fn solve_by_columns(&self, symbolic: &SymbolicCholesky<usize>, right: &mut [T], width: usize) {
        let mut buffer = MemBuffer::new(symbolic.solve_in_place_scratch::<T>(width, Par::Seq));
        let right = MatMut::from_row_major_slice_mut(right, symbolic.nrows(), width);
        let factor = LltRef::new(symbolic, &self.entries);
        factor.solve_in_place_with_conj(Conj::No, right, Par::Seq, MemStack::new(&mut buffer));
    }
}

/// Entries of a factor without supernodes; none if a pivot is not positive.
fn by_columns<T: Real>(
    symbolic: &SymbolicCholesky<usize>,
    matrix: &Symmetric,
    scale: &[f64],
    shift: f64,
) -> Option<Vec<T>> {
    let mut scaled = Vec::with_capacity(matrix.entries().len());
    for column in 0..matrix.size() {
        scaled.extend(matrix.column(column).map(|(row, entry)| {
            let shift = if row == column { shift } else { 0.0 };
            T::rounded(entry * scale[row] * scale[column] + shift)
        }));
    }
    let pattern = matrix.pattern();
    let rows = wide(pattern.rows());
    let mut entries = vec![T::rounded(0.0); symbolic.len_val()];
    let request = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, default());
    let mut buffer = MemBuffer::try_new(request).ok()?;
    symbolic
        .factorize_numeric_llt(
            &mut entries,
            SparseColMatRef::new(lower(pattern.starts(), &rows), &scaled),
            Side::Lower,
            default(),
            Par::Seq,
            MemStack::new(&mut buffer),
            default(),
        )
        .ok()?;
    Some(entries)
}
