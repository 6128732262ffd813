//! Holes of a surface: its open edges, joined where they share vertices.

use std::fmt;

use super::topology::sides;
use quasirigid_math::connected_components::connected_components;
use quasirigid_math::vec3::{add, minus, norm, scale};

/// Hole in a surface: open edges that hang together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Number of edges of its rim.
    pub edges: usize,
    /// Length of the rim (m).
    pub length: f64,
    /// Mean of the ends of its edges (m).
    pub place: [f64; 3],
}

impl fmt::Display for Hole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.place;
        let edges = if self.edges == 1 { "edge" } else { "edges" };
        let Self { edges: count, length, .. } = self;
        write!(f, "{count} {edges}, {length:.4e} m around, near ({x:.4e}, {y:.4e}, {z:.4e}) m")
    }
}

/// The holes of triangles whose corners exist, the one with the longest rim first.
pub(super) fn holes(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> Vec<Hole> {
    let sides = sides(triangles);
    let groups = sides.chunk_by(|a, b| a.edge == b.edge);
    let open: Vec<[usize; 2]> = groups.filter(|group| group.len() == 1).map(|group| group[0].edge).collect();
    let mut ends: Vec<usize> = open.iter().flatten().copied().collect();
    ends.sort_unstable();
    ends.dedup();
    let number = |end: usize| ends.partition_point(|other| *other < end);
    let pairs: Vec<[usize; 2]> = open.iter().map(|edge| edge.map(number)).collect();
    let mut rims = vec![0; ends.len()];
    let parts = connected_components(ends.len(), pairs.iter().copied());
    for (rim, part) in parts.iter().enumerate() {
        part.iter().for_each(|end| rims[*end] = rim);
    }
    let mut holes = vec![Hole { edges: 0, length: 0.0, place: [0.0; 3] }; parts.len()];
    for ([a, b], pair) in open.iter().zip(&pairs) {
        let hole = &mut holes[rims[pair[0]]];
        let [a, b] = [vertices[*a], vertices[*b]];
        hole.edges += 1;
        hole.length += norm(minus(a, b));
        hole.place = add(hole.place, scale(0.5, add(a, b)));
    }
    holes.iter_mut().for_each(|hole| hole.place = scale((hole.edges as f64).recip(), hole.place));
    holes.sort_by(|a, b| b.length.total_cmp(&a.length));
    holes
}
