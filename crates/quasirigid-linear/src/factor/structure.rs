//! Places of the entries of a factor: columns, or panels of supernodes where there is much to fill.

use std::sync::Arc;

use faer::perm::PermRef;
use faer::prelude::default;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use faer::{Par, Side};

use super::numeric;
use super::ordering::{Dissection, Ordering, dissection};
use super::supernodes::Supernodes;
use super::tree::Tree;
use super::triangle::Real;
use crate::symmetric::Symmetric;

/// Places of the entries of a factor, which depend only on the pattern of the matrix.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    layout: Arc<Layout>,
    /// Method that gave the order of elimination.
    pub ordering: Ordering,
}

/// Where the entries of a factor stand.
#[derive(Debug)]
pub(super) enum Layout {
    /// Each column on its own, where little fills.
    Columns {
        symbolic: SymbolicCholesky<usize>,
        multiplications: f64,
    },
    Panels(Panels),
}

/// Supernodes of a factor, their tree, and the order of the unknowns.
#[derive(Debug)]
pub(super) struct Panels {
    pub supernodes: Supernodes,
    pub tree: Tree,
    /// Unknowns in the order of elimination.
    pub order: Vec<usize>,
}

impl Structure {
    /// Orders the unknowns and finds the fill of the factor; none if the structure has no room in memory.
    pub fn new(matrix: &Symmetric, ordering: Ordering) -> Option<Self> {
        let pattern = matrix.pattern();
        let (dissection, ordering) = dissection(pattern.starts(), pattern.rows(), ordering);
        let layout = match dissection.as_ref().and_then(Panels::of_vertices) {
            Some(panels) => Layout::Panels(panels),
            None => Layout::of_unknowns(matrix, dissection.as_ref())?,
        };
        Some(Self { layout: Arc::new(layout), ordering })
    }

    pub(super) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Branches and separators.
    #[cfg(test)]
    pub fn pieces(&self) -> [usize; 2] {
        match self.layout() {
            Layout::Columns { .. } => [0; 2],
            Layout::Panels(Panels { tree, .. }) => [tree.branches.len(), tree.separators.len()],
        }
    }

    /// Number of entries of the factor.
    pub fn entries(&self) -> usize {
        match self.layout() {
            Layout::Columns { symbolic, .. } => symbolic.len_val(),
            Layout::Panels(panels) => panels.supernodes.entries(),
        }
    }

    /// Bytes that the factor of a matrix of so many entries takes: its own, the matrix scaled and ordered, and room to work.
    pub fn bytes<T: Real>(&self, matrix_entries: usize) -> f64 {
        let work = match self.layout() {
            Layout::Columns { symbolic, .. } => {
                let work = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, default());
                work.unaligned_bytes_required() + matrix_entries * (size_of::<T>() + size_of::<usize>())
            }
            Layout::Panels(panels) => numeric::bytes::<T>(panels, matrix_entries),
        };
        (self.entries() * size_of::<T>() + work) as f64
    }

    /// Multiplications of the factorisation: the sum of squares of the lengths of the columns.
    pub fn multiplications(&self) -> f64 {
        match self.layout() {
            Layout::Columns { multiplications, .. } => *multiplications,
            Layout::Panels(panels) => panels.supernodes.multiplications(),
        }
    }
}

impl Layout {
    /// Fill of the matrix in the order of a dissection, or of minimum degree if there is none; none without memory.
    fn of_unknowns(matrix: &Symmetric, dissection: Option<&Dissection>) -> Option<Self> {
        let pattern = matrix.pattern();
        let order = dissection.map(Dissection::unknowns);
        let symbolic = symbolic(pattern.starts(), &wide(pattern.rows()), order.as_deref(), 1.0)?;
        match symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(factor) => {
                let lengths = factor.col_ptr().windows(2).map(|column| (column[1] - column[0]) as f64);
                let multiplications = lengths.map(|length| length * length).sum();
                Some(Self::Columns { symbolic, multiplications })
            }
            SymbolicCholeskyRaw::Supernodal(factor) => {
                let columns: Vec<usize> = (0..=matrix.size()).collect();
                let order = symbolic.perm()?.arrays().0.to_vec();
                Some(Self::Panels(Panels::new(Supernodes::of(factor, &columns), order)))
            }
        }
    }
}

impl Panels {
    /// Fill of the matrix from that of its graph; none where so little fills that it has no supernodes, or without memory.
    fn of_vertices(dissection: &Dissection) -> Option<Self> {
        let Dissection { graph, order } = dissection;
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for vertex in 0..graph.size() {
            rows.push(vertex);
            rows.extend(graph.neighbours(vertex).filter(|other| *other > vertex));
            starts.push(rows.len());
        }
        let (mut columns, mut end) = (vec![0], 0);
        for vertex in order {
            end += graph.members[*vertex as usize].len();
            columns.push(end);
        }
        let weight = end as f64 / graph.size() as f64;
        let symbolic = symbolic(&starts, &rows, Some(&wide(order)), weight)?;
        let SymbolicCholeskyRaw::Supernodal(factor) = symbolic.raw() else { return None };
        Some(Self::new(Supernodes::of(factor, &columns), dissection.unknowns()))
    }

    fn new(supernodes: Supernodes, order: Vec<usize>) -> Self {
        Self { tree: Tree::of(&supernodes), supernodes, order }
    }

    /// Place of each unknown in the order of elimination.
    pub fn places(&self) -> Vec<usize> {
        inverse(&self.order)
    }
}

/// Columns up to which supernodes are merged, and the share of zeros that the merged ones may store.
const MERGED: [(usize, f64); 4] = [(4, 1.0), (16, 0.8), (48, 0.1), (usize::MAX, 0.05)];

/// Symbolic factor of a lower triangle in an order of its columns, by minimum degree if there is none; each column stands for `weight` of
/// them, on average. None without memory.
fn symbolic(
    starts: &[usize],
    rows: &[usize],
    order: Option<&[usize]>,
    weight: f64,
) -> Option<SymbolicCholesky<usize>> {
    let inverse = order.map(inverse);
    let order = match (order, &inverse) {
        (Some(order), Some(inverse)) => {
            SymmetricOrdering::Custom(PermRef::new_checked(order, inverse, order.len()))
        }
        _ => SymmetricOrdering::Amd,
    };
    let merged = MERGED.map(|(columns, zeros)| ((columns as f64 / weight) as usize, zeros));
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold(weight.recip()),
        supernodal_params: SymbolicSupernodalParams { relax: Some(&merged) },
        ..default()
    };
    factorize_symbolic_cholesky(lower(starts, rows), Side::Lower, order, parameters).ok()
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut inverse = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, index)| inverse[*index] = place);
    inverse
}

/// Rows in the width of numbers that counts the entries of the largest factors.
pub(super) fn wide(rows: &[u32]) -> Vec<usize> {
    rows.iter().map(|row| *row as usize).collect()
}

/// Lower triangle of a matrix as the sparse library takes it.
pub(super) fn lower<'a>(starts: &'a [usize], rows: &'a [usize]) -> SymbolicSparseColMatRef<'a, usize> {
    let size = starts.len() - 1;
    SymbolicSparseColMatRef::new_checked(size, size, starts, None, rows)
}
