//! Mean power of the full system from a short run, in weighted windows after the transient.
//! Smooth weights converge faster than any power of the window; two windows one behind the other give the error, and windows double until
//! the mean settles.
//! Equation (Q4), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use thiserror::Error;

use super::energy_range::EnergyRange;
use crate::averaging::RotationState;
use crate::dynamics::{
    Forced, FullState, Observer, Options, Outcome, PropagateError, Sample, propagate_full,
};
use crate::model::FlexibleBody;

/// Mean power of the full system near a rotation state, from a short run. (Q4)
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Rotation state of the measurement, at the mean energy.
    pub rotation_state: RotationState,
    /// Mean power dissipated (W).
    pub power: f64,
    /// Estimate of the relative error: the change between two windows, one behind the other, relative to that of the equivalent polhode.
    pub error: f64,
    /// Mean power of each dissipator (W), in the order of [`FlexibleBody::dissipators`].
    pub budget: Vec<f64>,
    /// Revolutions of the run.
    pub revolutions: f64,
    /// Steps of the run.
    pub steps: u64,
    /// Source of the power.
    pub by: MeasuredBy,
}

/// Source of a mean power of the full system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeasuredBy {
    /// Short run. (Q4)
    ShortRun,
    /// Periodic motion. (Q19)
    PeriodicMotion,
    /// Reduced equations about a spin, without a run. (Q11)
    SpinManifold,
}

/// Error of a mean power that was not found.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeasureError {
    /// The run did not start.
    #[error(transparent)]
    Propagate(#[from] PropagateError),
    /// The run ended early.
    #[error("a short run of the full system ended at t = {t:.4} s: {reason}")]
    Ended {
        /// Time of the end (s).
        t: f64,
        /// Reason in words.
        reason: String,
    },
    /// The motion left the range of energies between the steady spins.
    #[error("the motion of the full system left the mode in which its power was to be measured")]
    LeftMode,
    /// The mean does not settle.
    #[error("the mean power of the full system does not settle: it differs by {:.2} % from one window to the next", 100.0 * .change)]
    Unsettled {
        /// Relative change between windows.
        change: f64,
    },
    /// No periodic motion was found.
    #[error("no periodic motion of the full system was found")]
    NoPeriodicMotion,
    /// A change of the periodic motion grows.
    #[error("a vibration grows beside the rotation, e-fold in {:.4} s", 1.0 / .rate)]
    Grows {
        /// Rate of growth (1/s).
        rate: f64,
    },
    /// The steps allowed were used up.
    #[error("a short run of the full system reached its step limit")]
    StepLimit,
    /// The caller asked for an end.
    #[error("interrupted")]
    Interrupted,
}

/// Plan of a short run: durations, accuracy and limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    /// Time for the transient of the start to decay (s).
    pub settling: f64,
    /// Periods of the polhode in the first window.
    pub periods: f64,
    /// Periods of the polhode in a window at least.
    pub fewest_periods: f64,
    /// Share of its energy that the wobble loses in a window, where that leaves enough periods.
    pub loss: f64,
    /// Windows as long as the first before they double.
    pub equal: usize,
    /// Relative change allowed between windows.
    pub change: f64,
    /// Error allowed per step, relative.
    pub tolerance: f64,
    /// Limit of steps in all.
    pub steps: u64,
    /// Limit of doublings of the window until the mean settles.
    pub doublings: usize,
}

/// Relative change from window to window up to which a power may change along a line or a parabola.
const MOST_DRIFT: f64 = 0.1;
/// Windows of the same length beyond those that double, for a power that changes along a line or a parabola.
const DRIFTING_WINDOWS: usize = 3;
/// Distance from a line, as a share of the change between windows, below which a power drifts.
const DRIFT_GAP: f64 = 0.5;

/// Samples in a period of the polhode.
const SAMPLES: f64 = 16.0;

