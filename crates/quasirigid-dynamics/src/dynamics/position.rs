//! Position of a body: centre of mass and pole, one from the other. (P7)

use super::layout::{PLACE, VELOCITY, attitude, triple};
use crate::math::rotation::{self, Turn};
use crate::math::vec3::{add, scale};
use crate::model::{FlexibleBody, MotionState};

/// Position of a body, inertial axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Position {
    /// Place (m) and velocity (m/s): of the centre of mass of a free body, of the pole of a constrained one.
    pub place: [f64; 3],
    pub velocity: [f64; 3],
    /// Place (m) of the pole.
    pub pole: [f64; 3],
}

impl Position {
    /// From a state with the place of the centre of mass of a free body, of the pole of a constrained one. (P7)
    pub fn of_center(body: &FlexibleBody, motion: MotionState<f64>, y: &[f64]) -> Self {
        let [pole, _] = pole(body, motion, y);
        Self { place: triple(y, PLACE), velocity: triple(y, VELOCITY), pole }
    }

    /// From a state with the place of the pole. (P7)
    pub fn of_pole(body: &FlexibleBody, motion: MotionState<f64>, y: &[f64]) -> Self {
        let (pole, pole_velocity) = (triple(y, PLACE), triple(y, VELOCITY));
        let [offset, rate] = pole_from_center(body, motion, y);
        Self { place: add(pole, scale(-1.0, offset)), velocity: add(pole_velocity, scale(-1.0, rate)), pole }
    }
}

/// Place (m) and velocity (m/s) of the pole, from a state as in [`Position::of_center`]. (P7)
pub(super) fn pole(body: &FlexibleBody, motion: MotionState<f64>, y: &[f64]) -> [[f64; 3]; 2] {
    let [offset, rate] = pole_from_center(body, motion, y);
    [add(triple(y, PLACE), offset), add(triple(y, VELOCITY), rate)]
}

fn pole_from_center(body: &FlexibleBody, motion: MotionState<f64>, y: &[f64]) -> [[f64; 3]; 2] {
    let turn = Turn::of(rotation::normalized(attitude(y)));
    let (offset, rate) = body.pole_from_center(motion);
    [turn.to_inertial(offset), turn.to_inertial(rate)]
}
