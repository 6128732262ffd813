//! Cholesky factor `L Lᵀ` of a sparse matrix; with its parts the only files of this module that name the sparse library.

use std::ops::{AddAssign, SubAssign};
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

use super::numeric;
use super::ordering::{Ordering, elimination};
use super::solution::Solution;
use super::supernodes::{Tree, supernode};
use crate::symmetric::Symmetric;

/// Places of the entries of a factor, which depend only on the pattern of the matrix.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    symbolic: Arc<SymbolicCholesky<usize>>,
    /// Tree of the supernodes; none of a factor without supernodes.
    tree: Option<Arc<Tree>>,
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
        let tree = match symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(_) => None,
            SymbolicCholeskyRaw::Supernodal(factor) => Some(Arc::new(Tree::of(factor))),
        };
        Some(Self { symbolic: Arc::new(symbolic), tree, ordering })
    }

    /// Branches and separators.
    #[cfg(test)]
    pub fn pieces(&self) -> [usize; 2] {
        self.tree.as_ref().map_or([0; 2], |tree| [tree.branches.len(), tree.separators.len()])
    }

    /// Number of entries of the factor.
    pub fn entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Bytes that [`Triangle::new`] takes for a matrix of so many entries: the factor, the matrix scaled and ordered, and room to work.
    pub fn bytes<T: Real>(&self, matrix_entries: usize) -> f64 {
        let factor = self.entries() * size_of::<T>();
        let work = match &self.tree {
            Some(tree) => numeric::bytes::<T>(tree, self.symbolic.nrows(), matrix_entries),
            None => {
                let work = self.symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, default());
                work.unaligned_bytes_required() + matrix_entries * (size_of::<T>() + size_of::<usize>())
            }
        };
        (factor + work) as f64
    }

    /// Multiplications of the factorisation: the sum of squares of the lengths of the columns.
    pub fn multiplications(&self) -> f64 {
        let square = |length: usize| (length * length) as f64;
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(factor) => {
                factor.col_ptr().windows(2).map(|column| square(column[1] - column[0])).sum()
            }
            SymbolicCholeskyRaw::Supernodal(factor) => {
                (0..factor.n_supernodes()).map(|index| supernode(factor, index).multiplications()).sum()
            }
        }
    }
}

impl<T: Real> Triangle<T> {
    /// Factors a scaled and shifted matrix; none if a pivot is not positive.
    pub fn new(structure: Structure, matrix: &Symmetric, scale: &[f64], shift: f64) -> Option<Self> {
        let entries = match (structure.symbolic.raw(), &structure.tree) {
            (SymbolicCholeskyRaw::Supernodal(factor), Some(tree)) => {
                let order = structure.symbolic.perm().map(|order| order.arrays().1);
                numeric::factored(factor, tree, order, (matrix, scale, shift))?
            }
            _ => by_columns(&structure.symbolic, matrix, scale, shift)?,
        };
        Some(Self { structure, entries })
    }

    /// Solves in place for right-hand sides stored row by row, `width` to a row.
    pub fn solve(&self, right: &mut [T], width: usize) {
        let symbolic = &self.structure.symbolic;
        let (SymbolicCholeskyRaw::Supernodal(factor), Some(tree)) = (symbolic.raw(), &self.structure.tree)
        else {
            return self.solve_by_columns(right, width);
        };
        let solution = Solution { symbolic: factor, tree, entries: &self.entries, width };
        let Some(order) = symbolic.perm().map(|order| order.arrays().0) else { return solution.solve(right) };
        let mut ordered: Vec<T> =
            order.iter().flat_map(|unknown| &right[unknown * width..][..width]).copied().collect();
        solution.solve(&mut ordered);
        for (unknown, row) in order.iter().zip(ordered.chunks_exact(width)) {
            right[unknown * width..][..width].copy_from_slice(row);
        }
    }

    fn solve_by_columns(&self, right: &mut [T], width: usize) {
        let symbolic = &self.structure.symbolic;
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
    let rows = wide_rows(matrix);
    let mut entries = vec![T::rounded(0.0); symbolic.len_val()];
    let request = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, default());
    let mut buffer = MemBuffer::try_new(request).ok()?;
    symbolic
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
    Some(entries)
}

/// Rows in the width of numbers that counts the entries of the largest factors.
fn wide_rows(matrix: &Symmetric) -> Vec<usize> {
    matrix.pattern().rows().iter().map(|row| *row as usize).collect()
}

fn places<'a>(matrix: &'a Symmetric, rows: &'a [usize]) -> SymbolicSparseColMatRef<'a, usize> {
    SymbolicSparseColMatRef::new_checked(matrix.size(), matrix.size(), matrix.pattern().starts(), None, rows)
}
