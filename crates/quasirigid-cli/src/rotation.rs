//! The rotation that a model starts with, however the file describes it.

use std::fmt::{self, Display, Formatter};
use std::path::Path;

use quasirigid::averaging::{FreeRotation, ObservedPeriods};
use quasirigid::dynamics::SpinState;
use quasirigid::math::sym::norm;
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::reduction::{Comparison, Criterion, Relaxation, Verdict, reduce};
use quasirigid_io::model::{Model, Rotation};

use crate::describe::significant;
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
            if !mode.exists(principal.moments) {
                let cause = NoWobble { moments: principal.moments, mode };
                return Err(Failure::NoWobble { file: file.into(), cause });
            }
            let momentum = rate * principal.moments[mode.circled()];
            FreeRotation::at_nutation(principal.moments, momentum, mode, angle)
        }
    };
    let spin = motion.omega(0.0);
    let K = principal.vector([0, 1, 2].map(|i| principal.moments[i] * spin[i]));
    let order = slaved_order(body, order, spin)?;
    let omega = reduce(body, order)?.Omega.vector(K);
    Ok(SpinState { omega, attitude: model.initial.attitude })
}

/// A wobble about an axis that the body does not have.
#[derive(Debug)]
pub struct NoWobble {
    /// Principal moments (kg·m²), ascending.
    moments: [f64; 3],
    mode: Mode,
}

impl Display for NoWobble {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [I1, I2, I3] = self.moments;
        let (which, those, a, b) = match self.mode {
            Mode::ShortAxis => ("greatest", "greatest", I2, I3),
            Mode::LongAxis => ("least", "smallest", I1, I2),
        };
        let [a, b] = [a, b].map(|moment| significant(moment, 6));
        write!(
            f,
            "this body has no axis of {which} inertia to wobble about: its two {those} moments are equal ({a} and {b} kg m^2)"
        )?;
        match self.mode.other() {
            other if !other.exists(self.moments) => {
                f.write_str(", and so is the third: a body like a sphere does not wobble")
            }
            Mode::LongAxis => {
                f.write_str("; count the angle from the axis of least inertia, mode = \"long-axis\"")
            }
            Mode::ShortAxis => {
                f.write_str("; count the angle from the axis of greatest inertia, mode = \"short-axis\"")
            }
        }
    }
}

/// The order to which the state of the body follows its spin (rad/s): that of the model, or 0 where something turns inside so
/// freely that the spin does not slave it. It then turns with the body at the start.
pub fn slaved_order(body: &FlexibleBody, order: usize, spin: [f64; 3]) -> Result<usize, Failure> {
    let value = Relaxation::of(body)?.longest() * norm(spin);
    let criterion = Criterion { comparison: Comparison::Relaxation, value };
    Ok(if criterion.verdict() == Verdict::Fails { 0 } else { order })
}
