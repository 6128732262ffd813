//! History of the reduced equations about a spin to a target energy, where they hold from start to end.
//! In pieces of growing length, like the history of the full system; within a piece the target is located by finer and finer times.
//! Equation (Q10), docs/theory/16-methods.md.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::direct::{DirectOptions, DirectRow, DirectRun, DirectStopReason};
use crate::dynamics::{FullState, Observer, Options, Outcome, Sample};
use crate::model::{FlexibleBody, Mode, Principal};
use crate::modes::RelativeEquilibrium;
use crate::submanifold::{
    ManifoldStart, Masters, SpinManifold, SpinManifoldPlan, Style, SubmanifoldError, propagate_on_manifold,
};

/// History on a slow manifold about a spin.
#[derive(Clone, Debug)]
pub struct ManifoldHistory {
    /// History, in the form of one of the full system.
    pub run: DirectRun,
    /// Bound of the relative error of the times: defects of the equations and energy of the start that is off the spin manifold.
    pub error: f64,
    /// Degree of the equations.
    pub degree: usize,
    /// Names of the masters beside the nutation.
    pub beside: Vec<String>,
    /// Greatest nutation (rad) within the range of the equations at 1 %.
    pub range: f64,
}

/// Degrees that are tried, and the largest error of a time that is accepted.
const DEGREES: [usize; 2] = [5, 9];
const ACCEPTED_TIME_ERROR: f64 = 0.02;
/// Share of the defects that defines the range. (W11)
const RANGE_DEFECT: f64 = 0.01;
/// Decay times of the nutation at its amplitude in the first piece; each piece is longer by half.
const FIRST: f64 = 0.05;
const LONGER: f64 = 1.5;
/// Longest piece, in decay times of the nutation.
const LONGEST_PIECE: f64 = 1.0;
/// Phase of the nutation (rad) by which the energy, which falls unevenly, comes to a value sooner or later than between rows.
const LAGS: f64 = 0.3;
/// Rows over which the power at the end is taken.
const SLOPE: usize = 12;
/// Periods of the nutation in a decay time beyond which it is no measure of the history: a wobble that is not damped when it is small.
const MOST_CYCLES: f64 = 1e14;
/// Rows in a piece, and limit of pieces.
const ROWS_PER_PIECE: usize = 120;
const PIECES: usize = 400;

