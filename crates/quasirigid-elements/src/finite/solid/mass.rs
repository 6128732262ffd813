use nalgebra::{DMatrix, Vector3};

use super::slopes::{jacobian, weighted};
use quasirigid_mesh::{Rule, Shape};

/// Consistent mass (kg) of a solid cell for one component of the displacement, node by node: `∫ ρ N_a N_b dV`.
///
/// The mass over all displacements is this times the 3×3 identity. It is exact for cells with straight edges and flat
/// faces, and so are the moments of inertia that follow from it.
pub(crate) fn mass(shape: Shape, nodes: &[Vector3<f64>], density: f64) -> DMatrix<f64> {
    by_rule(shape, nodes, density, Rule::Products)
}

/// Mass by the points of a rule.
pub(super) fn by_rule(shape: Shape, nodes: &[Vector3<f64>], density: f64, rule: Rule) -> DMatrix<f64> {
    let samples = shape.samples(rule);
    let functions =
        DMatrix::from_fn(nodes.len(), samples.len(), |node, point| samples[point].functions[node]);
    let mass = |sample| density * sample_volume(nodes, sample);
    let masses: Vec<f64> = samples.iter().map(mass).collect();
    weighted(&functions, &masses) * functions.transpose()
}

fn sample_volume(nodes: &[Vector3<f64>], sample: &quasirigid_mesh::CellSample) -> f64 {
    sample.weight * jacobian(nodes, sample).determinant()
}
