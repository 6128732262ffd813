//! Regular meshes of bodies whose flow is known.

use std::collections::HashMap;

use crate::math::vec3::{add, cross, dot, norm, scale};
use quasirigid_mesh::{Cell, Mesh, Shape};

/// Tetrahedra between points with whole coordinates. None has two faces on a wall that is smooth where they meet, which
/// would be flat there.
pub struct Lattice {
    points: Vec<[i64; 3]>,
    cells: Vec<[usize; 4]>,
    count: i64,
}

impl Lattice {
    /// A box of so many cubes from its middle along each axis, each cut in six.
    pub fn block(counts: [i64; 3]) -> Self {
        Self::cut(counts, 0, &|at| at).mirrored([0, 1, 2].into_iter())
    }

    /// The octahedron `|x| + |y| + |z| ≤ n`.
    pub fn octahedron(n: i64) -> Self {
        Self::cut([n; 3], 2, &|[a, b, c]| [c - b, b - a, a]).mirrored([0, 1, 2].into_iter())
    }

    /// The prism `|x| + |y| ≤ n`, `0 ≤ z ≤ height`.
    pub fn prism(n: i64, height: i64) -> Self {
        Self::cut([n, n, height], 1, &|[a, b, c]| [b - a, a, c]).mirrored([0, 1].into_iter())
    }

    /// Six tetrahedra to a cube; of them those where the first `ordered` coordinates do not fall to the next.
    fn cut(counts: [i64; 3], ordered: usize, map: &dyn Fn([i64; 3]) -> [i64; 3]) -> Self {
        let mut lattice = Self { points: Vec::new(), cells: Vec::new(), count: counts[0] };
        let mut known = HashMap::new();
        let [m, n, o] = counts;
        for cube in 0..m * n * o {
            for path in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
                let mut at = [cube % m, cube / m % n, cube / (m * n)];
                let mut corners = vec![at];
                for axis in path {
                    at[axis] += 1;
                    corners.push(at);
                }
                if corners.iter().all(|at| (0..ordered).all(|axis| at[axis] <= at[axis + 1])) {
                    let corner = |k: usize| lattice.number(&mut known, map(corners[k]));
                    let cell = [0, 1, 2, 3].map(corner);
                    lattice.cells.push(cell);
                }
            }
        }
        lattice
    }

    fn mirrored(mut self, axes: impl Iterator<Item = usize>) -> Self {
        let mut known: HashMap<_, _> = self.points.iter().copied().zip(0..).collect();
        for axis in axes {
            for cell in self.cells.clone() {
                let corner = |k: usize| {
                    let mut at = self.points[cell[k]];
                    at[axis] = -at[axis];
                    self.number(&mut known, at)
                };
                let cell = [0, 1, 2, 3].map(corner);
                self.cells.push(cell);
            }
        }
        self
    }

    fn number(&mut self, known: &mut HashMap<[i64; 3], usize>, at: [i64; 3]) -> usize {
        *known.entry(at).or_insert_with(|| {
            self.points.push(at);
            self.points.len() - 1
        })
    }

    /// The mesh with its points moved, of cells of 4 nodes.
    pub fn straight(&self, place: &dyn Fn([f64; 3]) -> [f64; 3]) -> Mesh {
        let nodes: Vec<[f64; 3]> = self.points.iter().map(|at| place(at.map(|x| x as f64))).collect();
        let cell = |(label, cell): (u64, &[usize; 4])| {
            let [a, b, c, d] = cell.map(|node| nodes[node]);
            let sides = [b, c, d].map(|other| add(other, scale(-1.0, a)));
            let mut cell = *cell;
            if dot(sides[0], cross(sides[1], sides[2])) < 0.0 {
                cell.swap(2, 3);
            }
            Cell { label, shape: Shape::Tet4, nodes: cell.into() }
        };
        let cells = (1000..).zip(&self.cells).map(cell).collect();
        let node_labels = (1..=nodes.len() as u64).map(|k| 10 * k).collect();
        Mesh { nodes, node_labels, cells, sets: Vec::new() }
    }

    /// The mesh with cells of 10 nodes: edges are straight but for those on a `curved` part of the wall.
    pub fn quadratic(&self, curved: &dyn Fn([f64; 3]) -> bool, place: &dyn Fn([f64; 3]) -> [f64; 3]) -> Mesh {
        let mut mesh = self.straight(place);
        let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
        for cell in &mut mesh.cells {
            let corners = cell.nodes.clone();
            let edges = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]].map(|edge| edge.map(|k| corners[k]));
            let made = edges.map(|[a, b]| {
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    let between: [f64; 3] = std::array::from_fn(|axis| {
                        0.5 * (self.points[a][axis] + self.points[b][axis]) as f64
                    });
                    let chord = scale(0.5, add(mesh.nodes[a], mesh.nodes[b]));
                    mesh.nodes.push(if curved(between) { place(between) } else { chord });
                    mesh.node_labels.push(10 * mesh.nodes.len() as u64);
                    mesh.nodes.len() - 1
                })
            });
            cell.shape = Shape::Tet10;
            cell.nodes = corners.iter().copied().chain(made).collect();
        }
        mesh
    }

    /// Whether a place is on the slanted wall that the first `axes` coordinates make.
    fn slanted(&self, axes: usize) -> impl Fn([f64; 3]) -> bool {
        let count = self.count as f64;
        move |at| at[..axes].iter().map(|x| x.abs()).sum::<f64>() == count
    }
}

/// A place of the octahedron or, with two axes, the prism, moved so that the slanted wall is round, of radius 1.
fn rounded(axes: usize, count: i64) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |at| {
        let mut flat = at;
        flat[axes..].fill(0.0);
        let radius = norm(flat);
        let sum: f64 = flat.iter().map(|x| x.abs()).sum();
        let share = if radius > 0.0 { sum / radius } else { 0.0 };
        std::array::from_fn(|axis| at[axis] / count as f64 * if axis < axes { share } else { 1.0 })
    }
}

/// The unit ball, `n` cells along a radius, its places moved.
pub fn ball(n: i64, moved: &dyn Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let lattice = Lattice::octahedron(n);
    let round = rounded(3, n);
    lattice.quadratic(&lattice.slanted(3), &|at| moved(round(at)))
}

/// Unit ball of straight cells, inside the ball.
pub fn faceted_ball(n: i64) -> Mesh {
    Lattice::octahedron(n).straight(&rounded(3, n))
}

/// A cylinder of radius 1 and height 1, `n` cells along each.
pub fn cylinder(n: i64) -> Mesh {
    let lattice = Lattice::prism(n, n);
    lattice.quadratic(&lattice.slanted(2), &rounded(2, n))
}

/// Sides of the box.
pub const SIDES: [f64; 3] = [1.0, 0.8, 1.3];

/// A box about the origin with straight cells, `2 n` along each side.
pub fn block(n: i64) -> Mesh {
    Lattice::block([n; 3]).straight(&|at| std::array::from_fn(|axis| SIDES[axis] * at[axis] / (2 * n) as f64))
}
