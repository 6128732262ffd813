//! Degrees of freedom: displacements and rotations of nodes as combinations of the unknowns of a structure.
//! Every constraint is a combination of this kind, so the matrices stay positive and there are no equations of constraint.
//! Equations (K1) and (K2), docs/theory/12-structures.md.

use std::sync::Arc;

use nalgebra::{DMatrix, Vector3};

use super::rows::{Circle, Rows};

/// Node: its place, and whether it has rotations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// Equilibrium position (m), in the file's frame.
    pub place: Vector3<f64>,
    /// Whether the node has rotations beside its displacements.
    pub rotations: bool,
}

impl Node {
    /// Number of its degrees of freedom: displacements, and rotations where it has them.
    pub fn dofs(&self) -> usize {
        if self.rotations { 6 } else { 3 }
    }
}

/// Component of a node, with the nodes and components that move it, and their shares.
pub(crate) type GivenRow = (usize, Vec<(usize, usize, f64)>);

/// Constraint of a node.
#[derive(Clone, Debug)]
pub(crate) enum Constraint {
    /// No constraint: only elements act on the node.
    Free,
    /// Components 0 to 5, translations before rotations, each true where it is free: the others are fixed.
    Partly([bool; 6]),
    /// Joint to the carrier or to another node: one rigid piece but for rotations about these axes; three axes are a ball joint.
    On {
        /// The other node; none for the carrier.
        base: Option<usize>,
        /// Axes of relative rotation, unit vectors.
        axes: Vec<Vector3<f64>>,
    },
    /// Given shapes: each component moves by shares of components of other nodes, columns of the shares.
    Shaped {
        /// Nodes and components that move the node.
        columns: Arc<[(usize, usize)]>,
        /// Shares, a row per component.
        shares: DMatrix<f64>,
    },
    /// Some components move by shares of components of other nodes, the others by themselves.
    Linear {
        /// Components that move by themselves; the others are still but for their shares.
        own: [bool; 6],
        /// Components with the nodes and components that move them, none of which such a constraint moves, and their shares.
        rows: Vec<GivenRow>,
    },
    /// Generalised coordinates: the node is no place, and its first components are so many of them.
    Coordinates(usize),
}

impl Constraint {
    /// Whether neither another node nor the carrier constrains the node.
    pub fn is_free(&self) -> bool {
        matches!(self, Self::Free | Self::Partly(_))
    }
}

/// An unknown of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unknown {
    /// Component 0 to 5 of the motion of a node.
    Node(usize, usize),
    /// Rotation of a constrained node about one of its axes.
    Joint(usize, usize),
    /// Generalised coordinate that a node holds as one of its components.
    Coordinate(usize, usize),
}

/// Displacements and rotations of the nodes as combinations of unknowns. (K2)
#[derive(Clone, Debug)]
pub(crate) struct Dofs {
    /// First degree of freedom of each node, and the end.
    first: Vec<usize>,
    /// First term of each degree of freedom, and the end.
    starts: Vec<usize>,
    /// Unknowns and their shares.
    terms: Vec<(usize, f64)>,
    unknowns: Vec<Unknown>,
}

impl Dofs {
    /// Degrees of freedom of nodes under these constraints.
    ///
    /// # Errors
    /// [`Circle`] if nodes constrain each other.
    pub fn new(nodes: &[Node], constraints: &[Constraint]) -> Result<Self, Circle> {
        let Rows { made, unknowns, .. } = Rows::new(nodes, constraints)?;
        let mut dofs = Self { first: vec![0], starts: vec![0], terms: Vec::new(), unknowns };
        for row in made {
            for terms in row {
                dofs.terms.extend(terms);
                dofs.starts.push(dofs.terms.len());
            }
            dofs.first.push(dofs.starts.len() - 1);
        }
        Ok(dofs)
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// First unknown of each group of unknowns of one node, and the end.
    pub fn groups(&self) -> Vec<u32> {
        let owner = |unknown: &Unknown| match *unknown {
            Unknown::Node(node, _) | Unknown::Joint(node, _) | Unknown::Coordinate(node, _) => node,
        };
        let starts = (1..self.unknowns.len())
            .filter(|index| owner(&self.unknowns[*index]) != owner(&self.unknowns[index - 1]));
        let mut groups: Vec<u32> = std::iter::once(0).chain(starts.map(|start| start as u32)).collect();
        groups.push(self.unknowns.len() as u32);
        groups
    }

    /// Unknowns that move a component of a node, with their shares.
    pub fn row(&self, node: usize, component: usize) -> &[(usize, f64)] {
        let dof = self.first[node] + component;
        &self.terms[self.starts[dof]..self.starts[dof + 1]]
    }

    /// Rows of an element with these nodes.
    pub fn rows<'a>(&'a self, nodes: &'a [usize], dofs: usize) -> impl Iterator<Item = &'a [(usize, f64)]> {
        nodes.iter().flat_map(move |node| (0..dofs).map(move |component| self.row(*node, component)))
    }

    /// Fields over the unknowns, a row each, over the degrees of freedom of an element.
    pub fn spread(&self, nodes: &[usize], dofs: usize, fields: &DMatrix<f64>) -> DMatrix<f64> {
        let mut spread = DMatrix::zeros(fields.nrows(), nodes.len() * dofs);
        for (number, row) in self.rows(nodes, dofs).enumerate() {
            for (unknown, share) in row {
                spread.column_mut(number).axpy(*share, &fields.column(*unknown), 1.0);
            }
        }
        spread
    }

    /// Adds forces over the degrees of freedom of an element, a row each, to those over the unknowns.
    pub fn gather(&self, nodes: &[usize], dofs: usize, forces: &DMatrix<f64>, sum: &mut DMatrix<f64>) {
        for (number, row) in self.rows(nodes, dofs).enumerate() {
            for (unknown, share) in row {
                sum.column_mut(*unknown).axpy(*share, &forces.column(number), 1.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknowns_of_one_node_are_a_group() {
        let nodes = [true, false, true].map(|rotations| Node { place: Vector3::zeros(), rotations });
        let partly = Constraint::Partly([true, false, false, true, false, false]);
        let dofs = Dofs::new(&nodes, &[Constraint::Free, Constraint::Free, partly]).unwrap();
        assert_eq!(dofs.groups(), [0, 6, 9, 11]);
    }
}
