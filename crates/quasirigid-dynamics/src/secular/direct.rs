//! Direct integration of the full system to a target energy, with a history of limited length.
//! Runs in pieces of growing length, each a run of its own, so that the number of rows stays bounded whatever the duration; every other row
//! is dropped beyond the limit.
//! Equation (Q6), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use crate::dynamics::{
    Event, Forced, FullState, Observer, Options, Outcome, PropagateError, Sample, propagate_full,
};
use crate::math::vec3::norm;
use crate::model::FlexibleBody;

/// History of the full system to a target energy; the envelope of the wobble is that of the rigid body with the same energy. (Q6)
#[derive(Clone, Debug)]
pub struct DirectRun {
    /// Rows of the history, ascending in time; the last one is the end.
    pub rows: Vec<DirectRow>,
    /// Mean power (W) over the wobble at each row; empty where it is to be taken from the rows.
    pub powers: Vec<f64>,
    /// Reason of the end.
    pub ending: DirectStopReason,
    /// Last state.
    pub last: FullState,
    /// Energy taken by each dissipator (J), in the order of [`FlexibleBody::dissipators`].
    pub budget: Vec<f64>,
    /// Energy drift of the integrator (J).
    pub energy_drift: f64,
    /// Number of steps.
    pub steps: u64,
}

/// Row of a direct run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectRow {
    /// Time (s).
    pub t: f64,
    /// Energy of the whole system (J).
    pub energy: f64,
    /// Energy dissipated since the start (J).
    pub dissipated: f64,
    /// Revolutions `∫|ω|dt/2π` since the start.
    pub revolutions: f64,
}

/// Target and limits of a direct run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectOptions {
    /// Energy at which the run ends (J); none to go on to the last time.
    pub until: Option<f64>,
    /// Last time (s).
    pub duration: f64,
    /// Limit of revolutions.
    pub most_revolutions: f64,
    /// Limit of steps.
    pub most_steps: u64,
    /// Error allowed per step, relative.
    pub tolerance: f64,
}

/// Reason why a direct run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum DirectStopReason {
    /// The energy was reached.
    Reached,
    /// The last time was reached.
    Finished,
    /// No energy is lost any more above the one asked for: the body spins steadily, about another axis than was expected.
    Settled,
    /// The revolutions allowed were used up.
    TurnLimit,
    /// The steps allowed were used up.
    StepLimit,
    /// No step could be made.
    Failed {
        /// Reason in words.
        reason: String,
    },
    /// The caller asked for an end.
    Interrupted,
}

/// Revolutions in the first piece of a run; each piece is longer by half.
const FIRST: f64 = 20.0;
const LONGER: f64 = 1.5;
/// Energy lost in a piece, relative to the whole, that is none.
const LOSSLESS: f64 = 1e-14;
/// Rows in a piece, and the number above which rows are dropped.
const ROWS_PER_PIECE: usize = 240;
const MOST_ROWS: usize = 8000;

