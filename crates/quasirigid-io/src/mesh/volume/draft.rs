//! Mesh under construction: nodes and cells by the labels of their file, sets by name.
//! Labels are arbitrary 64-bit numbers, so indices come from a hash map and not from a table as long as the greatest label.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use quasirigid_mesh::{Cell, Mesh, Shape};

use super::problem::VolumeProblem;
use super::sets::Sets;
use super::{MeshProblem, Part};

/// A mesh on its way from a file that numbers nodes and cells as it likes.
#[derive(Default)]
pub(super) struct Draft {
    nodes: Vec<[f64; 3]>,
    node_labels: Vec<u64>,
    node_of: HashMap<u64, usize>,
    cells: Vec<Cell>,
    cell_of: HashMap<u64, usize>,
    pub(super) sets: Sets,
}

impl Draft {
    /// Adds a node, and returns its index.
    pub(super) fn add_node(&mut self, label: u64, place: [f64; 3]) -> Result<usize, MeshProblem> {
        finite(label, place)?;
        insert(&mut self.node_of, Part::Nodes, label, self.nodes.len())?;
        self.nodes.push(place);
        self.node_labels.push(label);
        Ok(self.nodes.len() - 1)
    }

    /// Adds a cell whose nodes stand in the order of [`Shape`], and returns its index.
    pub(super) fn add_cell(&mut self, label: u64, shape: Shape, nodes: &[u64]) -> Result<usize, MeshProblem> {
        let index =
            |node: &u64| self.node(*node).ok_or(VolumeProblem::NoSuchNode { cell: label, node: *node });
        let nodes = nodes.iter().map(index).collect::<Result<_, _>>()?;
        insert(&mut self.cell_of, Part::Cells, label, self.cells.len())?;
        self.cells.push(Cell { label, shape, nodes });
        Ok(self.cells.len() - 1)
    }

    /// Index of the node with this number.
    pub(super) fn node(&self, label: u64) -> Option<usize> {
        self.node_of.get(&label).copied()
    }

    /// Index of the cell with this number.
    pub(super) fn cell(&self, label: u64) -> Option<usize> {
        self.cell_of.get(&label).copied()
    }

    /// Numbers of the nodes, in their order.
    pub(super) fn node_labels(&self) -> &[u64] {
        &self.node_labels
    }

    /// The cells so far.
    pub(super) fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The mesh.
    pub(super) fn mesh(self) -> Mesh {
        let Self { nodes, node_labels, cells, sets, .. } = self;
        Mesh { nodes, node_labels, cells, sets: sets.sorted() }
    }
}

/// Refuses a node whose coordinates are not finite.
pub(super) fn finite(label: u64, place: [f64; 3]) -> Result<(), MeshProblem> {
    match place.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(VolumeProblem::NotFinite { node: label, found: x.to_string().into() }.into()),
        None => Ok(()),
    }
}

fn insert(of: &mut HashMap<u64, usize>, part: Part, label: u64, index: usize) -> Result<(), VolumeProblem> {
    match of.entry(label) {
        Entry::Occupied(_) => Err(VolumeProblem::Twice { part, label }),
        Entry::Vacant(vacant) => {
            vacant.insert(index);
            Ok(())
        }
    }
}
