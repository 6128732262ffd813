//! The rotation that a model starts with, however the file describes it.

use std::path::Path;

use quasirigid::averaging::{FreeRotation, ObservedPeriods};
use quasirigid::dynamics::SpinState;
use quasirigid::model::{FlexibleBody, Principal};
use quasirigid::reduction::reduce;
use quasirigid_io::model::{Model, Rotation};

use crate::failure::Failure;

/// The state the file starts from.
pub fn initial(model: &Model, body: &FlexibleBody, order: usize, file: &Path) -> Result<SpinState, Failure> {
    let rotation = model.initial.rotation.ok_or_else(|| Failure::NoSpin { file: file.into() })?;
    let principal = Principal::of(body.invariants().J);
    let motion = match rotation {
        Rotation::Spin(omega) => return Ok(SpinState { omega, attitude: model.initial.attitude }),
        Rotation::Periods { rotation, precession, mode } => {
            let observed = ObservedPeriods { rotation, precession, mode };
            let motion = observed.motion(principal.moments);
            motion.map_err(|cause| Failure::Observed { file: file.into(), cause })?
        }
        Rotation::Wobble { angle, rate, mode } => {
            let momentum = rate * principal.moments[mode.circled()];
            FreeRotation::at_nutation(principal.moments, momentum, mode, angle)
        }
    };
    let spin = motion.omega(0.0);
    let K = principal.vector([0, 1, 2].map(|i| principal.moments[i] * spin[i]));
    let omega = reduce(body, order)?.Omega.vector(K);
    Ok(SpinState { omega, attitude: model.initial.attitude })
}
