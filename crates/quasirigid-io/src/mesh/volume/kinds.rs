//! Kinds of cells of containers: a shape with the order of its nodes, or a pyramid, which is divided.

use quasirigid_mesh::Shape;

use super::draft::Draft;
use crate::mesh::error::MeshProblem;

/// A kind of cell in the order of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind {
    /// Shape of the cell; none for a pyramid.
    pub(super) shape: Option<Shape>,
    /// Nodes of the cell in the file.
    pub(super) nodes: usize,
    /// Index in the order of the file of each node; as they come where it is empty.
    order: &'static [u8],
}

impl Kind {
    pub(super) const fn new(shape: Shape, nodes: usize, order: &'static [u8]) -> Self {
        Self { shape: Some(shape), nodes, order }
    }

    pub(super) const fn pyramid(nodes: usize, order: &'static [u8]) -> Self {
        Self { shape: None, nodes, order }
    }

    /// Adds a cell, and returns its index, of a pyramid that of its first half.
    pub(super) fn add(self, draft: &mut Draft, label: u64, nodes: &[u64]) -> Result<usize, MeshProblem> {
        let ordered = self.ordered(nodes);
        match self.shape {
            Some(shape) => draft.add_cell(label, shape, &ordered),
            None => draft.add_pyramid(label, &ordered),
        }
    }

    /// The nodes of a cell in the order of its shape, those of a pyramid in that of its halves.
    pub(super) fn ordered(self, nodes: &[u64]) -> Vec<u64> {
        let of = |place: usize| nodes[self.order.get(place).map_or(place, |place| usize::from(*place))];
        (0..nodes.len().min(27)).map(of).collect()
    }
}
