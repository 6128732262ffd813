//! Walls of cavities, as a viewer draws them.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use super::{Cavity, CavityShape};
use crate::math::rotation::to_inertial;
use crate::visual::{Outline, boundary, cuboid, ellipsoid, revolved, thinned};

/// Steps around the tube of a ring.
const AROUND_TUBE: usize = 12;

impl Cavity {
    /// Outer wall of the liquid.
    pub(super) fn wall(&self) -> Outline {
        let center = Vector3::from(self.center);
        let column = |axis: usize| Vector3::from(to_inertial(self.attitude, Vector3::ith(axis, 1.0).into()));
        let axes = Matrix3::from_columns(&[column(0), column(1), column(2)]);
        let upright = |inner: f64, outer: f64, height: f64| {
            let z = 0.5 * height;
            let meridian = [[inner, -z], [outer, -z], [outer, z], [inner, z]];
            revolved(center, axes, &meridian, inner > 0.0)
        };
        Outline::still(match &self.shape {
            CavityShape::Ellipsoid { semi_axes } | CavityShape::Shell { outer: semi_axes, .. } => {
                ellipsoid(center, axes, (*semi_axes).into())
            }
            CavityShape::Cylinder { radius, height } => upright(0.0, *radius, *height),
            CavityShape::Annulus { radii, height } => upright(radii[0], radii[1], *height),
            CavityShape::Ring { radius, tube_radius } => {
                let around = |step: usize| (TAU * step as f64 / AROUND_TUBE as f64).sin_cos();
                let place = |(sin, cos): (f64, f64)| [radius + tube_radius * cos, tube_radius * sin];
                let meridian: Vec<[f64; 2]> = (0..AROUND_TUBE).map(around).map(place).collect();
                revolved(center, axes, &meridian, true)
            }
            CavityShape::Cuboid { sides } => cuboid(center, axes, 0.5 * Vector3::from(*sides)),
            CavityShape::Mesh(mesh) => {
                let (kept, triangles) = thinned(&mesh.nodes, &boundary(mesh, 0..mesh.cells.len()));
                let place = |node: usize| (center + axes * Vector3::from(mesh.nodes[node])).into();
                (kept.into_iter().map(place).collect(), triangles)
            }
        })
    }
}
