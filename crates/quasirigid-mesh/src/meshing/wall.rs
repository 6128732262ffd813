//! Nodes in the middles of edges on a wall, moved to the surface.

use super::jacobian::least_jacobian;
use super::quadratic::Quadratic;
use crate::surface::Proximity;
use quasirigid_math::vec3::{add, norm, scale};

/// Largest shift of a middle, as a share of its edge: beyond, another part of the surface is near.
const LARGEST_SHIFT: f64 = 0.25;
/// Least Jacobian of a curved cell relative to that of the straight one.
const LEAST_JACOBIAN: f64 = 0.3;
/// Corners of the faces of a tetrahedron, and the nodes in the middles of their edges.
const FACES: [([usize; 3], [usize; 3]); 4] =
    [([0, 1, 2], [4, 5, 6]), ([0, 1, 3], [4, 7, 8]), ([1, 2, 3], [5, 8, 9]), ([0, 2, 3], [6, 7, 9])];

/// Nodes at corners and middles of edges; those of edges on the wall are on the surface where no cell bends too much.
pub(super) fn curved(corners: Vec<[f64; 3]>, mesh: &Quadratic, surface: &Proximity) -> Vec<[f64; 3]> {
    let first = corners.len();
    let mut nodes = corners;
    let middle = |[a, b]: [usize; 2]| scale(0.5, add(nodes[a], nodes[b]));
    let straight: Vec<[f64; 3]> = mesh.edges.iter().map(|ends| middle(*ends)).collect();
    nodes.extend(&straight);
    for node in on_wall(mesh) {
        let [a, b] = mesh.edges[node - first].map(|end| nodes[end]);
        let at = surface.nearest(nodes[node]).at;
        if norm(add(at, scale(-1.0, nodes[node]))) <= LARGEST_SHIFT * norm(add(b, scale(-1.0, a))) {
            nodes[node] = at;
        }
    }
    loop {
        let bent = |cell: &&[usize; 10]| !(least_jacobian(&cell.map(|node| nodes[node])) >= LEAST_JACOBIAN);
        let bent: Vec<&[usize; 10]> = mesh.cells.iter().filter(bent).collect();
        let mut moved = false;
        for node in bent.into_iter().flat_map(|cell| &cell[4..]) {
            moved |= nodes[*node] != straight[node - first];
            nodes[*node] = straight[node - first];
        }
        if !moved {
            return nodes;
        }
    }
}

/// Middles of the edges of faces that belong to one cell only, ascending.
fn on_wall(mesh: &Quadratic) -> Vec<usize> {
    let mut faces: Vec<([usize; 3], [usize; 3])> = Vec::with_capacity(4 * mesh.cells.len());
    for cell in &mesh.cells {
        for (corners, middles) in FACES {
            let mut corners = corners.map(|node| cell[node]);
            corners.sort_unstable();
            faces.push((corners, middles.map(|node| cell[node])));
        }
    }
    faces.sort_unstable_by_key(|(corners, _)| *corners);
    let alone = faces.chunk_by(|a, b| a.0 == b.0).filter(|face| face.len() == 1);
    let mut middles: Vec<usize> = alone.flat_map(|face| face[0].1).collect();
    middles.sort_unstable();
    middles.dedup();
    middles
}
