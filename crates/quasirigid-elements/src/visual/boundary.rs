//! Boundary of a mesh: faces of solid cells that no other cell shares, and all face cells, as triangles of corners.

use std::collections::HashMap;

use quasirigid_mesh::{Mesh, Shape};

/// Triangles between the corner nodes of the boundary, outward.
pub(crate) fn boundary(mesh: &Mesh, cells: impl Iterator<Item = usize>) -> Vec<[usize; 3]> {
    let mut seen: HashMap<Vec<usize>, Option<Vec<usize>>> = HashMap::new();
    let mut order = Vec::new();
    for cell in cells.map(|index| &mesh.cells[index]) {
        for face in faces(cell.shape) {
            let face: Vec<usize> = face.iter().map(|corner| cell.nodes[*corner]).collect();
            let mut key = face.clone();
            key.sort_unstable();
            order.push(key.clone());
            seen.entry(key).and_modify(|other| *other = None).or_insert(Some(face));
        }
    }
    let single = order.iter().filter_map(|key| seen.remove(key).flatten());
    single.flat_map(|face| (1..face.len() - 1).map(move |i| [face[0], face[i], face[i + 1]])).collect()
}

/// Corners of the faces of a cell, counter-clockwise seen from outside; of a face cell the cell itself.
fn faces(shape: Shape) -> &'static [&'static [usize]] {
    match shape {
        Shape::Line2 | Shape::Line3 => &[],
        Shape::Triangle3 | Shape::Triangle6 => &[&[0, 1, 2]],
        Shape::Quad4 | Shape::Quad8 | Shape::Quad9 => &[&[0, 1, 2, 3]],
        Shape::Tet4 | Shape::Tet10 => &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]],
        Shape::Wedge6 | Shape::Wedge15 => {
            &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]]
        }
        Shape::Hex8 | Shape::Hex20 | Shape::Hex27 => {
            &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]]
        }
    }
}
