//! Start of a body whose parts swing hardly faster than it spins, without the vibrations that die out: projected on the slow manifold about the
//! spin, since such parts are not in balance with a wobble.
//! Equation (Q21), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use super::energy_range::{EnergyRange, RESOLVED};
use super::poles::Pole;
use crate::averaging::RotationState;
use crate::dynamics::FullState;
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, Mode};
use crate::modes::SpinModes;
use crate::submanifold::{Masters, SpinManifold, SpinManifoldPlan, Style};

/// Spins that the slowest vibration takes to be in balance with a wobble: the balance is off by the square of their ratio.
const SLOW: f64 = 10.0;
/// Coordinates up to which the manifold is derived at once.
const MOST_COORDINATES: usize = 30;
/// Degree of the equations, and the defect up to which they place a start.
const DEGREE: usize = 5;
const ACCEPTED_DEFECT: f64 = 0.05;
/// Distance from the balance, in `ξ`, beyond which the equations led astray: a wobble 2.7 times as wide.
const FARTHEST: f64 = 2.0;

/// Slow manifold about a spin on which starts are projected. (W10), (Q21)
#[derive(Clone, Debug)]
pub struct SettledStarts<'a> {
    manifold: SpinManifold<'a>,
    range: &'a EnergyRange,
}

impl<'a> SettledStarts<'a> {
    /// The manifold about the spin that a mode circles, on the side of an angular momentum (N·m·s); none where every vibration is faster than ten
    /// spins, where (Q2) serves, with rotors and liquids, which slide and do not swing, and where there are no such equations.
    #[must_use]
    pub fn derive(
        body: &'a FlexibleBody,
        range: &'a EnergyRange,
        mode: Mode,
        angular_momentum: [f64; 3],
    ) -> Option<Self> {
        let equilibrium = range.equilibrium(mode).filter(|_| swings(body))?;
        let pole = Pole { modes: SpinModes::about(body, equilibrium.clone()).ok()? };
        Self::about(body, (range, &pole), mode, angular_momentum)
    }

    /// As [`derive`](Self::derive), with the modes about the spin.
    pub(super) fn about(
        body: &'a FlexibleBody,
        (range, pole): (&'a EnergyRange, &Pole),
        mode: Mode,
        angular_momentum: [f64; 3],
    ) -> Option<Self> {
        if !swings(body) {
            return None;
        }
        let spin = norm(pole.modes.equilibrium.omega);
        let slow = |[_, frequency]: &[f64; 2]| (0.0..SLOW * spin).contains(frequency);
        if !pole.modes.internal.iter().any(slow) {
            return None;
        }
        let (masters, style) = (Masters::Automatic, Style::NormalForm);
        let plan = SpinManifoldPlan { mode, angular_momentum, masters, degree: DEGREE, style };
        let manifold = SpinManifold::derive(body, &plan, &mut |_| ControlFlow::Continue(())).ok()?;
        Some(Self { manifold, range })
    }

    /// Rotation state of the nutation of a start; none where the equations do not hold there, or lead far from the balance (Q2).
    #[must_use]
    pub fn rotation_state(&self, start: &FullState) -> Option<RotationState> {
        let body = self.manifold.body;
        let balanced = self.range.settled(body, start.angular_momentum(body))?;
        let mut z = self.manifold.start(start).z;
        let amplitude = z[0][0].hypot(z[0][1]);
        let wider = (RESOLVED / amplitude).max(1.0);
        z[0] = z[0].map(|part| wider * part);
        z[1..].fill([0.0; 2]);
        let holds = self.manifold.defect(wider * amplitude).largest() <= ACCEPTED_DEFECT;
        let energy = self.manifold.full_state(&z, start.attitude).energy(body);
        let RotationState { mode, xi } = self.range.rotation_state(energy).filter(|_| holds)?;
        let found = RotationState { mode, xi: xi + 2.0 * wider.ln() };
        let near = mode == balanced.mode && (found.xi - balanced.xi).abs() <= FARTHEST;
        near.then_some(found)
    }
}

/// Whether what moves inside a body are few coordinates that may swing.
fn swings(body: &FlexibleBody) -> bool {
    body.cyclic().is_empty() && body.coordinates().len() <= MOST_COORDINATES
}
