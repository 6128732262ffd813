//! Checks of meshes for the tests.

use std::collections::HashMap;

use super::jacobian::least_jacobian;
use crate::{EDGES, Mesh, Rule, Shape};
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

/// Corners of the faces of a tetrahedron and, of each, its nodes between them.
const FACES: [([usize; 3], [usize; 3]); 4] =
    [([0, 2, 1], [6, 5, 4]), ([0, 1, 3], [4, 8, 7]), ([1, 2, 3], [5, 9, 8]), ([2, 0, 3], [6, 7, 9])];

/// Faces of one cell only, by corners and nodes between. Asserts that every other face has two cells that agree about all its nodes and
/// pass it in opposite directions, and that the wall is closed.
pub fn wall(mesh: &Mesh) -> Vec<[usize; 6]> {
    let mut faces: HashMap<[usize; 3], Vec<[usize; 6]>> = HashMap::new();
    for cell in &mesh.cells {
        for (corners, middles) in FACES {
            let nodes: [usize; 6] =
                std::array::from_fn(|k| cell.nodes[if k < 3 { corners[k] } else { middles[k - 3] }]);
            let mut key = [nodes[0], nodes[1], nodes[2]];
            key.sort_unstable();
            faces.entry(key).or_default().push(nodes);
        }
    }
    let mut wall = Vec::new();
    for sides in faces.into_values() {
        match sides.as_slice() {
            [side] => wall.push(*side),
            [side, other] => {
                let start = other.iter().position(|node| *node == side[0]).unwrap();
                let turned = [0, 2, 1].map(|k| other[(start + k) % 3]);
                assert_eq!(side[..3], turned, "neighbours pass a face in the same direction");
                let middle = |k: usize| other[3 + (start + 2 - k) % 3];
                assert_eq!(side[3..], [0, 1, 2].map(middle), "neighbours differ in middle nodes");
            }
            _ => panic!("a face of {} cells", sides.len()),
        }
    }
    let mut open: HashMap<[usize; 2], i64> = HashMap::new();
    for [a, b, c, ..] in &wall {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *open.entry([*from.min(to), *from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
    }
    assert!(open.values().all(|balance| *balance == 0), "the wall is open");
    wall
}

/// Corners less edges plus triangles of a wall.
pub fn euler_characteristic(wall: &[[usize; 6]]) -> i64 {
    let counted = |from: usize| {
        let mut nodes: Vec<usize> = wall.iter().flat_map(|face| face[from..from + 3].to_vec()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes.len() as i64
    };
    counted(0) - counted(3) + wall.len() as i64
}

/// Asserts a mesh of valid cells that fit, with a wall of some Euler characteristic, and returns its faces.
pub fn assert_valid(mesh: &Mesh, euler: i64) -> Vec<[usize; 6]> {
    assert_eq!(mesh.check(), Ok(()));
    assert_eq!(mesh.notes(), []);
    assert!(mesh.cells.iter().all(|cell| least_jacobian(&places(mesh, &cell.nodes)) > 0.0));
    let wall = wall(mesh);
    assert_eq!(euler_characteristic(&wall), euler);
    wall
}

/// Asserts a valid mesh, all of whose wall nodes, and no others, are on the zeros of `distance`.
pub fn assert_sound(mesh: &Mesh, euler: i64, distance: impl Fn([f64; 3]) -> f64) {
    let wall = assert_valid(mesh, euler);
    let size = mesh.nodes.iter().map(|node| norm(*node)).fold(0.0, f64::max);
    let mut on_wall = vec![false; mesh.nodes.len()];
    wall.iter().flatten().for_each(|node| on_wall[*node] = true);
    for (node, on_wall) in mesh.nodes.iter().zip(on_wall) {
        let away = distance(*node).abs() / size;
        // Sines, roots and quotients after one another.
        assert_eq!(away < 1e-14, on_wall, "{node:?} is {away:e} away");
    }
}

pub fn places(mesh: &Mesh, nodes: &[usize]) -> [[f64; 3]; 10] {
    std::array::from_fn(|node| mesh.nodes[nodes[node]])
}

/// Smallest and largest angle between two faces of a cell, in degrees, of the straight cells with the same corners.
pub fn angles_deg(mesh: &Mesh) -> [f64; 2] {
    let mut range = [180.0_f64, 0.0];
    for cell in &mesh.cells {
        let nodes = places(mesh, &cell.nodes);
        for edge in EDGES {
            let [c, d] = match (0..4).filter(|k| !edge.contains(k)).collect::<Vec<_>>()[..] {
                [c, d] => [c, d],
                _ => unreachable!(),
            };
            let from = |k: usize| add(nodes[k], scale(-1.0, nodes[edge[0]]));
            let along = from(edge[1]);
            let [m, n] = [c, d].map(|k| cross(along, from(k)));
            let angle = norm(cross(m, n)).atan2(dot(m, n)).to_degrees();
            range = [range[0].min(angle), range[1].max(angle)];
        }
    }
    range
}

/// Volume, and integrals of xx, yy, zz, yz, zx, xy, by the rule of the elements.
pub fn moments(mesh: &Mesh) -> [f64; 7] {
    let mut sums = [0.0; 7];
    for cell in &mesh.cells {
        let nodes = places(mesh, &cell.nodes);
        for sample in Shape::Tet10.samples(Rule::Products) {
            let (mut tangents, mut at) = ([[0.0; 3]; 3], [0.0; 3]);
            for (k, node) in nodes.iter().enumerate() {
                at = add(at, scale(sample.functions[k], *node));
                tangents = [0, 1, 2].map(|axis| add(tangents[axis], scale(sample.gradients[k][axis], *node)));
            }
            let weight = sample.weight * dot(tangents[0], cross(tangents[1], tangents[2]));
            let [x, y, z] = at;
            let values = [1.0, x * x, y * y, z * z, y * z, z * x, x * y];
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
    }
    sums
}

/// Largest error of the moments of a mesh: of the volume relative to itself, of the others relative to the largest of them.
pub fn error(mesh: &Mesh, exact: [f64; 7]) -> f64 {
    let found = moments(mesh);
    let largest = exact[1..].iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let second = (1..7).map(|k| (found[k] - exact[k]).abs() / largest).fold(0.0, f64::max);
    second.max((found[0] / exact[0] - 1.0).abs())
}

/// Asserts that errors of meshes with resolutions `n` and `2 n` fall with at least the power 3.5 of the width of a cell.
pub fn assert_fourth_order(exact: [f64; 7], n: usize, mesh: impl Fn(usize) -> Mesh) {
    let [coarse, fine] = [n, 2 * n].map(|n| error(&mesh(n), exact));
    let order = (coarse / fine).log2();
    assert!(order > 3.5, "{coarse:e} {fine:e}: order {order}");
}
