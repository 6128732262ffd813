//! Magnetic field about a steady state: where it stays in the body, small motions turn it and coils act by it as constants.
//! Equations (Y6), (Y8), docs/theory/20-control.md.

use quasirigid::model::control::{BodyController, Controls};
use quasirigid::model::force::MagneticField;
use quasirigid::modes::SteadyState;
use quasirigid_math::vec3::{cross, norm};

use crate::error::StudyError;

/// Sine of the angle between field and spin that is rounding of an attitude.
const ALONG: f64 = 1e-8;

/// Field (T, body axes) that a controller senses or acts by about a steady state; zero for a controller without one.
///
/// # Errors
/// [`StudyError::NotLinear`] where the field changes in the body.
pub fn steady_field(
    controls: &Controls,
    controller: &BodyController,
    steady: &SteadyState,
) -> Result<[f64; 3], StudyError> {
    let refused = |what| Err(StudyError::NotLinear { name: controller.name.clone(), what });
    if !controller.is_magnetic() {
        return Ok([0.0; 3]);
    }
    if !matches!(controls.field, Some(MagneticField::Uniform(_)) | None) {
        return refused(
            "its magnetic field changes along the orbit, so that the loop varies in time; give [magnetic_field] a uniform `field`, that of one place, or follow it by `simulate`",
        );
    }
    let field = controls.sensed(0.0, steady.attitude, [0.0; 3]).field;
    if norm(cross(steady.omega, field)) > ALONG * norm(steady.omega) * norm(field) {
        return refused(
            "about this spin its magnetic field turns in the body, so that the loop varies in time; give [initial] an attitude in which the field lies along the spin, ask for it about rest, or follow it by `simulate`",
        );
    }
    Ok(field)
}

/// Change of a component of a field `B` in the body per small rotation `θ` about each body axis, `δB = B × θ`. (Y6)
pub fn by_rotation(field: [f64; 3], component: usize) -> [f64; 3] {
    unit_vectors().map(|axis| cross(field, axis)[component])
}

/// Torque per moment along a body axis, `e × B`. (Y8)
pub fn by_moment(field: [f64; 3], axis: usize) -> [f64; 3] {
    cross(unit_vectors()[axis], field)
}

fn unit_vectors() -> [[f64; 3]; 3] {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}
