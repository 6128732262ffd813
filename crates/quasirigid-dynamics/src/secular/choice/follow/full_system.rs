//! History of the full system, and the time that it takes.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::super::limits::Limits;
use super::super::reason::{Reason, Work};
use super::{ChoiceError, ChoiceObserver, Driver, Found, Outcome, Stop};
use crate::averaging::Evolution;
use crate::dynamics::{FullState, PropagateError};
use crate::math::stopwatch::Stopwatch;
use crate::math::vec3::norm;
use crate::model::FlexibleBody;
use crate::secular::{DirectOptions, DirectStopReason, follow_directly};

/// Error allowed per step of the full system, relative.
const TOLERANCE: f64 = 1e-10;
/// Revolutions in which no wobble dies out.
const ONE_TURN: f64 = 1.0;
/// Revolutions of the full system that tell how long many take: a period of the polhode beside a plane of steady spins has thousands.
const TIMED_REVOLUTIONS: f64 = 20.0;
/// Time of work (s) that tells a pace, and by how much a shorter run is prolonged.
const TIMED: f64 = 0.1;
const LONGER: f64 = 4.0;

/// Options of a history of the full system to an energy (J), or for a time (s) if that is before it.
#[must_use]
pub fn history_options(until: Option<f64>, duration: Option<f64>, limits: &Limits) -> DirectOptions {
    DirectOptions {
        until,
        duration: duration.unwrap_or(f64::MAX),
        most_revolutions: f64::INFINITY,
        most_steps: limits.steps,
        tolerance: TOLERANCE,
    }
}

impl Driver<'_> {
    /// The history of the full system; announced and of limited length where it was not asked for, of few revolutions where the modes do not
    /// tell how long it takes.
    pub(super) fn full_system(&self, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        let (spins, span, limits) = (self.case.spins, self.case.span, self.limits);
        let mut options = history_options(Some(span.energies[1]), span.duration, limits);
        if !self.asked {
            self.announce_history(observer)?;
            let known = self.case.criteria.revolutions;
            options.most_revolutions = known.map_or(limits.few_revolutions, |_| limits.many_revolutions);
            options.most_steps =
                limits.steps_unasked(self.case.criteria.coordinates, spins.body.paths().is_some());
        }
        let run = follow_directly(spins.body, &span.start, &options, &mut |share| observer.observe(share))?;
        let end = run.rows[run.rows.len() - 1];
        match run.ending {
            DirectStopReason::Reached if end.revolutions < ONE_TURN => {
                Err(Reason::WithinRevolution { t: end.t }.into())
            }
            DirectStopReason::Reached | DirectStopReason::Finished => {
                let error = run.energy_drift.abs() / (span.energies[0] - span.energies[1]).abs();
                Ok(Found { outcome: Outcome::FullSystem(Box::new(run)), error: Some(error), source: None })
            }
            DirectStopReason::Interrupted => Err(ChoiceError::Interrupted.into()),
            ending => {
                let instability = spins.unstable().or_else(|| spins.growing_internal_mode());
                Err(Reason::Unfinished { t: end.t, revolutions: end.revolutions, ending, instability }.into())
            }
        }
    }

    /// Revolutions that the history may take, by the modes; beside a plane of steady spins, which is far from the axis of the modes, by the
    /// average where that takes longer.
    fn expected_revolutions(&self) -> f64 {
        let (spins, span, powers) = (self.case.spins, self.case.span, self.case.powers);
        let by_modes = self.case.criteria.revolutions.unwrap_or(self.limits.few_revolutions);
        if !self.case.criteria.equal_moments {
            return by_modes;
        }
        let average = Evolution::new(powers.of(powers.first), spins.range.angular_momentum());
        let [from, to] = span.ends;
        let revolutions = average.time(from, to) * norm(span.start.omega) / TAU;
        let longer = if revolutions.is_finite() { by_modes.max(revolutions) } else { by_modes };
        span.most_revolutions().map_or(longer, |most| longer.min(most))
    }

    fn announce_history(&self, observer: &mut dyn ChoiceObserver) -> Result<(), Stop> {
        let Ok(per_period) = self.seconds_per_period(observer) else { return Ok(()) };
        let span = self.case.span;
        let period = self.case.spins.motion(span.ends[0]).polhode_period();
        let revolutions_in_period = period * norm(span.start.omega) / TAU;
        Ok(observer
            .announce(Work::History, per_period * self.expected_revolutions() / revolutions_in_period)?)
    }

    /// Seconds of work that a period of the polhode takes in the full system, from its first revolutions.
    ///
    /// # Errors
    /// [`PropagateError`], which the work itself meets again.
    pub(super) fn seconds_per_period(
        &self,
        observer: &mut dyn ChoiceObserver,
    ) -> Result<f64, PropagateError> {
        if let Some(known) = self.seconds_per_period.get() {
            return Ok(*known);
        }
        let (spins, span) = (self.case.spins, self.case.span);
        let period = spins.motion(span.ends[0]).polhode_period();
        let duration = period.min(TIMED_REVOLUTIONS * TAU / norm(span.start.omega));
        let pace = pace_of_work(spins.body, &span.start, duration, self.limits, &mut |share| {
            observer.observe(share)
        })?;
        Ok(*self.seconds_per_period.get_or_init(|| pace * period))
    }
}

/// Seconds of work per second of motion of the full system, from its first time (s) or from more where that is done at once: the first steps are
/// small.
///
/// # Errors
/// [`PropagateError`] before the first step.
pub fn pace_of_work(
    body: &FlexibleBody,
    start: &FullState,
    mut duration: f64,
    limits: &Limits,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<f64, PropagateError> {
    loop {
        let (options, before) = (history_options(None, Some(duration), limits), Stopwatch::start());
        let run = follow_directly(body, start, &options, watch)?;
        let seconds = before.seconds();
        match run.ending {
            DirectStopReason::Finished if seconds < TIMED => duration *= LONGER,
            DirectStopReason::Interrupted => return Ok(0.0),
            _ => return Ok(seconds / run.rows[run.rows.len() - 1].t),
        }
    }
}