/// Measures the mean power of the full system near a rotation state. (Q4)
pub(super) fn measured(
    body: &FlexibleBody,
    range: &EnergyRange,
    start: FullState,
    plan: Plan,
    watch: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Measurement, MeasureError> {
    let mut state = start;
    let (mut revolutions, mut steps) = (0.0, 0);
    let mut shares: Vec<[f64; 2]> = Vec::new();
    let (mut periods, mut doublings, mut start_energy) = (plan.periods, 0, f64::NAN);
    loop {
        let period = range.polhode(state.energy(body)).polhode_period();
        let settling = if shares.is_empty() { plan.settling } else { 0.0 };
        let window = periods * period;
        let left = Plan { steps: plan.steps.saturating_sub(steps), ..plan };
        let run = Window::follow(body, &state, [settling, window], SAMPLES / period, left, watch)?;
        (revolutions, steps) = (revolutions + run.revolutions, steps + run.steps);
        state = run.last;
        let Mean { energy, power, budget } = run.mean;
        let rotation_state = range.rotation_state(energy).ok_or(MeasureError::LeftMode)?;
        let polhode = range.polhode(energy);
        if shares.is_empty() {
            start_energy = energy + power * (settling + 0.5 * window);
            let slower = plan.loss * polhode.energy_from_axis() / (power * period);
            periods = periods.min(slower.max(plan.fewest_periods));
        }
        shares.push([energy, power / polhode.mean_square_acceleration()]);
        let change = still(&shares);
        let drifts = trend(&shares, 1).is_some_and(|line| line.gap < DRIFT_GAP * change);
        let doubles = shares.len() > plan.equal && !drifts;
        let last =
            shares.len() > plan.doublings + DRIFTING_WINDOWS || (doubles && doublings == plan.doublings);
        let enough = |change: f64| change <= plan.change || (last && change <= 4.0 * plan.change);
        let trends =
            || [1, 2].into_iter().find_map(|degree| trend(&shares, degree).filter(|trend| enough(trend.gap)));
        let settled = if enough(change) {
            Some((rotation_state, power, change))
        } else if let Some(Trend { points, gap }) = trends() {
            let first = if points.len() == shares.len() { start_energy } else { points[0][0] };
            let rotation_state = range.rotation_state(first).ok_or(MeasureError::LeftMode)?;
            let there = through(points, first) * range.polhode(first).mean_square_acceleration();
            Some((rotation_state, there, gap))
        } else {
            None
        };
        if let Some((rotation_state, there, error)) = settled {
            let budget = budget.iter().map(|part| part * there / power).collect();
            let power = there;
            return Ok(Measurement {
                rotation_state,
                power,
                error,
                budget,
                revolutions,
                steps,
                by: MeasuredBy::ShortRun,
            });
        }
        if last {
            return Err(MeasureError::Unsettled { change });
        }
        if doubles {
            (periods, doublings) = (2.0 * periods, doublings + 1);
        }
    }
}

/// Relative change of the last of the powers, each with its mean energy, from the one before.
fn still(shares: &[[f64; 2]]) -> f64 {
    match shares {
        [.., [_, before], [_, last]] => (last / before - 1.0).abs(),
        _ => f64::INFINITY,
    }
}

/// Line or parabola that the powers follow over the energy.
struct Trend<'a> {
    /// Powers that it goes through, the last one included.
    points: &'a [[f64; 2]],
    /// Relative distance of the last power from the line or parabola through the others.
    gap: f64,
}

/// Trend of the last powers, if they change slowly: in a body so soft that its power is not that of the equivalent polhode, the wobble
/// itself changes it from window to window. (Q4)
fn trend(shares: &[[f64; 2]], degree: usize) -> Option<Trend<'_>> {
    let points = &shares[shares.len().checked_sub(degree + 2)?..];
    let slow = points.windows(2).all(|pair| still(pair) <= MOST_DRIFT);
    let ([energy, power], before) = points.split_last()?;
    let gap = (power / through(before, *energy) - 1.0).abs();
    (slow && gap.is_finite()).then_some(Trend { points, gap })
}

/// Value at an energy of the polynomial through powers over their energies.
fn through(points: &[[f64; 2]], at: f64) -> f64 {
    let weight = |i: usize| -> f64 {
        let others = points.iter().enumerate().filter(|(k, _)| *k != i);
        others.map(|(_, [other, _])| (at - other) / (points[i][0] - other)).product()
    };
    points.iter().enumerate().map(|(i, [_, power])| weight(i) * power).sum()
}

/// Means over a window, with weights that fall to zero at its ends faster than any power.
#[derive(Clone, Debug)]
struct Mean {
    energy: f64,
    power: f64,
    budget: Vec<f64>,
}

struct Window {
    mean: Mean,
    last: FullState,
    revolutions: f64,
    steps: u64,
}

