//! Grid of a cavity: ten-node tetrahedra from a mesh, with its walls.
//! A mesh that is not one cavity is refused here with the nodes at fault; later it would only show as a singular matrix.
//! Equation (L4), docs/theory/13-inside.md.

use std::collections::HashMap;

use super::StokesError;
use super::cell::NODES;
use crate::math::connected_components::connected_components;
use crate::math::vec3::{add, scale};
use quasirigid_mesh::{Cell, Mesh, Shape};

/// Ends of the edges of a tetrahedron, in the order of their middle nodes.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
/// Nodes of the faces of a tetrahedron, corners first.
pub(super) const FACES: [[usize; 6]; 4] =
    [[1, 2, 3, 5, 8, 9], [0, 2, 3, 6, 7, 9], [0, 1, 3, 4, 7, 8], [0, 1, 2, 4, 5, 6]];

/// Quadratic tetrahedra that fill a cavity.
pub(super) struct Grid {
    /// Places of the nodes of the mesh (m), and of those made in the middles of edges.
    pub places: Vec<[f64; 3]>,
    /// Nodes of each cell, in the order of [`Shape::Tet10`].
    pub cells: Vec<[usize; NODES]>,
    /// Whether each node is on a wall.
    pub walls: Vec<bool>,
    /// Cell and place in [`FACES`] of each face that is a wall.
    pub faces: Vec<(usize, usize)>,
}

impl Grid {
    /// Grid of the tetrahedra of a mesh, once they are known to be one cavity.
    ///
    /// # Errors
    /// [`StokesError`], all but those of the equations.
    pub fn new(mesh: &Mesh) -> Result<Self, StokesError> {
        let mesh = tetrahedra(mesh)?;
        mesh.check().map_err(StokesError::Mesh)?;
        let middles = middles(&mesh)?;
        let mut grid =
            Self { places: mesh.nodes.clone(), cells: Vec::new(), walls: Vec::new(), faces: Vec::new() };
        grid.complete(&mesh, middles);
        grid.enclose(&mesh.node_labels)?;
        Ok(grid)
    }

    /// Gives each cell ten nodes.
    fn complete(&mut self, mesh: &Mesh, mut middles: HashMap<[usize; 2], usize>) {
        for cell in &mesh.cells {
            let mut nodes = [0; NODES];
            nodes[..4].copy_from_slice(&cell.nodes[..4]);
            for (place, edge) in EDGES.iter().enumerate() {
                let ends = edge.map(|corner| cell.nodes[corner]);
                nodes[4 + place] = *middles.entry(ordered(ends)).or_insert_with(|| {
                    let [a, b] = ends.map(|end| self.places[end]);
                    self.places.push(scale(0.5, add(a, b)));
                    self.places.len() - 1
                });
            }
            self.cells.push(nodes);
        }
    }

    /// Finds the walls, the faces of one cell only.
    fn enclose(&mut self, labels: &[u64]) -> Result<(), StokesError> {
        let corners = |cell: usize, face: usize| {
            let [a, b, c, ..] = FACES[face].map(|node| self.cells[cell][node]);
            ordered([a, b, c])
        };
        let mut faces: Vec<([usize; 3], usize, usize)> = (0..self.cells.len())
            .flat_map(|cell| (0..FACES.len()).map(move |face| (cell, face)))
            .map(|(cell, face)| (corners(cell, face), cell, face))
            .collect();
        faces.sort_unstable();
        let mut pairs = Vec::with_capacity(faces.len() / 2);
        self.walls = vec![false; self.places.len()];
        for same in faces.chunk_by(|a, b| a.0 == b.0) {
            match *same {
                [(_, cell, face)] => {
                    self.faces.push((cell, face));
                    FACES[face].iter().for_each(|node| self.walls[self.cells[cell][*node]] = true);
                }
                [(_, a, _), (_, b, _)] => pairs.push([a, b]),
                _ => {
                    let corners = same[0].0.map(|node| labels[node]);
                    return Err(StokesError::CrowdedFace { corners, count: same.len() });
                }
            }
        }
        let count = connected_components(self.cells.len(), pairs).len();
        if count > 1 { Err(StokesError::Pieces { count }) } else { Ok(()) }
    }
}

/// The mesh without faces and lines, and with places for nodes that nothing uses.
fn tetrahedra(mesh: &Mesh) -> Result<Mesh, StokesError> {
    let solids: Vec<&Cell> = mesh.cells.iter().filter(|cell| cell.shape.dimension() == 3).collect();
    let mut others = solids.iter().filter(|cell| !matches!(cell.shape, Shape::Tet4 | Shape::Tet10));
    if let Some(first) = others.next() {
        let count = 1 + others.count();
        return Err(StokesError::OtherShape { cell: first.label, shape: first.shape, count });
    }
    if solids.is_empty() {
        return Err(StokesError::NoTetrahedra);
    }
    let mut nodes = vec![[0.0; 3]; mesh.nodes.len()];
    for node in solids.iter().flat_map(|cell| &cell.nodes) {
        if let (Some(place), Some(known)) = (nodes.get_mut(*node), mesh.nodes.get(*node)) {
            *place = *known;
        }
    }
    let cells = solids.into_iter().cloned().collect();
    Ok(Mesh { nodes, node_labels: mesh.node_labels.clone(), cells, sets: Vec::new() })
}

/// Nodes that the mesh has in the middles of edges.
fn middles(mesh: &Mesh) -> Result<HashMap<[usize; 2], usize>, StokesError> {
    // Ends between which each node lies; a corner between itself.
    let mut between: Vec<Option<[usize; 2]>> = vec![None; mesh.nodes.len()];
    let mut middles = HashMap::new();
    let label = |node: usize| mesh.node_labels[node];
    let mut place = |node: usize, ends: [usize; 2]| {
        if *between[node].get_or_insert(ends) == ends {
            Ok(())
        } else {
            Err(StokesError::Hanging { node: label(node) })
        }
    };
    for cell in &mesh.cells {
        let (corners, others) = cell.nodes.split_at(4);
        corners.iter().try_for_each(|corner| place(*corner, [*corner; 2]))?;
        for (edge, middle) in EDGES.iter().zip(others) {
            let ends = ordered(edge.map(|corner| corners[corner]));
            let known = *middles.entry(ends).or_insert(*middle);
            if known != *middle {
                let middles = [known, *middle].map(label);
                return Err(StokesError::TornEdge { ends: ends.map(label), middles });
            }
            place(*middle, ends)?;
        }
    }
    Ok(middles)
}

fn ordered<const N: usize>(mut nodes: [usize; N]) -> [usize; N] {
    nodes.sort_unstable();
    nodes
}
