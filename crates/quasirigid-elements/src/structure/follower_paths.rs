//! Curved paths of nodes that follow others: an arm `p` that a rotation `θ` of its base carries ends at `θ × p + ½ θ × (θ × p)`, and a hinge
//! rotates with its base. Their second order bends what is fixed to them, and carries the masses on them.
//! Equation (K19), docs/theory/12-structures.md.

use std::collections::HashMap;

use nalgebra::{DMatrix, Vector3};

use super::discrete::{Discrete, Structure};
use super::dofs::{Constraint, GivenRow};
use super::pairs::Pairs;
use super::rows::order;
use crate::finite::{Element, carried};

/// Second order of the degrees of freedom of nodes that follow others, beside that of the unknowns: a row per pair of coordinates.
pub(super) struct FollowerPaths {
    pairs: usize,
    of: HashMap<usize, DMatrix<f64>>,
}

impl Discrete<'_> {
    /// Second order of the nodes that follow others, with displacements `fields` of the unknowns, a row per coordinate. (K19)
    pub(super) fn follower_paths(&self, fields: &DMatrix<f64>) -> FollowerPaths {
        let pairs = Pairs(fields.nrows());
        let mut paths = FollowerPaths { pairs: pairs.count(), of: HashMap::new() };
        for node in order(&self.structure.constraints).into_iter().flatten() {
            let path = match &self.structure.constraints[node] {
                Constraint::On { base: Some(base), .. } => self.on_base(node, *base, &pairs, fields, &paths),
                Constraint::Shaped { columns, shares } => {
                    paths.shared(columns, &shares.rows(0, self.structure.nodes[node].dofs()).into_owned())
                }
                Constraint::Linear { rows, .. } => paths.some(rows, self.structure.nodes[node].dofs()),
                Constraint::On { base: None, .. }
                | Constraint::Free
                | Constraint::Partly(_)
                | Constraint::Coordinates(_) => None,
            };
            if let Some(path) = path {
                paths.of.insert(node, path);
            }
        }
        paths
    }

    /// `½ D_jk q_j q_k` of a node on a base that rotates by `θ`, itself by `φ` more: `½ θ × (θ × p)` of its displacement, `½ θ × φ` of its
    /// rotation, beside what the base's own second order carries.
    fn on_base(
        &self,
        node: usize,
        base: usize,
        pairs: &Pairs,
        fields: &DMatrix<f64>,
        paths: &FollowerPaths,
    ) -> Option<DMatrix<f64>> {
        let [size, of_base] = [node, base].map(|node| self.structure.nodes[node].dofs());
        let arm = self.structure.nodes[node].place - self.structure.nodes[base].place;
        let hinged = self.rotates_on(node, base);
        let known = paths.of.get(&base);
        if known.is_none() && (of_base == 3 || (arm == Vector3::zeros() && !hinged)) {
            return None;
        }
        let mut path = DMatrix::zeros(pairs.count(), size);
        if let Some(known) = known {
            let both = size.min(of_base);
            path.columns_mut(0, both).copy_from(&known.columns(0, both));
            if of_base == 6 {
                let carried = known.columns(3, 3) * arm.cross_matrix();
                let mut displacements = path.columns_mut(0, 3);
                displacements += carried;
            }
        }
        if of_base == 6 {
            let rotations = |node: usize| self.dofs.spread(&[node], 6, fields).columns(3, 3).into_owned();
            let turned = rotations(base);
            let relative = (size == 6).then(|| rotations(node) - &turned);
            let of = |rows: &DMatrix<f64>, j: usize| Vector3::new(rows[(j, 0)], rows[(j, 1)], rows[(j, 2)]);
            for (mut row, (j, k)) in path.row_iter_mut().zip(pairs.iter()) {
                let (a, b) = (of(&turned, j), of(&turned, k));
                let mut displacement = row.columns_mut(0, 3);
                displacement += carried(&a, &b, &arm).transpose();
                if let Some(relative) = &relative {
                    let mut rotation = row.columns_mut(3, 3);
                    rotation += 0.5 * (a.cross(&of(relative, k)) + b.cross(&of(relative, j))).transpose();
                }
            }
        }
        Some(path)
    }

    /// Whether a node rotates about axes of its own on its base.
    fn rotates_on(&self, node: usize, base: usize) -> bool {
        let rotates = |component| self.dofs.row(node, component) != self.dofs.row(base, component);
        [node, base].iter().all(|node| self.structure.nodes[*node].rotations) && (3..6).any(rotates)
    }
}

impl FollowerPaths {
    /// Bytes of the paths of a structure with so many coordinates, at most.
    pub fn room(structure: &Structure, coordinates: usize) -> f64 {
        let follows = |constraint: &&Constraint| {
            matches!(
                constraint,
                Constraint::On { base: Some(_), .. } | Constraint::Shaped { .. } | Constraint::Linear { .. }
            )
        };
        let nodes = structure.constraints.iter().filter(follows).count();
        (nodes * 6 * Pairs(coordinates).count() * size_of::<f64>()) as f64
    }

    pub fn is_empty(&self) -> bool {
        self.of.is_empty()
    }

    /// Second order of a node; none of one that follows no other.
    pub fn of(&self, node: usize) -> Option<&DMatrix<f64>> {
        self.of.get(&node)
    }

    /// Second order over the degrees of freedom of an element, a row per pair; none where its nodes follow no others.
    pub fn spread(&self, element: &dyn Element) -> Option<DMatrix<f64>> {
        let (nodes, dofs) = (element.nodes(), element.dofs());
        if self.of.is_empty() || !nodes.iter().any(|node| self.of.contains_key(node)) {
            return None;
        }
        let mut spread = DMatrix::zeros(self.pairs, nodes.len() * dofs);
        for (number, path) in nodes.iter().enumerate().filter_map(|(i, node)| Some((i, self.of.get(node)?))) {
            let both = dofs.min(path.ncols());
            spread.columns_mut(number * dofs, both).copy_from(&path.columns(0, both));
        }
        Some(spread)
    }

    /// Second order of a node some of whose components move by shares of components of others.
    fn some(&self, rows: &[GivenRow], dofs: usize) -> Option<DMatrix<f64>> {
        let mut path = DMatrix::zeros(self.pairs, dofs);
        let mut curved = false;
        for (component, terms) in rows.iter().filter(|(component, _)| *component < dofs) {
            for (base, of, share) in terms {
                if let Some(known) = self.of.get(base) {
                    path.column_mut(*component).axpy(*share, &known.column(*of), 1.0);
                    curved = true;
                }
            }
        }
        curved.then_some(path)
    }

    /// Second order of a node that moves by shares of the components of others.
    fn shared(&self, columns: &[(usize, usize)], shares: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        columns.iter().any(|(base, _)| self.of.contains_key(base)).then(|| {
            let mut path = DMatrix::zeros(self.pairs, shares.nrows());
            for ((base, component), share) in columns.iter().zip(shares.column_iter()) {
                if let Some(known) = self.of.get(base) {
                    path += known.column(*component) * share.transpose();
                }
            }
            path
        })
    }
}
