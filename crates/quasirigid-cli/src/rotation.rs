//! The rotation that a model starts with, however the file describes it.

use std::path::Path;

use quasirigid::averaging::{FreeRotation, ObservedPeriods};
use quasirigid::dynamics::SpinState;
use quasirigid::math::sym::{add, scale};
use quasirigid::model::{FlexibleBody, Principal};
use quasirigid_io::model::{Model, Rotation};

use crate::failure::Failure;

/// The state the file starts from.
pub fn initial(model: &Model, body: &FlexibleBody, file: &Path) -> Result<SpinState, Failure> {
    let rotation = model.initial.rotation.ok_or_else(|| Failure::NoSpin { file: file.into() })?;
    let principal = Principal::of(body.invariants().J);
    let omega = match rotation {
        Rotation::Spin(omega) => omega,
        Rotation::Periods { rotation, precession, mode } => {
            let observed = ObservedPeriods { rotation, precession, mode };
            let motion = observed
                .motion(principal.moments)
                .map_err(|cause| Failure::Observed { file: file.into(), cause })?;
            in_body(&principal, &motion)
        }
        Rotation::Wobble { angle, rate, mode } => {
            let momentum = rate * principal.moments[mode.circled()];
            in_body(&principal, &FreeRotation::at_nutation(principal.moments, momentum, mode, angle))
        }
    };
    Ok(SpinState { omega, attitude: model.initial.attitude })
}

/// Spin at the start of a motion, from principal axes to body axes.
fn in_body(principal: &Principal, motion: &FreeRotation) -> [f64; 3] {
    let spin = motion.omega(0.0);
    principal.axes.iter().zip(spin).fold([0.0; 3], |sum, (axis, rate)| add(sum, scale(rate, *axis)))
}