/// Integrates the full system of a free body to an energy or a time. (Q6)
///
/// # Errors
/// [`PropagateError`] before the first step.
pub fn follow_directly(
    body: &FlexibleBody,
    start: &FullState,
    options: &DirectOptions,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<DirectRun, PropagateError> {
    let mut run = DirectRun::starting(body, start);
    let mut length = FIRST * std::f64::consts::TAU / norm(start.omega);
    loop {
        let done = run.rows[run.rows.len() - 1];
        let piece = length.min(options.duration - done.t);
        match run.piece(body, piece, options, watch)? {
            Some(ending) => {
                run.ending = ending;
                return Ok(run);
            }
            None if run.rows.len() > MOST_ROWS => run.thin(),
            None => {}
        }
        length *= LONGER;
    }
}

impl DirectRun {
    /// Run of one row.
    pub(super) fn starting(body: &FlexibleBody, start: &FullState) -> Self {
        let first = DirectRow { t: 0.0, energy: start.energy(body), dissipated: 0.0, revolutions: 0.0 };
        Self {
            rows: vec![first],
            powers: Vec::new(),
            ending: DirectStopReason::Finished,
            last: start.clone(),
            budget: vec![0.0; body.dissipators().len()],
            energy_drift: 0.0,
            steps: 0,
        }
    }

    /// Integrates one piece; returns the reason if the run ended.
    fn piece(
        &mut self,
        body: &FlexibleBody,
        piece: f64,
        options: &DirectOptions,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<DirectStopReason>, PropagateError> {
        let before = self.rows[self.rows.len() - 1];
        let times: Vec<f64> =
            (1..=ROWS_PER_PIECE).map(|i| piece * i as f64 / ROWS_PER_PIECE as f64).collect();
        let events = options.until.map(Event::Energy).into_iter().collect();
        let most_steps = options.most_steps.saturating_sub(self.steps).max(1);
        let settings = Options { tolerance: options.tolerance, most_steps, events, ..Options::default() };
        let share = (before.t / options.duration).max(before.revolutions / options.most_revolutions);
        let mut collector = Collector {
            body,
            before,
            rows: &mut self.rows,
            budget: &mut self.budget,
            powers: Vec::new(),
            last: self.last.clone(),
            watch: &mut || watch(share),
        };
        let start = self.last.clone();
        let found = propagate_full(Forced::not(body), &start, &times, &settings, &mut collector)?;
        self.last = collector.last;
        self.steps += found.work.steps;
        self.energy_drift += found.last.energy_drift;
        let end = before.after(&found.last);
        let ending = match found.outcome {
            Outcome::Finished if end.t >= options.duration * (1.0 - f64::EPSILON) => {
                Some(DirectStopReason::Finished)
            }
            Outcome::Finished if end.revolutions >= options.most_revolutions => {
                Some(DirectStopReason::TurnLimit)
            }
            Outcome::Finished => {
                let lost = end.dissipated - before.dissipated;
                (options.until.is_some() && lost <= LOSSLESS * end.energy)
                    .then_some(DirectStopReason::Settled)
            }
            Outcome::Event(_) => Some(DirectStopReason::Reached),
            Outcome::StepLimit => Some(DirectStopReason::StepLimit),
            Outcome::Interrupted => Some(DirectStopReason::Interrupted),
            Outcome::LeftRange(left) => Some(DirectStopReason::Failed { reason: left.to_string() }),
            failed @ (Outcome::Missed(_) | Outcome::Failed(_)) => {
                Some(DirectStopReason::Failed { reason: failed.to_string() })
            }
        };
        if self.rows.last().is_none_or(|last| last.t < end.t) {
            self.rows.push(end);
        }
        Ok(ending)
    }

    /// Drops every other row.
    fn thin(&mut self) {
        let last = self.rows.len() - 1;
        let mut i = 0;
        self.rows.retain(|_| {
            i += 1;
            (i - 1) % 2 == 0 || i - 1 == last
        });
    }
}

impl DirectRow {
    /// Row of a sample whose time, energies and revolutions count from this row.
    pub(super) fn after(&self, sample: &Sample) -> Self {
        Self {
            t: self.t + sample.t,
            energy: sample.energy,
            dissipated: self.dissipated + sample.dissipated,
            revolutions: self.revolutions + sample.revolutions,
        }
    }
}

struct Collector<'a> {
    body: &'a FlexibleBody,
    before: DirectRow,
    rows: &'a mut Vec<DirectRow>,
    budget: &'a mut Vec<f64>,
    /// Power of each dissipator at the last sample.
    powers: Vec<f64>,
    last: FullState,
    watch: &'a mut dyn FnMut() -> ControlFlow<()>,
}

impl Observer for Collector<'_> {
    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        self.last.q.copy_from_slice(q);
        self.last.rate.copy_from_slice(rate);
    }

    /// Splits the energy dissipated in the interval among the dissipators in proportion to the means of their powers at its ends.
    fn sample(&mut self, sample: &Sample) {
        (self.last.omega, self.last.attitude) = (sample.omega, sample.attitude);
        let rate = &self.last.rate;
        let now: Vec<f64> = self.body.dissipators().iter().map(|dissipator| dissipator.power(rate)).collect();
        let row = self.before.after(sample);
        let taken = row.dissipated - self.rows.last().map_or(0.0, |last| last.dissipated);
        let mean: Vec<f64> = now
            .iter()
            .enumerate()
            .map(|(i, now)| now + self.powers.get(i).copied().unwrap_or(*now))
            .collect();
        let sum: f64 = mean.iter().sum();
        if sum > 0.0 {
            self.budget.iter_mut().zip(&mean).for_each(|(budget, mean)| *budget += taken * mean / sum);
        }
        self.powers = now;
        self.rows.push(row);
    }

    fn progress(&mut self, _: f64) -> ControlFlow<()> {
        (self.watch)()
    }
}
