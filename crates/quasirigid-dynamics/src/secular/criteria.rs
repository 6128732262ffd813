//! Criteria of averaging along rigid polhodes: estimated errors of the mean power and of times.
//! The factor between criteria and error is measured on bodies drawn at random, not derived; the limits decide which method an evolution
//! takes.
//! Equations (Q3), (Q7) and (Q9), docs/theory/16-methods.md; (L19), docs/theory/13-inside.md.

use super::energy_range::EnergyRange;
use super::poles::Poles;
use crate::averaging::{Evolution, MeanPower, RotationState};
use crate::model::Mode;

/// Criteria for averaging along the polhode of the rigid body. (Q7)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AverageCriteria {
    /// Largest relative difference between the rates of change of a small wobble from the average and from the modes.
    pub poles: f64,
    /// Largest ratio `γ/β` of the rate of change of the wobble to the rate at which the internal motion follows.
    pub settling: f64,
    /// Largest relative change of a difference between principal moments by the steady deformation.
    pub moments: f64,
    /// Largest relative difference between the averaged power and that of short runs of the full system; zero where none were made. (Q9)
    pub probed: f64,
    /// Relative rounding of the averaged power.
    pub rounding: f64,
    /// Estimate of the relative error in a wide wobble from the response of liquids about the mean spin. (L19)
    pub liquids: f64,
}

/// Error of an average per `γ/β`.
pub(super) const PER_SETTLING: f64 = 1.6;
/// Bound of the error over the largest criterion: the largest ratio found in comparisons with full systems (3), rounded up.
pub(super) const ERROR_PER_CRITERION: f64 = 4.0;

impl AverageCriteria {
    /// Bound of the relative error of the averaged power. (Q7)
    #[must_use]
    pub fn error(&self) -> f64 {
        let compared = self.poles.max(PER_SETTLING * self.settling).max(self.moments).max(self.probed);
        (ERROR_PER_CRITERION * compared).max(self.liquids).max(self.rounding)
    }
}

/// Bound of the relative error of a power by the elasticity that the frozen polhode leaves out, from the ratio of the spin to the slowest elastic
/// frequency: power is the square of amplitudes that follow loads of twice the spin at most. (Q17)
pub(super) fn deformed(spin_ratio: f64) -> f64 {
    2.0 * (2.0 * spin_ratio).powi(2)
}

/// Relative error of a time of so many periods of the wobble from the uneven fall of the energy of a full system: a quarter of a period at
/// each end, as of a power that acts half the time.
pub(super) fn uneven(periods: f64) -> f64 {
    0.5 / periods
}

/// Criteria of an average between two rotation states, from the modes at the poles. (Q7)
#[must_use]
pub fn average_criteria(
    power: &dyn MeanPower,
    range: &EnergyRange,
    poles: &Poles,
    ends: [RotationState; 2],
) -> AverageCriteria {
    let average = Evolution::new(power, range.angular_momentum());
    let mut criteria = AverageCriteria::default();
    for mode in [Mode::LongAxis, Mode::ShortAxis] {
        if !ends.iter().any(|rotation_state| rotation_state.mode == mode) {
            continue;
        }
        let rate = average.wobble_rate(mode);
        let (Some(exact), Some(pole)) = (poles.rate(mode), poles.of_mode(mode)) else {
            criteria.poles = f64::INFINITY;
            continue;
        };
        criteria.poles = criteria.poles.max(apart(rate, exact));
        criteria.settling = criteria.settling.max(rate.max(exact.abs()) / pole.following_rate());
    }
    for rotation_state in ends {
        let motion = average.motion(rotation_state);
        let rate = average.power(rotation_state) / (2.0 * motion.energy_from_axis());
        let follows = poles.of_mode(rotation_state.mode).map_or(0.0, super::Pole::following_rate);
        criteria.settling = criteria.settling.max(rate / follows);
        criteria.rounding = criteria.rounding.max(power.rounding(&motion));
    }
    let (rigid, deformed) = (power.moments(), range.moments());
    for (a, b) in [(0, 1), (1, 2)] {
        let (before, after) = (rigid[b] - rigid[a], deformed[b] - deformed[a]);
        if before > DISTINCT * rigid[2] {
            criteria.moments = criteria.moments.max((after / before - 1.0).abs());
        }
    }
    criteria
}

/// Relative difference of a rate from an exact one; infinite where either is not known.
#[must_use]
pub fn apart(rate: f64, exact: f64) -> f64 {
    let gap = (rate / exact - 1.0).abs();
    if rate == exact {
        0.0
    } else if gap.is_nan() {
        f64::INFINITY
    } else {
        gap
    }
}

/// Difference of moments, relative to the largest, below which they are those of a body of revolution.
const DISTINCT: f64 = 1e-9;
