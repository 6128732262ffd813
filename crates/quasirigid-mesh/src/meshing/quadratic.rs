//! Tetrahedra of ten nodes from those of four corners.

use std::collections::HashMap;

use crate::{Cell, EDGES, Mesh, Shape};

/// Tetrahedra with a node in the middle of every edge, numbered after the corners.
pub(super) struct Quadratic {
    pub cells: Vec<[usize; 10]>,
    /// Ends of the edges, in the order of their nodes.
    pub edges: Vec<[usize; 2]>,
}

impl Quadratic {
    /// Quadratic cells from cells by their corners, which are nodes below `corners`.
    pub fn new(cells: &[[usize; 4]], corners: usize) -> Self {
        let mut edges = Vec::new();
        let mut known: HashMap<[usize; 2], usize> = HashMap::new();
        let mut middle = |[a, b]: [usize; 2]| {
            let ends = [a.min(b), a.max(b)];
            *known.entry(ends).or_insert_with(|| {
                edges.push(ends);
                corners + edges.len() - 1
            })
        };
        let ten = |cell: &[usize; 4]| {
            std::array::from_fn(|node| match node {
                0..4 => cell[node],
                _ => middle(EDGES[node - 4].map(|corner| cell[corner])),
            })
        };
        let cells = cells.iter().map(ten).collect();
        Self { cells, edges }
    }

    /// The mesh, with nodes and cells numbered from 1.
    pub fn mesh(self, nodes: Vec<[f64; 3]>) -> Mesh {
        let cell = |(index, nodes): (usize, [usize; 10])| Cell {
            label: index as u64 + 1,
            shape: Shape::Tet10,
            nodes: nodes.into(),
        };
        Mesh {
            node_labels: (1..=nodes.len() as u64).collect(),
            cells: self.cells.into_iter().enumerate().map(cell).collect(),
            nodes,
            sets: Vec::new(),
        }
    }
}
