//! Notes on a mesh: suspect features that may be meant, as unused or coincident nodes and parts that nothing joins.
//! They do not stop a computation, unlike the faults of `check.rs`; a part of finite elements refuses some of them itself.

use std::collections::HashMap;

use thiserror::Error;

use super::Mesh;
use super::fault::among;
use quasirigid_math::connected_components::connected_components;
use quasirigid_math::vec3::{add, norm, scale};

/// Suspect feature of a mesh, which may be meant. Nodes go by the numbers of their file.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshNote {
    /// Nodes of no cell.
    #[error("{count} {} to no cell: {}{}", if *count == 1 { "node belongs" } else { "nodes belong" }, listed(first), if *count > first.len() { ", …" } else { "" })]
    Unused {
        /// Number of such nodes.
        count: usize,
        /// Numbers of the first of them, at most five.
        first: Vec<u64>,
    },
    /// Different nodes at the same place, between which cells do not hang together.
    #[error("nodes {} and {} are at the same place{}; merge them unless the parts may move apart", nodes[0], nodes[1], among(*count, "pairs"))]
    Coincident {
        /// The first such pair.
        nodes: [u64; 2],
        /// Number of nodes at the place of an earlier one.
        count: usize,
    },
    /// Cells that share no node with others, directly or through cells between.
    #[error(
        "the cells form {count} parts that share no node; each moves on its own unless something else joins them"
    )]
    Parts {
        /// Number of parts.
        count: usize,
    },
}

/// Distance of nodes, relative to the size of the mesh, below which they are at the same place.
const SAME_PLACE: f64 = 1e-9;
/// Most nodes that a note lists.
const LISTED: usize = 5;

impl Mesh {
    /// Suspect features of a mesh that [`Mesh::check`] accepts.
    #[must_use]
    pub fn notes(&self) -> Vec<MeshNote> {
        [self.unused(), self.coincident(), self.apart()].into_iter().flatten().collect()
    }

    fn unused(&self) -> Option<MeshNote> {
        let mut used = vec![false; self.nodes.len()];
        self.cells.iter().flat_map(|cell| &cell.nodes).for_each(|node| used[*node] = true);
        let mut unused =
            used.iter().zip(&self.node_labels).filter(|(used, _)| !**used).map(|(_, label)| *label);
        let first: Vec<u64> = unused.by_ref().take(LISTED).collect();
        let count = first.len() + unused.count();
        (count > 0).then_some(MeshNote::Unused { count, first })
    }

    /// Searches each node's neighbours in the boxes within reach, twice as wide as the distance that counts as none.
    fn coincident(&self) -> Option<MeshNote> {
        let bound = |pick: fn(f64, f64) -> f64| {
            let first = self.nodes.first().copied().unwrap_or_default();
            self.nodes
                .iter()
                .fold(first, |bound, node| std::array::from_fn(|axis| pick(bound[axis], node[axis])))
        };
        let (low, high) = (bound(f64::min), bound(f64::max));
        let reach = SAME_PLACE * norm(add(high, scale(-1.0, low)));
        let mut boxes: HashMap<[i64; 3], Vec<usize>> = HashMap::with_capacity(self.nodes.len());
        let mut pairs = Vec::new();
        for (node, place) in self.nodes.iter().enumerate() {
            let index =
                |away: f64, axis: usize| ((place[axis] - low[axis] + away) / (2.0 * reach)).floor() as i64;
            let near = (0..8).map(|corner| {
                std::array::from_fn(|axis| index(if corner >> axis & 1 == 0 { -reach } else { reach }, axis))
            });
            let same = |other: &usize| norm(add(self.nodes[*other], scale(-1.0, *place))) <= reach;
            let twin = near.filter_map(|index| boxes.get(&index)).flatten().copied().find(same);
            match twin {
                Some(twin) => pairs.push([self.node_labels[twin], self.node_labels[node]]),
                None => boxes.entry(std::array::from_fn(|axis| index(0.0, axis))).or_default().push(node),
            }
        }
        let nodes = *pairs.first()?;
        Some(MeshNote::Coincident { nodes, count: pairs.len() })
    }

    fn apart(&self) -> Option<MeshNote> {
        let pairs = self.cells.iter().flat_map(|cell| cell.nodes.windows(2)).map(|pair| [pair[0], pair[1]]);
        // A node of no cell is a part of its own.
        let count =
            connected_components(self.nodes.len(), pairs).iter().filter(|part| part.len() > 1).count();
        (count > 1).then_some(MeshNote::Parts { count })
    }
}

/// Numbers, separated.
fn listed(labels: &[u64]) -> String {
    labels.iter().map(u64::to_string).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, Shape};
    use super::*;

    /// Two tetrahedra that touch in a face and share its nodes, or have nodes of their own there at some distance.
    fn pair(distance: Option<f64>, unit: f64) -> Mesh {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, 0.4, -0.8]];
        let away =
            |at: [f64; 3], shift: f64| [at[0] + 8.0 + shift, at[1] - 3.0, at[2] + 0.7].map(|x| unit * x);
        let mut nodes: Vec<[f64; 3]> = corners.map(|at| away(at, 0.0)).to_vec();
        nodes.extend(
            distance.into_iter().flat_map(|shift| corners[..3].iter().map(move |at| away(*at, shift))),
        );
        let first = if distance.is_some() { 5 } else { 0 };
        let tetrahedron = |label, nodes: [usize; 4]| Cell { label, shape: Shape::Tet4, nodes: nodes.into() };
        Mesh {
            node_labels: (0..nodes.len() as u64).map(|node| 40 - node).collect(),
            nodes,
            cells: vec![tetrahedron(7, [0, 1, 2, 3]), tetrahedron(8, [first, first + 2, first + 1, 4])],
            sets: Vec::new(),
        }
    }

    #[test]
    fn a_whole_mesh_gives_no_notes() {
        assert_eq!(pair(None, 1.0).notes(), []);
    }

    #[test]
    fn nodes_at_the_same_place_are_told_on_both_sides_of_the_line() {
        // The box around the nodes has a diagonal of √(1 + 1 + 1.8²).
        let line = 1e-9 * 5.24_f64.sqrt();
        for unit in [1e-6, 1.0, 1e6] {
            let nodes = [40, 35];
            let expected = [MeshNote::Coincident { nodes, count: 3 }, MeshNote::Parts { count: 2 }];
            for distance in [0.0, 0.99 * line, -0.99 * line] {
                assert_eq!(pair(Some(distance), unit).notes(), expected, "{distance}");
            }
            assert_eq!(pair(Some(1.01 * line), unit).notes(), [MeshNote::Parts { count: 2 }]);
        }
    }

    #[test]
    fn unused_nodes_are_counted_and_the_first_listed() {
        let mut mesh = pair(None, 1.0);
        for k in 0..7_u64 {
            mesh.nodes.push([k as f64, 1.0, 5.0]);
            mesh.node_labels.push(100 + k);
        }
        let note = MeshNote::Unused { count: 7, first: vec![100, 101, 102, 103, 104] };
        assert_eq!(note.to_string(), "7 nodes belong to no cell: 100, 101, 102, 103, 104, …");
        assert_eq!(mesh.notes(), [note]);
    }
}
