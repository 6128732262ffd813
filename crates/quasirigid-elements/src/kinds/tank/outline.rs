use nalgebra::{Matrix3, Vector3};

use super::Tank;
use crate::error::ElementId;
use crate::number;
use crate::visual::{Outline, revolved};

/// Steps along each piece of the wall.
const STEPS: usize = 8;

impl Tank {
    /// The wall, as a viewer draws it.
    pub(super) fn drawn(&self, id: ElementId) -> Option<Outline> {
        let wall = self.checked_wall(id).ok()?;
        let axis = number::unit(self.axis).ok()?;
        let mut least = Vector3::zeros();
        least[axis.iamin()] = 1.0;
        let first = (least - axis * axis.dot(&least)).normalize();
        let axes = Matrix3::from_columns(&[first, axis.cross(&first), axis]);
        let steps = |step: usize| step as f64 / STEPS as f64;
        let inner = wall.pieces.iter().flat_map(|piece| (0..STEPS).map(move |step| piece.at(steps(step))[0]));
        let [start, end] = wall.ends();
        let meridian: Vec<[f64; 2]> =
            [[0.0, start[1]]].into_iter().chain(inner).chain([end, [0.0, end[1]]]).collect();
        Some(Outline::still(revolved(self.center.into(), axes, &meridian, false)))
    }
}
