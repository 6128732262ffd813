//! Criteria of averages of ellipsoids: how stiff, how slow and how rigid they have to be.
//! Equations (Q7) and (Q12), docs/theory/16-methods.md.

use super::power::WobbleState;
use super::{EllipsoidLoss, EllipsoidRefusal, WobblingEllipsoid};

/// Largest relative error that is accepted, and its bound over the largest criterion. (Q7)
const ACCEPTED_ERROR: f64 = 0.04;
const ERROR_PER_CRITERION: f64 = 4.0;
/// Lowest frequency of an ellipsoid over `v_s c/a²`, with the speed `v_s` of shear waves and its greatest and least semi-axes `a`, `c`: a
/// lower bound of both the spheroidal and toroidal vibrations of a ball (2.5) and the bending of a needle. (Q12)
const LOWEST: f64 = 2.0;

/// Criteria of the average of an ellipsoid.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EllipsoidCriteria {
    /// Square of the greatest spin over the lowest frequency: the share of inertia in the response.
    inertia: f64,
    /// Rate of change of the wobble over the frequency of the polhode, or times the relaxation time.
    settling: f64,
    /// Relative change of a difference between principal moments by the deformation.
    moments: f64,
}

impl EllipsoidCriteria {
    /// What is known before the quadrature: moments of inertia ascending, with the largest compliance (J·s⁴) on the squares.
    pub fn before(
        body: &WobblingEllipsoid,
        moments: [f64; 3],
        compliance: f64,
        short: bool,
        long: bool,
    ) -> Self {
        let [least, greatest] =
            [f64::min, f64::max].map(|pick| body.semi_axes.into_iter().reduce(pick).unwrap_or(0.0));
        let lowest = LOWEST * (body.shear / body.density).sqrt() * least / (greatest * greatest);
        let fastest = body.spin * moments[2] / moments[0];
        let change = 2.0 * compliance * fastest * fastest;
        let gap = |asked: bool, gap: f64| if asked { change / gap } else { 0.0 };
        Self {
            inertia: (fastest / lowest).powi(2),
            settling: 0.0,
            moments: gap(short, moments[2] - moments[1]).max(gap(long, moments[1] - moments[0])),
        }
    }

    /// Takes a state of the passage into account, in its lane.
    pub fn add(&mut self, at: &WobbleState, lane: usize, loss: EllipsoidLoss) {
        let rate = at.power.0[lane] / (2.0 * at.from_axis.0[lane]);
        let memory = match loss {
            EllipsoidLoss::QualityFactor(_) => 0.0,
            EllipsoidLoss::KelvinVoigt(time) => time,
        };
        self.settling = self.settling.max(rate / at.polhode.0[lane]).max(rate * memory);
    }

    /// Bound of the relative error. (Q12)
    pub fn error(&self) -> f64 {
        ERROR_PER_CRITERION * self.inertia.max(self.settling).max(self.moments)
    }

    /// Refuses an average that does not hold.
    pub fn judge(&self) -> Result<(), EllipsoidRefusal> {
        let error = self.error();
        if error <= ACCEPTED_ERROR {
            return Ok(());
        }
        let cause = if !(self.inertia.max(self.settling) >= self.moments) {
            "the deformation changes the moments of inertia"
        } else if !(self.inertia >= self.settling) {
            "the wobble changes within its own period, or within the memory of the material"
        } else {
            "the spin comes near to the frequencies of the body"
        };
        Err(EllipsoidRefusal::DoesNotHold { percent: 100.0 * error, cause })
    }
}
