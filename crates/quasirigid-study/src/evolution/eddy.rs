//! Limits of the average of eddy currents, and what they do to the direction of the angular momentum, in words. (A14), (A15)

use quasirigid::averaging::SlowTorque;
use quasirigid::model::Mode;
use quasirigid_math::rotation::angle;

use super::inputs::Inputs;
use super::table::EvolutionTable;
use crate::error::StudyError;
use crate::words::significant;

/// Ratio of rates from which the slower one changes nothing over a revolution of the faster one; the error is about its inverse.
const APART: f64 = 10.0;
/// Share of the torque above which what is left out is told.
const LEFT_OUT: f64 = 0.02;
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
    if APART * rate > spin {
        return Err(StudyError::FastEddyCurrents { rate, against: spin, of_field: false });
    }
    Ok(())
}

/// Rate (rad/s) of the body below which the average over its rotation does not hold.
pub fn slowest(torque: &SlowTorque) -> f64 {
    torque.eddy.map_or(0.0, |eddy| APART * eddy.field.fastest_rate())
}

/// Share of the spin at which the field itself turns, whose currents are left out, in a sentence: over the poles of a dipole it turns twice in
/// an orbit. (F15)
pub fn left_out(torque: &SlowTorque, spins: [f64; 2]) -> Option<String> {
    let share = 2.0 * torque.eddy?.field.fastest_rate() / spins[0].min(spins[1]);
    (share > LEFT_OUT).then(|| {
        format!(
            "The magnetic field turns along the orbit at up to {} % of the spin, and the currents of this turning are left out: the torque is uncertain by about as much.",
            significant(100.0 * share, 2)
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
