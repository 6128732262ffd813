use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

use super::Tube;
use crate::error::ElementId;
use crate::visual::{Outline, revolved};

/// Steps around the tube.
const STEPS: usize = 12;

impl Tube {
    /// The ring, as a viewer draws it.
    pub(super) fn drawn(&self, id: ElementId) -> Option<Outline> {
        let [center, axis, first] = self.slug(id).ok()?.frame.map(Vector3::from);
        let axes = Matrix3::from_columns(&[first, axis.cross(&first), axis]);
        let round = |step: usize| {
            let (sin, cos) = (TAU * step as f64 / STEPS as f64).sin_cos();
            [self.radius + self.tube_radius * cos, self.tube_radius * sin]
        };
        let meridian: Vec<[f64; 2]> = (0..STEPS).map(round).collect();
        Some(Outline::still(revolved(center, axes, &meridian, true)))
    }
}
