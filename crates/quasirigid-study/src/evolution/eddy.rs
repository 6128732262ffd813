//! Limits of the average of eddy currents, and what they do to the direction of the angular momentum, in words. (A14), (A15)

use quasirigid::averaging::{EddyTorque, SlowTorque};
use quasirigid::model::Mode;
use quasirigid::model::force::{Oblateness, Orbit};
use quasirigid_math::rotation::angle;

use super::inputs::Inputs;
use super::table::EvolutionTable;
use crate::error::StudyError;
use crate::words::significant;

/// Ratio of rates from which the slower one changes nothing over a revolution of the faster one; the error is about its inverse.
const APART: f64 = 10.0;
/// Angle (rad) of the node from which its precession is told.
const MOVED: f64 = 0.2;
const DAY: f64 = 86_400.0;
/// Angle (rad) below which a direction is the same.
const SAME_DIRECTION: f64 = 1e-6;

/// Refuses eddy currents that act within a revolution of the body or of its orbit, and torques on a body without axes of its own.
pub fn check(torque: &SlowTorque, inputs: &Inputs) -> Result<(), StudyError> {
    let moments = inputs.principal.moments;
    let sphere = !Mode::any_exists(moments);
    if sphere && torque.is_zero() {
        return Err(StudyError::EqualMoments { moment: moments[2] });
    }
    if sphere && (torque.constant != [0.0; 3] || torque.eddy.is_some_and(|eddy| !eddy.is_isotropic())) {
        return Err(StudyError::NoAxes { moment: moments[2] });
    }
    let Some(eddy) = torque.eddy else { return Ok(()) };
    let rate = eddy.greatest_rate(moments[0]);
    let spin = 2.0 * inputs.initial.energy() / inputs.initial.angular_momentum();
    let passing = eddy.field.slowest_rate();
    if APART * rate > passing {
        return Err(StudyError::FastEddyCurrents { rate, against: passing, of_field: true });
    }
    if !locks(&eddy, moments) && APART * rate > spin {
        return Err(StudyError::FastEddyCurrents { rate, against: spin, of_field: false });
    }
    Ok(())
}

/// Whether no average over the rotation is taken: of a ball with one conductivity, whose torque is linear in its spin.
fn locks(eddy: &EddyTorque, moments: [f64; 3]) -> bool {
    !Mode::any_exists(moments) && eddy.is_isotropic()
}

/// Rate (rad/s) of the body below which the average over its rotation does not hold; zero where no such average is taken.
pub fn slowest(torque: &SlowTorque, moments: [f64; 3]) -> f64 {
    torque.eddy.filter(|eddy| !locks(eddy, moments)).map_or(0.0, |eddy| APART * eddy.field.fastest_rate())
}

/// An orbit about the Earth whose node does not move in the model, although it would, in a sentence.
pub fn unprecessed(torque: &SlowTorque, rows: &EvolutionTable) -> Option<String> {
    let field = torque.eddy?.field;
    let orbit = field.orbit().filter(|orbit| orbit.mu == Orbit::EARTH_PARAMETER && !orbit.precesses())?;
    let rate = orbit.about(Oblateness::EARTH).node_rate;
    let angle = rate * rows.last().t;
    (angle.abs() > MOVED).then(|| {
        format!(
            "The oblateness of the Earth would move the node of the orbit by {} degrees a day, {} degrees in this time, and with it the mean field: precession = \"J2\" in `orbit` has it.",
            significant((rate * DAY).to_degrees(), 3),
            significant(angle.to_degrees(), 3)
        )
    })
}

/// How far the angular momentum turned, in a sentence.
pub fn turned(rows: &EvolutionTable) -> Option<String> {
    let (start, end) = (rows.first.direction, rows.drift.as_ref()?.end.direction);
    let turned = angle(start, end);
    let [x, y, z] = end.map(|part| significant(if part.abs() < SAME_DIRECTION { 0.0 } else { part }, 4));
    (turned > SAME_DIRECTION).then(|| {
        format!(
            "The eddy currents turn the angular momentum by {} degrees, to [{x}, {y}, {z}] in inertial axes.",
            significant(turned.to_degrees(), 3)
        )
    })
}