impl Window {
    /// Integrates the full system over the settling and the window.
    fn follow(
        body: &FlexibleBody,
        start: &FullState,
        [settling, window]: [f64; 2],
        per_time: f64,
        plan: Plan,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, MeasureError> {
        let count = (window * per_time).ceil().max(8.0) as usize;
        let times: Vec<f64> = (0..=count).map(|i| settling + window * i as f64 / count as f64).collect();
        let options = Options { tolerance: plan.tolerance, most_steps: plan.steps, ..Options::default() };
        let mut collector = Collector { body, rows: Vec::with_capacity(count + 1), last: None, watch };
        let run = propagate_full(Forced::not(body), start, &times, &options, &mut collector)?;
        let reason = match run.outcome {
            Outcome::Finished => None,
            Outcome::Interrupted => return Err(MeasureError::Interrupted),
            Outcome::StepLimit => return Err(MeasureError::StepLimit),
            Outcome::LeftRange(left) => Some(left.to_string()),
            Outcome::Event(_) => Some("an event".to_owned()),
            failed @ (Outcome::Missed(_) | Outcome::Failed(_)) => Some(failed.to_string()),
        };
        if let Some(reason) = reason {
            return Err(MeasureError::Ended { t: run.last.t, reason });
        }
        let Collector { rows, last, .. } = collector;
        let last = last.unwrap_or_else(|| start.clone());
        Ok(Self { mean: Mean::of(&rows), last, revolutions: run.last.revolutions, steps: run.work.steps })
    }
}

impl Mean {
    fn of(rows: &[Row]) -> Self {
        let intervals = rows.len().saturating_sub(1);
        let mut sum = Self { energy: 0.0, power: 0.0, budget: vec![0.0; rows[0].budget.len()] };
        let (mut weights, mut time) = (0.0, 0.0);
        for (i, [a, b]) in rows.array_windows().enumerate() {
            let x = (i as f64 + 0.5) / intervals as f64;
            let weight = (-1.0 / (x * (1.0 - x))).exp();
            weights += weight;
            time += weight * (b.t - a.t);
            sum.power += weight * (b.dissipated - a.dissipated);
            sum.energy += weight * 0.5 * (a.energy + b.energy);
            for ((sum, a), b) in sum.budget.iter_mut().zip(&a.budget).zip(&b.budget) {
                *sum += weight * 0.5 * (a + b);
            }
        }
        sum.power /= time;
        sum.energy /= weights;
        let taken: f64 = sum.budget.iter().sum();
        let scale = if taken > 0.0 { sum.power / taken } else { 0.0 };
        sum.budget.iter_mut().for_each(|power| *power *= scale);
        sum
    }
}

struct Row {
    t: f64,
    energy: f64,
    dissipated: f64,
    budget: Vec<f64>,
}

/// Collects the rows of a mean.
struct Collector<'a> {
    body: &'a FlexibleBody,
    rows: Vec<Row>,
    last: Option<FullState>,
    watch: &'a mut dyn FnMut() -> ControlFlow<()>,
}

impl Observer for Collector<'_> {
    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        let still = [1.0, 0.0, 0.0, 0.0];
        let state = FullState::at_rest(self.body, [0.0; 3], still);
        self.last = Some(FullState { q: q.to_vec(), rate: rate.to_vec(), ..state });
    }

    fn sample(&mut self, sample: &Sample) {
        let rate = self.last.as_mut().map_or(&[][..], |state| {
            (state.omega, state.attitude) = (sample.omega, sample.attitude);
            &state.rate
        });
        let budget = self.body.dissipators().iter().map(|dissipator| dissipator.power(rate)).collect();
        let Sample { t, energy, dissipated, .. } = *sample;
        self.rows.push(Row { t, energy, dissipated, budget });
    }

    fn progress(&mut self, _: f64) -> ControlFlow<()> {
        (self.watch)()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Powers along a line over the energy have no gap from it, and go on along it; a bend has one, a parabola none; a jump is no slow change.
    #[test]
    fn slow_changes_follow_a_trend() {
        let on_line = [[8.0, 3.0], [7.9, 2.95], [7.6, 2.8]];
        let Trend { points, gap } = trend(&on_line, 1).unwrap();
        assert!((through(points, 8.4) - 3.2).abs() < 1e-12 && gap < 1e-12, "{gap}");
        assert!((still(&on_line) - (1.0 - 2.8 / 2.95)).abs() < 1e-12);
        let bent = trend(&[[8.0, 3.0], [7.9, 2.95], [7.6, 2.82]], 1).unwrap();
        assert!((bent.gap - 0.02 / 2.8).abs() < 1e-12, "{}", bent.gap);
        let parabola = [8.0, 7.9, 7.6, 7.4].map(|E| [E, 3.0 + 0.5 * (E - 8.0) + 0.2 * (E - 8.0) * (E - 8.0)]);
        let Trend { points, gap } = trend(&parabola, 2).unwrap();
        assert!(gap < 1e-12 && (through(points, 8.5) - 3.3).abs() < 1e-12, "{gap}");
        assert!(trend(&parabola, 1).unwrap().gap > 1e-3);
        assert!(trend(&[[8.0, 3.0], [7.9, 2.95], [7.6, 2.2]], 1).is_none());
        assert!(trend(&[[8.0, 3.0], [8.0, 2.95], [8.0, 2.9]], 1).is_none(), "a line over nothing");
        assert!(trend(&on_line[..2], 1).is_none());
    }
}
