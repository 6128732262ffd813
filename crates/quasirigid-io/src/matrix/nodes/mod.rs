//! Places of nodes: tables, `GRID` cards of NASTRAN, `*NODE` blocks of Abaqus and CalculiX.

mod grid;
mod input;
mod table;

use std::collections::BTreeMap;

pub(super) use grid::read as read_grid;
pub(super) use input::read as read_input;
pub(super) use table::read as read_table;

use super::error::{Fault, MatrixProblem, Place};
use super::listed::At;

/// A node of a finite-element model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Its label, unique in its file.
    pub label: u64,
    /// Its place in the global system, in the unit of the file; finite.
    pub place: [f64; 3],
}

/// Nodes in ascending order of their labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeTable {
    nodes: Vec<Node>,
}

impl NodeTable {
    /// All nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Where the node of a label is, if there is one.
    pub fn place(&self, label: u64) -> Option<[f64; 3]> {
        let index = self.nodes.binary_search_by_key(&label, |node| node.label).ok()?;
        Some(self.nodes[index].place)
    }
}

/// Nodes as they come up in a file.
#[derive(Default)]
struct Found(BTreeMap<u64, [f64; 3]>);

impl Found {
    /// Adds a node that stands on a line.
    fn add(&mut self, label: u64, place: [f64; 3], line: usize) -> Result<(), At> {
        match self.0.insert(label, place) {
            None => Ok(()),
            Some(_) => Err((line, MatrixProblem::NodeTwice { node: label })),
        }
    }

    fn table(self) -> Result<NodeTable, Fault> {
        if self.0.is_empty() {
            return Err((Place::File, MatrixProblem::NoNodes));
        }
        Ok(NodeTable { nodes: self.0.into_iter().map(|(label, place)| Node { label, place }).collect() })
    }
}
