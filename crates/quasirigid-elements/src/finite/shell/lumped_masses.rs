use nalgebra::{Matrix3, Matrix3xX, Vector3};

use super::mass::{Point, points};
use super::section::ShellSection;
use crate::finite::{LumpedMass, MassLocation, Turn};
use quasirigid_mesh::Shape;

/// Lumped masses of a shell: two over each point of its surface, at heights that have the first and second moments of the section, which
/// move by `u + θ × z n`.
pub(crate) fn lumped_masses(shape: Shape, nodes: &[Vector3<f64>], section: &ShellSection) -> Vec<LumpedMass> {
    let middle = section.first / section.mass;
    let deviation = (section.second / section.mass - middle * middle).max(0.0).sqrt();
    let pair = |point: Point| {
        [middle - deviation, middle + deviation]
            .map(|height| lumped_mass(&point, nodes, section.mass, height))
    };
    points(shape, nodes).into_iter().flat_map(pair).collect()
}

fn lumped_mass(point: &Point, nodes: &[Vector3<f64>], density: f64, height: f64) -> LumpedMass {
    let arm = height * point.normal;
    let foot: Vector3<f64> = nodes.iter().zip(&point.shares).map(|(node, share)| *share * node).sum();
    let mut shapes = Matrix3xX::zeros(6 * nodes.len());
    let mut rotations = Matrix3xX::zeros(6 * nodes.len());
    for (node, share) in point.shares.iter().enumerate() {
        let whole = *share * Matrix3::identity();
        shapes.columns_mut(6 * node, 3).copy_from(&whole);
        shapes.columns_mut(6 * node + 3, 3).copy_from(&(-*share * arm.cross_matrix()));
        rotations.columns_mut(6 * node + 3, 3).copy_from(&whole);
    }
    let turn = Some(Turn { arm, shapes: rotations });
    LumpedMass { mass: 0.5 * density * point.area, location: MassLocation::At(foot + arm), shapes, turn }
}
