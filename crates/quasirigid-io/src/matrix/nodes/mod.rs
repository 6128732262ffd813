//! Places of nodes: tables, `GRID` cards of NASTRAN, `*NODE` blocks of Abaqus and CalculiX.

mod grid;
mod input;
mod table;

use std::collections::HashSet;

pub(super) use grid::read as read_grid;
pub(super) use input::read as read_input;
pub(super) use table::read as read_table;

use super::error::{Fault, MatrixProblem, Place};
use super::listed::LocatedProblem;

/// A node of a finite-element model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Label of the node, unique in its file.
    pub label: u64,
    /// Place of the node in the global system, in the unit of the file; finite.
    pub place: [f64; 3],
    /// Unit vectors along which the rows of the node count, in the global system; none for its axes.
    pub axes: Option<[[f64; 3]; 3]>,
}

/// Nodes, each label once: in the order of a table, of cards and blocks in ascending order of their labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeTable {
    nodes: Vec<Node>,
}

impl NodeTable {
    /// All nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }
}

/// Nodes as they come up in a file.
#[derive(Default)]
struct NodeList {
    nodes: Vec<Node>,
    labels: HashSet<u64>,
}

impl NodeList {
    /// Adds a node that stands on a line.
    fn add(&mut self, label: u64, place: [f64; 3], line: usize) -> Result<(), LocatedProblem> {
        if !self.labels.insert(label) {
            return Err((line, MatrixProblem::NodeTwice { node: label }));
        }
        self.nodes.push(Node { label, place, axes: None });
        Ok(())
    }

    /// The nodes in ascending order of their labels, as programs that read cards sort them.
    fn sorted(mut self) -> Result<NodeTable, Fault> {
        self.nodes.sort_unstable_by_key(|node| node.label);
        self.table()
    }

    /// The nodes as they came up.
    fn table(self) -> Result<NodeTable, Fault> {
        if self.nodes.is_empty() {
            return Err((Place::File, MatrixProblem::NoNodes));
        }
        Ok(NodeTable { nodes: self.nodes })
    }
}
