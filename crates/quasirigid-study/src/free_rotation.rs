//! Free rotation that a history leaves a body in: its mode, periods and wobble if nothing acted any more. (A3), (A4), (P8)

use std::f64::consts::TAU;

use quasirigid::averaging::{FreeRotation, ObservedPeriods};
use quasirigid::dynamics::Sample;
use quasirigid::model::{FlexibleBody, Mode, Principal, Support};
use quasirigid_math::rotation::to_inertial;
use quasirigid_math::vec3::{dot, unit};
use serde::Serialize;

/// Free rotation of the rigid body with an angular momentum. First paragraphs of the fields are the reference of `--json` in the guide.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FreeRotationObject {
    /// `short-axis` or `long-axis`.
    mode: &'static str,
    /// About the long axis, P_psi (s); `null` where it does not end.
    rotation_period: f64,
    /// Mean one of the long axis about the angular momentum, P_phi (s).
    precession_period: f64,
    /// Greatest angle (rad) between the angular momentum and the axis that it circles.
    wobble: f64,
    /// Of a rotation at the mean rate along the angular momentum, 2π|K|/2E (s).
    effective_period: f64,
    /// Energy over the least with this angular momentum.
    energy_ratio: f64,
    /// Of the angular momentum, inertial axes.
    direction: [f64; 3],
}

impl FreeRotationObject {
    /// Periods (s): mean one of the long axis about the angular momentum, and that about the long axis.
    pub fn periods(&self) -> [f64; 2] {
        [self.precession_period, self.rotation_period]
    }

    /// Free rotation from a sample; none of a constrained body, of one with rotors, liquids, wheels or driven parts, of a sphere, and at rest.
    pub fn of(body: &FlexibleBody, sample: &Sample) -> Option<Self> {
        let Principal { moments, axes } = Principal::compute(body.invariants().J);
        let free = *body.support() == Support::Free
            && body.cyclic().is_empty()
            && body.wheels().is_empty()
            && body.drives().is_empty();
        if !free || sample.angular_momentum == [0.0; 3] || !Mode::any_exists(moments) {
            return None;
        }
        let along = [0, 1, 2].map(|axis| dot(axes[axis], sample.angular_momentum) / moments[axis]);
        let motion = FreeRotation::through(moments, along).ok()?;
        let ObservedPeriods { rotation, precession, mode } = ObservedPeriods::from_motion(&motion);
        Some(Self {
            mode: match mode {
                Mode::ShortAxis => "short-axis",
                Mode::LongAxis => "long-axis",
            },
            rotation_period: rotation,
            precession_period: precession,
            wobble: motion.nutation()[1],
            effective_period: TAU * motion.angular_momentum() / (2.0 * motion.energy()),
            energy_ratio: motion.ratio().recip(),
            direction: unit(to_inertial(sample.attitude, sample.angular_momentum)),
        })
    }
}
