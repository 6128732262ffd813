//! Quadratic tetrahedron of the Stokes problem: its points and its matrices.
//! Curved cells keep their own Jacobian at every point; only the pressure's Laplacian takes them as straight, since it preconditions.
//! Elements of `[@taylor1973]`.

use crate::math::vec3::{add, cross, dot, scale};
use quasirigid_mesh::{CellSample, Rule, Shape};

/// Nodes of a quadratic tetrahedron.
pub(super) const NODES: usize = 10;
/// Corners, to which the pressure belongs.
pub(super) const CORNERS: usize = 4;

/// A place within a cell.
pub(super) struct Point {
    /// Share of the volume (m³); zero of a point that is none of a quadrature.
    pub volume: f64,
    /// Place (m).
    pub place: [f64; 3],
    /// Shape functions.
    pub functions: [f64; NODES],
    /// Their slopes (1/m).
    pub slopes: [[f64; 3]; NODES],
    /// Shares of the corners.
    pub shares: [f64; CORNERS],
}

impl Point {
    fn new(nodes: &[[f64; 3]; NODES], sample: &CellSample) -> Self {
        let mut tangents = [[0.0; 3]; 3];
        let mut place = [0.0; 3];
        for (a, node) in nodes.iter().enumerate() {
            place = add(place, scale(sample.functions[a], *node));
            for axis in 0..3 {
                tangents[axis] = add(tangents[axis], scale(sample.gradients[a][axis], *node));
            }
        }
        let [a, b, c] = tangents;
        let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, cofactors[0]);
        let slope = |node: usize| {
            let sum =
                (0..3).map(|axis| scale(sample.gradients[node][axis], cofactors[axis])).fold([0.0; 3], add);
            scale(1.0 / determinant, sum)
        };
        let [x, y, z] = sample.at;
        Self {
            volume: sample.weight * determinant,
            place,
            functions: std::array::from_fn(|node| sample.functions[node]),
            slopes: std::array::from_fn(slope),
            shares: [1.0 - x - y - z, x, y, z],
        }
    }

    /// Gradient `∂u_i/∂x_k`, rows `i`, of a field that has these values at the nodes.
    pub fn gradient(&self, field: &[[f64; 3]; NODES]) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|i| (0..NODES).map(|node| scale(field[node][i], self.slopes[node])).fold([0.0; 3], add))
    }
}

/// Points of a cell at which products of two shape functions are integrated.
pub(super) fn points(nodes: &[[f64; 3]; NODES]) -> impl Iterator<Item = Point> {
    points_at(nodes, Shape::Tet10.samples(Rule::Products))
}

/// The points of a cell at some samples.
pub(super) fn points_at(nodes: &[[f64; 3]; NODES], samples: &[CellSample]) -> impl Iterator<Item = Point> {
    samples.iter().map(|sample| Point::new(nodes, sample))
}

/// Matrices of a cell, for one component of the velocity.
#[derive(Default)]
pub(super) struct Matrices {
    /// `∫ ∇N_a·∇N_b dV` (m).
    pub stiffness: [[f64; NODES]; NODES],
    /// `∫ N_a N_b dV` (m³).
    pub mass: [[f64; NODES]; NODES],
    /// `∫ λ_p ∂N_a/∂x_k dV` (m²), rows `a`: a unit velocity of a node along an axis, against the share of a corner.
    pub divergence: [[[f64; 3]; CORNERS]; NODES],
    /// `∫ λ_p λ_q dV` (m³).
    pub pressure: [[f64; CORNERS]; CORNERS],
    /// `∫ ∇λ_p·∇λ_q dV` (m), of the tetrahedron with straight edges.
    pub pressure_stiffness: [[f64; CORNERS]; CORNERS],
}

impl Matrices {
    pub fn new(nodes: &[[f64; 3]; NODES]) -> Self {
        let mut sum = Self::default();
        for point in points(nodes) {
            for a in 0..NODES {
                for b in 0..NODES {
                    sum.stiffness[a][b] += point.volume * dot(point.slopes[a], point.slopes[b]);
                    sum.mass[a][b] += point.volume * point.functions[a] * point.functions[b];
                }
                for p in 0..CORNERS {
                    let part = scale(point.volume * point.shares[p], point.slopes[a]);
                    sum.divergence[a][p] = add(sum.divergence[a][p], part);
                }
            }
            for p in 0..CORNERS {
                for q in 0..CORNERS {
                    sum.pressure[p][q] += point.volume * point.shares[p] * point.shares[q];
                }
            }
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(|corner| nodes[corner]);
        let edges = [b, c, d].map(|corner| add(corner, scale(-1.0, a)));
        let faces = [0, 1, 2].map(|k| cross(edges[(k + 1) % 3], edges[(k + 2) % 3]));
        let volume = dot(edges[0], faces[0]) / 6.0;
        let across = [scale(-1.0, faces.into_iter().fold([0.0; 3], add)), faces[0], faces[1], faces[2]];
        sum.pressure_stiffness = across.map(|p| across.map(|q| dot(p, q) / (36.0 * volume)));
        sum
    }
}
