use nalgebra::{Matrix3, Matrix3xX, Vector3};

use super::slopes::jacobian;
use crate::finite::{LumpedMass, MassLocation};
use quasirigid_mesh::{Rule, Shape};

/// Lumped masses of a solid cell: points of the rule that is exact for products of two displacements where edges are straight and faces
/// flat.
pub(crate) fn lumped_masses(shape: Shape, nodes: &[Vector3<f64>], density: f64) -> Vec<LumpedMass> {
    let samples = shape.samples(Rule::Products).iter();
    samples
        .map(|sample| {
            let mut shapes = Matrix3xX::zeros(3 * nodes.len());
            let mut place = Vector3::zeros();
            for (number, (node, share)) in nodes.iter().zip(&sample.functions).enumerate() {
                shapes.columns_mut(3 * number, 3).copy_from(&(*share * Matrix3::identity()));
                place += *share * node;
            }
            let mass = density * sample.weight * jacobian(nodes, sample).determinant();
            LumpedMass { mass, location: MassLocation::At(place), shapes, turn: None }
        })
        .collect()
}
