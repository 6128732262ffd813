//! Mean power at a rotation state by the periodic motion of the full system there: intervals double until the power settles.
//! Equation (Q19), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use super::energy_range::EnergyRange;
use super::measure::{MeasureError, MeasuredBy, Measurement};
use crate::averaging::{FreeRotation, RotationState};
use crate::dynamics::{FullState, MotionGuess, PeriodicMotion, periodic_motion};
use crate::math::vec3::{add, dot, scale, unit};
use crate::model::FlexibleBody;

/// Intervals at first for each period of a small wobble, and doublings at most.
const INTERVALS: f64 = 12.0;
const DOUBLINGS: usize = 3;
/// Intervals at first beyond which a motion takes too long to find.
const MOST_INTERVALS: usize = 150;
/// Share of the error wanted that a doubling may change the power by.
const SETTLED: f64 = 0.25;
/// Place `ξ` of a wobble as quick as a small one.
const SMALL: f64 = 8.0;
/// Error of the power per share of its energy that the wobble loses in a period: comparisons with short runs show up to 1.4.
const PER_LOSS: f64 = 2.0;
/// Growth over a period that is rounding of a multiplier.
const ROUNDING: f64 = 1e-5;

/// Places at which periodic motions were found, from the nearest of which others are guessed.
#[derive(Clone, Debug, Default)]
pub(super) struct PeriodicPlaces {
    found: Vec<(RotationState, PeriodicMotion)>,
}

impl PeriodicPlaces {
    /// Measures the mean power at a rotation state, to a relative error. (Q19)
    pub fn measure(
        &mut self,
        body: &FlexibleBody,
        range: &EnergyRange,
        (place, error): (RotationState, f64),
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Measurement, MeasureError> {
        let (motion, change) = self.settled(body, range, (place, error), watch)?;
        let rotation_state = range.rotation_state(motion.energy).ok_or(MeasureError::LeftMode)?;
        if rotation_state.mode != place.mode {
            return Err(MeasureError::LeftMode);
        }
        let growth = motion.growth(body).ok_or(MeasureError::NoPeriodicMotion)?;
        if growth * motion.period > ROUNDING {
            return Err(MeasureError::Grows { rate: growth });
        }
        let loss = motion.power * motion.period / range.polhode(motion.energy).energy_from_axis();
        let found = Measurement {
            rotation_state,
            power: motion.power,
            error: change + PER_LOSS * loss,
            budget: motion.budget.clone(),
            revolutions: 0.0,
            steps: 0,
            by: MeasuredBy::PeriodicMotion,
        };
        self.found.push((place, motion));
        Ok(found)
    }

    /// Periodic motion whose power has settled, with the last change of it.
    fn settled(
        &self,
        body: &FlexibleBody,
        range: &EnergyRange,
        (place, error): (RotationState, f64),
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<(PeriodicMotion, f64), MeasureError> {
        let at = |xi: f64| FreeRotation::at_logit(range.moments(), range.angular_momentum(), place.mode, xi);
        let stretch = at(place.xi).polhode_period() / at(SMALL.max(place.xi)).polhode_period();
        let mut intervals = (INTERVALS * stretch).ceil() as usize;
        if intervals > MOST_INTERVALS {
            return Err(MeasureError::NoPeriodicMotion);
        }
        let mut motion = self.first(body, range, place, intervals).ok_or(MeasureError::NoPeriodicMotion)?;
        for _ in 0..DOUBLINGS {
            if watch().is_break() {
                return Err(MeasureError::Interrupted);
            }
            intervals *= 2;
            let finer = motion.on(body, intervals).ok_or(MeasureError::NoPeriodicMotion)?;
            let change = (finer.power / motion.power - 1.0).abs();
            motion = finer;
            if change <= SETTLED * error {
                return Ok((motion, change));
            }
        }
        Err(MeasureError::NoPeriodicMotion)
    }

    /// Periodic motion at a rotation state, guessed from the equivalent polhode and the body in balance, or from the nearest motion found.
    fn first(
        &self,
        body: &FlexibleBody,
        range: &EnergyRange,
        place: RotationState,
        intervals: usize,
    ) -> Option<PeriodicMotion> {
        let start = range.state(body, place)?;
        let polhode = EquivalentPolhode::through(body, range, place, &start)?;
        let still = &range.equilibrium(place.mode)?.q;
        let displacements =
            |omega: [f64; 3]| EnergyRange::balance(body, omega).unwrap_or_else(|| still.clone());
        let omega = |share: f64| polhode.omega(share);
        let distance = |(state, _): &&(RotationState, PeriodicMotion)| (state.xi - place.xi).abs();
        let same = self.found.iter().filter(|(state, _)| state.mode == place.mode);
        let near = same.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|(_, motion)| motion);
        near.into_iter().map(Some).chain([None]).find_map(|near| {
            let guess = MotionGuess {
                period: polhode.period,
                start: start.angular_momentum(body),
                omega: &omega,
                displacements: &displacements,
                near,
            };
            periodic_motion(body, &guess, intervals)
        })
    }
}

/// Equivalent polhode in body axes from a start on.
struct EquivalentPolhode {
    motion: FreeRotation,
    axes: [[f64; 3]; 3],
    period: f64,
    /// Time (s) at which the angular momentum is nearest to that of the start.
    start: f64,
}

impl EquivalentPolhode {
    fn through(
        body: &FlexibleBody,
        range: &EnergyRange,
        RotationState { mode, xi }: RotationState,
        start: &FullState,
    ) -> Option<Self> {
        let motion = FreeRotation::at_logit(range.moments(), range.angular_momentum(), mode, xi);
        let axes = range.frame(mode)?;
        let period = motion.polhode_period();
        let towards = unit(start.angular_momentum(body));
        let near = |t: &f64| {
            let omega = motion.omega(*t);
            let K = [0, 1, 2].map(|k| scale(motion.moments()[k] * omega[k], axes[k]));
            dot(unit(add(add(K[0], K[1]), K[2])), towards)
        };
        let quarters = [0.0, 0.25, 0.5, 0.75].map(|share| share * period);
        let start = quarters.into_iter().max_by(|a, b| near(a).total_cmp(&near(b)))?;
        Some(Self { motion, axes, period, start })
    }

    /// Angular velocity (rad/s, body axes) at a share of the period.
    fn omega(&self, share: f64) -> [f64; 3] {
        let omega = self.motion.omega(self.start + share * self.period);
        let [x, y, z] = [0, 1, 2].map(|k| scale(omega[k], self.axes[k]));
        add(add(x, y), z)
    }
}
