//! Triangular factors of sparse symmetric matrices; the only file that names the sparse library.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::prelude::default;
use faer::sparse::linalg::cholesky::{
    LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::RealField;
use faer::{Conj, MatMut, Par, Side};

use super::ordering::{Ordering, elimination};
use crate::symmetric::Symmetric;

/// Places of the entries of a factor, which depend only on the pattern of the matrix.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    symbolic: Arc<SymbolicCholesky<usize>>,
    /// Method that gave the order of elimination.
    pub ordering: Ordering,
}

/// `L` of `L Lᵀ = S A S + s 1` with a diagonal `S` that makes the diagonal of `S A S` one.
#[derive(Clone, Debug)]
pub(crate) struct Triangle<T> {
    structure: Structure,
    entries: Vec<T>,
}

/// A number format in which a factor can be stored.
pub(crate) trait Real: RealField {
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

impl Structure {
    /// Orders the unknowns and finds the fill of the factor; none if the structure has no room in memory.
    pub fn new(matrix: &Symmetric, ordering: Ordering) -> Option<Self> {
        let pattern = matrix.pattern();
        let (order, ordering) = elimination(pattern.starts(), pattern.rows(), ordering);
        let inverse = order.as_ref().map(|order| {
            let mut inverse = vec![0; order.len()];
            order.iter().enumerate().for_each(|(place, unknown)| inverse[*unknown] = place);
            inverse
        });
        let order = match (&order, &inverse) {
            (Some(order), Some(inverse)) => {
                SymmetricOrdering::Custom(PermRef::new_checked(order, inverse, order.len()))
            }
            _ => SymmetricOrdering::Amd,
        };
        let rows = wide_rows(matrix);
        let symbolic =
            factorize_symbolic_cholesky(places(matrix, &rows), Side::Lower, order, default()).ok()?;
        Some(Self { symbolic: Arc::new(symbolic), ordering })
    }

    /// Number of entries of the factor.
    pub fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Bytes that [`Triangle::new`] takes for a matrix of so many entries: the factor, the matrix scaled, its rows, and room to work.
    pub fn bytes<T: Real>(&self, matrix_entries: usize) -> f64 {
        let work = self.symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, default());
        let factor = self.entries() * size_of::<T>();
        let matrix = matrix_entries * (size_of::<T>() + size_of::<usize>());
        (factor + matrix) as f64 + work.unaligned_bytes_required() as f64
    }

    /// Multiplications of the factorisation: the sum of squares of the lengths of the columns.
    pub fn multiplications(&self) -> f64 {
        let square = |length: usize| (length * length) as f64;
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(factor) => {
                factor.col_ptr().windows(2).map(|column| square(column[1] - column[0])).sum()
            }
            SymbolicCholeskyRaw::Supernodal(factor) => (0..factor.n_supernodes())
                .map(|index| {
                    let width = factor.supernode_end()[index] - factor.supernode_begin()[index];
                    let below = factor.supernode(index).pattern().len();
                    (1..=width).map(|column| square(below + column)).sum::<f64>()
                })
                .sum(),
        }
    }
}

impl<T: Real> Triangle<T> {
    /// Factors a scaled and shifted matrix; none if a pivot is not positive.
    pub fn new(structure: Structure, matrix: &Symmetric, scale: &[f64], shift: f64) -> Option<Self> {
        let mut scaled = Vec::with_capacity(matrix.entries().len());
        for column in 0..matrix.size() {
            scaled.extend(matrix.column(column).map(|(row, entry)| {
                let shift = if row == column { shift } else { 0.0 };
                T::rounded(entry * scale[row] * scale[column] + shift)
            }));
        }
        let rows = wide_rows(matrix);
        let mut entries = vec![T::rounded(0.0); structure.symbolic.len_val()];
        let request = structure.symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, default());
        let mut buffer = MemBuffer::try_new(request).ok()?;
        structure
            .symbolic
            .factorize_numeric_llt(
                &mut entries,
                SparseColMatRef::new(places(matrix, &rows), &scaled),
                Side::Lower,
                default(),
                Par::Seq,
                MemStack::new(&mut buffer),
                default(),
            )
            .ok()?;
        Some(Self { structure, entries })
    }

    /// Solves in place for right-hand sides stored row by row, `width` to a row.
    pub fn solve(&self, right: &mut [T], width: usize) {
        let symbolic = &self.structure.symbolic;
        let mut buffer = MemBuffer::new(symbolic.solve_in_place_scratch::<T>(width, Par::Seq));
        let right = MatMut::from_row_major_slice_mut(right, symbolic.nrows(), width);
        let factor = LltRef::new(symbolic, &self.entries);
        factor.solve_in_place_with_conj(Conj::No, right, Par::Seq, MemStack::new(&mut buffer));
    }
}

/// Rows in the width of numbers that counts the entries of the largest factors.
fn wide_rows(matrix: &Symmetric) -> Vec<usize> {
    matrix.pattern().rows().iter().map(|row| *row as usize).collect()
}

fn places<'a>(matrix: &'a Symmetric, rows: &'a [usize]) -> SymbolicSparseColMatRef<'a, usize> {
    SymbolicSparseColMatRef::new_checked(matrix.size(), matrix.size(), matrix.pattern().starts(), None, rows)
}
