//! A body as another program exports it: matrices between nodes with rotations, and its modes.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use quasirigid::elements::{Matrices, NodalMass, PartKind};
use quasirigid::model::Rheology;

use super::common::Numbers;

/// Matrices of a body with rotations at its nodes.
pub struct Body {
    pub mass: NodalMass,
    pub M: DMatrix<f64>,
    pub K: DMatrix<f64>,
}

pub const NODES: usize = 5;
/// Damping of every mode as a share of the critical one.
pub const RATIO: f64 = 0.03;

impl Body {
    /// Nodes that are small rigid bodies, with any stiffness between them, or one that resists no rigid motion if the body floats.
    pub fn new(seed: u64, floats: bool) -> Self {
        let mut numbers = Numbers(seed);
        let mut next = || numbers.next();
        let nodes: Vec<[f64; 3]> = (0..NODES).map(|_| [2.0 + next(), next() - 1.0, 0.5 * next()]).collect();
        let size = 6 * NODES;
        let mut M = DMatrix::zeros(size, size);
        for node in 0..NODES {
            let mass = 1.5 + next();
            let half = Matrix3::from_fn(|_, _| 0.2 * next());
            let second = half * half.transpose();
            let inertia = second.trace() * Matrix3::identity() - second;
            M.view_mut((6 * node, 6 * node), (3, 3)).copy_from(&(mass * Matrix3::identity()));
            M.view_mut((6 * node + 3, 6 * node + 3), (3, 3)).copy_from(&inertia);
        }
        let root = DMatrix::from_fn(size, size, |_, _| 6.0 * next());
        let mut K = &root * root.transpose() + 40.0 * DMatrix::identity(size, size);
        if floats {
            let rigid = rigid(&nodes);
            let inverse = rigid.tr_mul(&rigid).try_inverse().unwrap();
            let strained = DMatrix::identity(size, size) - &rigid * inverse * rigid.transpose();
            K = &strained * K * &strained;
        }
        let dofs = (0..size).map(|row| (row / 6, row % 6)).collect();
        let node_labels = (1..=NODES as u64).map(|node| 10 * node).collect();
        let mass = NodalMass { nodes, node_labels, dofs, entries: entries(&M) };
        Self { mass, M, K }
    }

    /// The body with its first node constrained by the program that it comes from: without its rows.
    pub fn held(mut self) -> Self {
        self.M = self.M.remove_rows(0, 6).remove_columns(0, 6);
        self.K = self.K.remove_rows(0, 6).remove_columns(0, 6);
        self.mass.dofs.drain(..6);
        self.mass.entries = entries(&self.M);
        self
    }

    pub fn size(&self) -> usize {
        self.M.nrows()
    }

    /// Matrices of the body, with the damping ratio [`RATIO`] in the modes that leave the first nodes at rest.
    pub fn matrices(&self, still: usize) -> PartKind {
        let fixed = self.modes(still);
        let weights = DMatrix::from_diagonal(&fixed.frequencies.map(|frequency| 2.0 * RATIO * frequency));
        let mut bent = DMatrix::identity(self.size(), self.size());
        let mut carried = bent.columns_mut(0, 6 * still);
        carried -= self.constraint_modes(still);
        let modal = fixed.shapes.tr_mul(&self.M) * bent;
        PartKind::Matrices(Matrices {
            mass: self.mass.clone(),
            stiffness: entries(&self.K),
            damping: entries(&(modal.tr_mul(&weights) * &modal)),
            rheology: Rheology::Elastic,
        })
    }

    /// Modes in which the first nodes stay at rest, of modal mass one, the lowest first.
    pub fn modes(&self, still: usize) -> ExportedModes {
        let (first, rest) = (6 * still, self.size() - 6 * still);
        let part = |matrix: &DMatrix<f64>| matrix.view((first, first), (rest, rest)).into_owned();
        let inverse = part(&self.M).cholesky().unwrap().l().try_inverse().unwrap();
        let eigen = (&inverse * part(&self.K) * inverse.transpose()).symmetric_eigen();
        let mut ascending: Vec<usize> = (0..rest).collect();
        ascending.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let mut shapes = DMatrix::zeros(self.size(), rest);
        let vectors = inverse.tr_mul(&eigen.eigenvectors).select_columns(&ascending);
        shapes.rows_mut(first, rest).copy_from(&vectors);
        let frequencies = ascending.iter().map(|mode| eigen.eigenvalues[*mode].max(0.0).sqrt());
        ExportedModes { shapes, frequencies: DVector::from_iterator(rest, frequencies) }
    }

    /// Responses of the nodes beyond the first to displacements of these: constraint modes.
    pub fn constraint_modes(&self, still: usize) -> DMatrix<f64> {
        let (first, rest) = (6 * still, self.size() - 6 * still);
        if still == 0 {
            return DMatrix::zeros(self.size(), 0);
        }
        let inner = self.K.view((first, first), (rest, rest)).into_owned();
        let coupling = self.K.view((first, 0), (rest, first)).into_owned();
        let mut shapes = DMatrix::identity(self.size(), first);
        shapes.rows_mut(first, rest).copy_from(&-inner.cholesky().unwrap().solve(&coupling));
        shapes
    }
}

/// Modes of a body.
pub struct ExportedModes {
    pub shapes: DMatrix<f64>,
    /// Natural frequencies (rad/s).
    pub frequencies: DVector<f64>,
}

/// The six rigid motions.
fn rigid(nodes: &[[f64; 3]]) -> DMatrix<f64> {
    let mut rigid = DMatrix::zeros(6 * nodes.len(), 6);
    for (node, place) in nodes.iter().enumerate() {
        let mut rows = rigid.view_mut((6 * node, 0), (6, 6));
        rows.fill_with_identity();
        rows.view_mut((0, 3), (3, 3)).copy_from(&-Vector3::from(*place).cross_matrix());
    }
    rigid
}

/// Rows, columns and entries of a symmetric matrix.
pub fn entries(matrix: &DMatrix<f64>) -> Vec<(usize, usize, f64)> {
    let size = matrix.ncols();
    (0..matrix.nrows() * size)
        .map(|entry| {
            (
                entry / size,
                entry % size,
                0.5 * (matrix[(entry / size, entry % size)] + matrix[(entry % size, entry / size)]),
            )
        })
        .filter(|(.., value)| *value != 0.0)
        .collect()
}
