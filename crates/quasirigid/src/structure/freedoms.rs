use std::sync::Arc;

use nalgebra::{DMatrix, Vector3};

use super::rows::{Circle, Rows};

/// Where a node is and whether it turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// Equilibrium position (m), in the file's frame.
    pub place: Vector3<f64>,
    /// Whether it has rotations beside its displacements.
    pub turns: bool,
}

/// How a node is held.
#[derive(Clone, Debug)]
pub(crate) enum Hold {
    /// By the elements alone.
    Free,
    /// By the elements, but for components 0 to 5 that do not move.
    Partly([bool; 6]),
    /// On the carrier, or on another node, as one rigid piece but for rotations about these axes; three axes are a ball
    /// joint.
    On {
        /// The other node; none for the carrier.
        base: Option<usize>,
        /// Axes of relative rotation, unit vectors.
        axes: Vec<Vector3<f64>>,
    },
    /// As shapes say: each component moves by shares of components of other nodes, columns of the shares.
    Shaped {
        /// Nodes and components that move it.
        columns: Arc<[(usize, usize)]>,
        /// Shares, a row per component.
        shares: DMatrix<f64>,
    },
    /// By nothing: it is no place, and its first components are so many generalised coordinates.
    Coordinates(usize),
}

impl Hold {
    /// Whether no other node and no carrier holds the node.
    pub fn is_free(&self) -> bool {
        matches!(self, Self::Free | Self::Partly(_))
    }
}

/// An unknown of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unknown {
    /// Component 0 to 5 of the motion of a node.
    Node(usize, usize),
    /// Rotation of a held node about one of its axes.
    Joint(usize, usize),
    /// Generalised coordinate that a node keeps as one of its components.
    Coordinate(usize, usize),
}

/// Displacements and rotations of the nodes as combinations of unknowns. (K2)
#[derive(Clone, Debug)]
pub(crate) struct Freedoms {
    /// First freedom of each node, and the end.
    first: Vec<usize>,
    /// First term of each freedom, and the end.
    starts: Vec<usize>,
    /// Unknowns and their shares.
    terms: Vec<(usize, f64)>,
    unknowns: Vec<Unknown>,
}

impl Freedoms {
    /// The freedoms of nodes that are held like this.
    ///
    /// # Errors
    /// [`Circle`] if nodes hold each other.
    pub fn new(nodes: &[Node], holds: &[Hold]) -> Result<Self, Circle> {
        let Rows { made, unknowns, .. } = Rows::new(nodes, holds)?;
        let mut freedoms = Self { first: vec![0], starts: vec![0], terms: Vec::new(), unknowns };
        for row in made {
            for terms in row {
                freedoms.terms.extend(terms);
                freedoms.starts.push(freedoms.terms.len());
            }
            freedoms.first.push(freedoms.starts.len() - 1);
        }
        Ok(freedoms)
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
        let freedom = self.first[node] + component;
        &self.terms[self.starts[freedom]..self.starts[freedom + 1]]
    }

    /// Rows of an element with these nodes.
    pub fn rows<'a>(
        &'a self,
        nodes: &'a [usize],
        freedoms: usize,
    ) -> impl Iterator<Item = &'a [(usize, f64)]> {
        nodes.iter().flat_map(move |node| (0..freedoms).map(move |component| self.row(*node, component)))
    }

    /// Fields over the unknowns, a row each, over the freedoms of an element.
    pub fn spread(&self, nodes: &[usize], freedoms: usize, fields: &DMatrix<f64>) -> DMatrix<f64> {
        let mut spread = DMatrix::zeros(fields.nrows(), nodes.len() * freedoms);
        for (number, row) in self.rows(nodes, freedoms).enumerate() {
            for (unknown, share) in row {
                spread.column_mut(number).axpy(*share, &fields.column(*unknown), 1.0);
            }
        }
        spread
    }

    /// Adds forces over the freedoms of an element, a row each, to those over the unknowns.
    pub fn gather(&self, nodes: &[usize], freedoms: usize, forces: &DMatrix<f64>, sum: &mut DMatrix<f64>) {
        for (number, row) in self.rows(nodes, freedoms).enumerate() {
            for (unknown, share) in row {
                sum.column_mut(*unknown).axpy(*share, &forces.column(number), 1.0);
            }
        }
    }
}