/// Follows a body along the slow manifold about the spin that a mode circles, to an energy or a time; none where the equations do not hold
/// on the way. (Q10)
///
/// # Errors
/// [`SubmanifoldError`] if there are no such equations.
pub fn follow_on_manifold(
    body: &FlexibleBody,
    mode: Mode,
    start: &FullState,
    options: &DirectOptions,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Option<ManifoldHistory>, SubmanifoldError> {
    follow(body, mode, None, start, options, watch)
}

/// As [`follow_on_manifold`] about a steady spin that is known, as one of a body with momentum wheels. (Q10)
///
/// # Errors
/// [`SubmanifoldError`] if there are no such equations.
pub fn follow_about(
    body: &FlexibleBody,
    spin: &RelativeEquilibrium,
    start: &FullState,
    options: &DirectOptions,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Option<ManifoldHistory>, SubmanifoldError> {
    let [mode, _] = Principal::compute(body.invariants().J).nearest(spin.angular_momentum);
    follow(body, mode, Some(spin), start, options, watch)
}

fn follow(
    body: &FlexibleBody,
    mode: Mode,
    about: Option<&RelativeEquilibrium>,
    start: &FullState,
    options: &DirectOptions,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Option<ManifoldHistory>, SubmanifoldError> {
    let angular_momentum = start.angular_momentum(body);
    for degree in DEGREES {
        let (masters, style) = (Masters::Automatic, Style::NormalForm);
        let plan = SpinManifoldPlan { mode, angular_momentum, masters, degree, style };
        let manifold = match about {
            Some(spin) => SpinManifold::about(body, spin.clone(), &plan, watch)?,
            None => SpinManifold::derive(body, &plan, watch)?,
        };
        let nutation = &manifold.masters[0];
        let lasts = nutation.frequency > MOST_CYCLES * nutation.decay_rate.abs();
        if lasts || manifold.unstable().is_some() {
            return Ok(None);
        }
        let from = manifold.start(start);
        let outside =
            !(from.left_out <= ACCEPTED_TIME_ERROR) || !from.z.as_flattened().iter().all(|z| z.is_finite());
        if outside {
            continue;
        }
        let mut history = History::new(&manifold, start, from);
        let ending = history.follow(options, watch);
        let ended = matches!(ending, DirectStopReason::Reached | DirectStopReason::Finished);
        if (ended && history.error() <= ACCEPTED_TIME_ERROR) || ending == DirectStopReason::Interrupted {
            return Ok(Some(history.finished(ending)));
        }
    }
    Ok(None)
}

struct History<'a, 'b> {
    manifold: &'a SpinManifold<'b>,
    from: ManifoldStart,
    run: DirectRun,
    /// Largest defects so far, and the energies of the steady spin and of the start (J).
    motion: f64,
    drift: f64,
    steady: f64,
}

impl<'a, 'b> History<'a, 'b> {
    fn new(manifold: &'a SpinManifold<'b>, start: &FullState, from: ManifoldStart) -> Self {
        let mut run = DirectRun::starting(manifold.body, start);
        run.powers.push(manifold.mean_power(&from.z));
        Self { manifold, from, run, motion: 0.0, drift: 0.0, steady: manifold.steady_energy() }
    }

    /// Bound of the relative error of the last time. (Q10)
    fn error(&self) -> f64 {
        let rows = &self.run.rows;
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        let drift = if self.drift == 0.0 { 0.0 } else { self.drift / last.dissipated };
        let behind = rows[rows.len() - 1 - SLOPE.min(rows.len() - 1)];
        let power = (behind.energy - last.energy) / (last.t - behind.t);
        let energy = self.from.left_out * (first.energy - self.steady).abs() + self.drift;
        let late = if energy == 0.0 { 0.0 } else { energy / (power * last.t).abs() };
        let uneven = LAGS / (self.manifold.masters[0].frequency * last.t);
        let error = self.motion + drift + self.from.left_out + late + uneven;
        if error.is_nan() { f64::INFINITY } else { error }
    }

    fn follow(
        &mut self,
        options: &DirectOptions,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> DirectStopReason {
        let mut decay = self.decay_time();
        let mut length = (FIRST * decay).max(TAU / self.manifold.masters[0].frequency);
        for _ in 0..PIECES {
            let done = self.run.rows[self.run.rows.len() - 1];
            let piece = length.min(options.duration - done.t);
            if let Some(ending) = self.piece(piece, options, watch) {
                return ending;
            }
            if !(self.motion <= ACCEPTED_TIME_ERROR) {
                return DirectStopReason::Failed {
                    reason: "the equations about the spin do not hold".into(),
                };
            }
            decay = self.decay_time();
            length = (LONGER * length).min((LONGEST_PIECE * decay).max(length));
        }
        DirectStopReason::TurnLimit
    }

    /// Decay time (s) of the nutation at its amplitude: where small wobbles lose little, wider ones may lose more by orders.
    fn decay_time(&self) -> f64 {
        let [re, im] = self.from.z[0];
        let [wide, _] = self.manifold.mean_rates(re.hypot(im));
        self.manifold.masters[0].decay_rate.abs().max(wide.abs()).recip()
    }

    /// Integrates one piece; returns the reason if the history ended.
    fn piece(
        &mut self,
        piece: f64,
        options: &DirectOptions,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Option<DirectStopReason> {
        let before = self.run.rows[self.run.rows.len() - 1];
        let share = self.share_done(before, options);
        let times: Vec<f64> =
            (1..=ROWS_PER_PIECE).map(|i| piece * i as f64 / ROWS_PER_PIECE as f64).collect();
        let most_steps = options.most_steps.saturating_sub(self.run.steps).max(1);
        let settings = Options { tolerance: options.tolerance, most_steps, ..Options::default() };
        let mut collector = Collector {
            samples: Vec::with_capacity(ROWS_PER_PIECE),
            budget: Vec::new(),
            watch: &mut || watch(share),
        };
        let found = propagate_on_manifold(self.manifold, &self.from, &times, &settings, &mut collector);
        let Collector { samples, budget, .. } = collector;
        let found = match found {
            Ok(found) => found,
            Err(error) => return Some(DirectStopReason::Failed { reason: error.to_string() }),
        };
        match found.outcome {
            Outcome::Finished => {}
            Outcome::Interrupted => return Some(DirectStopReason::Interrupted),
            Outcome::StepLimit => return Some(DirectStopReason::StepLimit),
            other => return Some(DirectStopReason::Failed { reason: other.to_string() }),
        }
        self.run.steps += found.work.steps;
        self.motion = self.motion.max(found.worst.0.motion);
        self.drift += found.last.energy_drift.abs();
        let rows: Vec<DirectRow> = samples.iter().map(|sample| before.after(sample)).collect();
        let crossed = options.until.and_then(|until| rows.iter().position(|row| row.energy <= until));
        let kept = crossed.unwrap_or(rows.len());
        self.run.rows.extend(&rows[..kept]);
        self.run.powers.extend(&found.powers[..kept]);
        let mut taken = 1.0;
        if let (Some(crossed), Some(until)) = (crossed, options.until) {
            let end = self.crossing(rows[crossed], until);
            taken = (end.dissipated - before.dissipated)
                / (rows[ROWS_PER_PIECE - 1].dissipated - before.dissipated);
            self.run.rows.push(end);
            self.run.powers.push(found.powers[crossed]);
        }
        self.run.budget.iter_mut().zip(&budget).for_each(|(sum, (_, energy))| *sum += taken * energy);
        self.from = ManifoldStart { z: found.z, attitude: found.last.attitude, ..self.from.clone() };
        let end = self.run.rows[self.run.rows.len() - 1];
        let last = end.t >= options.duration * (1.0 - f64::EPSILON);
        crossed.map(|_| DirectStopReason::Reached).or_else(|| last.then_some(DirectStopReason::Finished))
    }

    /// Share of the work that is done: of the way in the logarithm of the energy above the steady spin, or of the time.
    fn share_done(&self, before: DirectRow, options: &DirectOptions) -> f64 {
        let excess = |energy: f64| (energy - self.steady).abs();
        let Some(until) = options.until else { return before.t / options.duration };
        let whole = (excess(self.run.rows[0].energy) / excess(until)).ln().abs();
        1.0 - (excess(before.energy) / excess(until)).ln().abs() / whole.max(f64::MIN_POSITIVE)
    }

    /// Row at which the energy is met, between the last row and the next: the logarithm of the energy above the steady spin is linear in
    /// between.
    fn crossing(&self, next: DirectRow, until: f64) -> DirectRow {
        let last = self.run.rows[self.run.rows.len() - 1];
        let level = |energy: f64| (energy - self.steady).abs().ln();
        let part = (level(last.energy) - level(until)) / (level(last.energy) - level(next.energy));
        let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 1.0 };
        let between = |a: f64, b: f64| a + part * (b - a);
        DirectRow {
            t: between(last.t, next.t),
            energy: until,
            dissipated: between(last.dissipated, next.dissipated),
            revolutions: between(last.revolutions, next.revolutions),
        }
    }

    fn finished(mut self, ending: DirectStopReason) -> ManifoldHistory {
        let error = self.error();
        self.run.last = self.manifold.full_state(&self.from.z, self.from.attitude);
        self.run.energy_drift = self.drift;
        self.run.ending = ending;
        ManifoldHistory {
            error,
            degree: self.manifold.degree(),
            beside: self.manifold.masters[1..].iter().map(|master| master.name.clone()).collect(),
            range: self.manifold.range(RANGE_DEFECT).nutation,
            run: self.run,
        }
    }
}

struct Collector<'a> {
    samples: Vec<Sample>,
    budget: Vec<(String, f64)>,
    watch: &'a mut dyn FnMut() -> ControlFlow<()>,
}

impl Observer for Collector<'_> {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }

    fn progress(&mut self, _: f64) -> ControlFlow<()> {
        (self.watch)()
    }
}
