//! Histories of a verification: full and reduced runs from the same angular momentum and attitude.
//! The full run starts on the slow manifold two orders above, so that its own vibration is below the difference; the reduced run takes over
//! the angular momentum, not the angular velocity.
//! Equation (E4), docs/theory/09-forced-reduction.md.

use std::ops::ControlFlow;

use super::verify::VerificationError;
use crate::dynamics::{
    Forced, FullState, MAX_FORCED_ORDER, Observer, Options, Outcome, Sample, SlowEquations, SlowState, Start,
    propagate, propagate_forced, propagate_full,
};
use crate::math::vec3::norm;
use crate::model::MotionState;
use crate::reduction::{MAX_ORDER, manifold_has_meaning, reduce, state_has_meaning};

impl Start {
    /// Full state on the slow manifold with this angular velocity, two orders above `order` where the reduction goes so far.
    ///
    /// # Errors
    /// [`VerificationError::NoSlowManifold`] where the series does not hold, and [`VerificationError`] if there is no such state. (Q8)
    pub fn settled(&self, system: Forced, order: usize) -> Result<FullState, VerificationError> {
        let Start { omega, attitude, place, velocity } = *self;
        if system.acts() {
            let above = (order + 2).min(MAX_FORCED_ORDER);
            let still = SlowState { angular_momentum: [0.0; 3], attitude, place, velocity };
            let slow = still.with_spin(system, above, omega)?;
            let state = FullState::on_manifold(system, above, &slow)?;
            let motion = MotionState { omega, q: &state.q, rate: &state.rate };
            let exists = state_has_meaning(system.body, motion, slow.angular_momentum);
            return if exists {
                Ok(state)
            } else {
                Err(VerificationError::NoSlowManifold { spin: norm(omega) })
            };
        }
        let reduced = reduce(system.body, (order + 2).min(MAX_ORDER))?;
        if !manifold_has_meaning(system.body, &reduced, omega) {
            return Err(VerificationError::NoSlowManifold { spin: norm(omega) });
        }
        let (q, rate) = (reduced.q.value(omega), reduced.rate.value(omega));
        Ok(FullState { omega, attitude, q, rate, place, velocity })
    }
}

/// Full history with its start and number of steps.
pub(super) struct Truth {
    pub start: FullState,
    pub samples: Vec<Sample>,
    pub steps: u64,
}

/// Full history at the output times, from the slow manifold of an order above `order`.
pub(super) fn full(
    system: Forced,
    start: &Start,
    order: usize,
    times: &[f64],
    options: &Options,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Truth, VerificationError> {
    let state = start.settled(system, order)?;
    let mut collector = Collector { samples: Vec::new(), watch };
    let run = propagate_full(system, &state, times, options, &mut collector)?;
    finished(run.outcome)?;
    Ok(Truth { start: state, samples: collector.samples, steps: run.work.steps })
}

/// Reduced history of order `p` at the output times, from the angular momentum of the full one.
pub(super) fn reduced(
    system: Forced,
    full: &FullState,
    order: usize,
    times: &[f64],
    options: &Options,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Vec<Sample>, VerificationError> {
    let angular_momentum = full.angular_momentum(system.body);
    let mut collector = Collector { samples: Vec::new(), watch };
    let run = if system.acts() {
        let FullState { attitude, place, velocity, .. } = *full;
        let slow = SlowState { angular_momentum, attitude, place, velocity };
        let above = SlowEquations::torque_free_order(system, options.form, order);
        let body = above.map(|above| reduce(system.body, above)).transpose()?;
        let equations = SlowEquations::energy_form(system, order, body.as_ref());
        propagate_forced(equations, &slow, times, options, &mut collector)?
    } else {
        let body = reduce(system.body, order)?;
        let FullState { attitude, place, velocity, .. } = *full;
        let initial = Start { omega: body.angular_velocity(angular_momentum), attitude, place, velocity };
        propagate(&body, initial, times, options, &mut collector)?
    };
    finished(run.outcome)?;
    Ok(collector.samples)
}

/// Refuses a run that did not come to its end.
pub(super) fn finished(outcome: Outcome) -> Result<(), VerificationError> {
    match outcome {
        Outcome::Finished => Ok(()),
        Outcome::Interrupted => Err(VerificationError::Interrupted),
        other => Err(VerificationError::Unfinished { outcome: other }),
    }
}

struct Collector<'a> {
    samples: Vec<Sample>,
    watch: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
}

impl Observer for Collector<'_> {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        (self.watch)(t)
    }
}
