//! Implicit Runge–Kutta method Radau IIA of order 13 for a stiff linear part and a non-stiff rest.
//! Only the linear part is factored, and the step is kept where it would change little: a factorisation then lasts for many steps.
//! Method `[@hairer1999]`; equations (T2) and (T4), docs/theory/08-full-system.md.

use std::marker::PhantomData;

use super::Checkpoint;
use super::age::Age;
use super::radau_iteration::{Iteration, Pace};
use super::radau_search::{Attempt, Search};
use super::radau_tableau::{C, GAMMA, SPLIT, STAGES, START};
use super::stiff::Stiff;
use super::stretch::{StepRule, Stretch};
use super::system::{DenseOutput, Solver, State, StepError, Work, accumulate, towards};
use crate::simd::{Arithmetic, Rounding};

/// Implicit Runge–Kutta method Radau IIA of seven stages and order 13 `[@hairer1999]` for systems whose stiff part is
/// linear and constant or changes slowly, so that a factorisation lasts as long as the step, or until the iteration slows.
///
/// The stages are found by sweeps over the non-stiff components, and by the constant linear part for the rest. The step is controlled by an
/// embedded formula of order 7, as far as the dense output is good; the state at the end of the step is better by far.
#[derive(Clone, Debug)]
pub struct Radau<S, R> {
    system: S,
    t: f64,
    /// What the rounding of `t` has lost, which would add up over steps of one length.
    late: f64,
    y: Vec<f64>,
    carry: Vec<f64>,
    /// One over the error allowed per step in each component; zero where it is not controlled.
    weights: Vec<f64>,
    h: f64,
    work: Work,
    /// Start and length of the last step.
    last: (f64, f64),
    start: Vec<f64>,
    /// Rate at the state reached.
    rate: Vec<f64>,
    stages: Iteration,
    /// Whether the last step continues into the next.
    continues: bool,
    /// Steps since the last search for stages that was too slow.
    calm: u32,
    /// Step for which the linear part is factored.
    factored: f64,
    /// Age of the linear part, where it changes.
    age: Age,
    /// Time and state at which the linear part was evaluated; empty of a constant one.
    renewed: (f64, Vec<f64>),
    /// Change over the last step, and its error estimate.
    change: Vec<f64>,
    error: Vec<f64>,
    smoothed: Vec<[f64; 2]>,
    arithmetic: PhantomData<R>,
}

/// Safety factor, and the limit of one cut of the step.
const SAFETY_FACTOR: f64 = 0.82;
const SHRINK: f64 = 0.2;
/// Order of the error estimate plus one.
const ORDER: f64 = 8.0;
/// Multiple of the ratio of corrections up to which longer steps pay beyond which shorter ones pay, and the factor of the step then.
const FAR_RATIO: f64 = 2.0;
const SHORTER: f64 = 0.7;
/// Stage in the middle of a step.
const MIDDLE: usize = 3;

impl<S: Stiff, R: Arithmetic> Radau<S, R> {
    /// Starts at a state with a first step (s), and with the error allowed per step in each component.
    pub fn new(system: S, t: f64, y: Vec<f64>, allowed: &[f64], h: f64) -> Self {
        Self::rounded(system, t, y, allowed, h, Rounding::Fastest)
    }

    /// As [`new`](Self::new), with the bits of stages that are evaluated side by side.
    pub fn rounded(mut system: S, t: f64, y: Vec<f64>, allowed: &[f64], h: f64, rounding: Rounding) -> Self {
        let zero = vec![0.0; y.len()];
        let mut rate = zero.clone();
        system.rate::<R>(t, &y, &mut rate);
        let stiff = system.stiff();
        let stages = Iteration::new(&system, y.len(), rounding);
        Self {
            system,
            t,
            late: 0.0,
            carry: zero.clone(),
            weights: allowed.iter().map(|allowed| 1.0 / allowed).collect(),
            h,
            work: Work { evaluations: 1, ..Work::default() },
            last: (t, 0.0),
            start: y.clone(),
            rate,
            stages,
            continues: false,
            calm: u32::MAX,
            factored: 0.0,
            age: Age::default(),
            renewed: (t, Vec::new()),
            change: zero.clone(),
            error: zero,
            smoothed: vec![[0.0; 2]; y.len() - stiff],
            arithmetic: PhantomData,
            y,
        }
    }

    /// System that is integrated.
    pub fn system(&self) -> &S {
        &self.system
    }

    /// The same, to change; [`rewind`](Solver::rewind) then takes the change up.
    pub fn system_mut(&mut self) -> &mut S {
        &mut self.system
    }

    /// Step that the method would make next.
    pub fn h(&self) -> f64 {
        self.h
    }

    /// Factors the linear part, evaluated in the middle of the step where it changes and is too old. (T4)
    fn factor(&mut self, h: f64) {
        let renewed = self.system.changes() && self.age.is_due();
        if renewed {
            let middle: Vec<f64> =
                self.y.iter().zip(self.stages.changes(MIDDLE, h)).map(|(y, change)| y + change).collect();
            self.renewed = (self.t + C[MIDDLE] * h, middle);
            self.system.renew(self.renewed.0, &self.renewed.1);
            self.age.steps = Some(0);
        }
        if renewed || self.factored != h {
            self.shift(h);
            self.work.factorizations += 1;
        }
    }

    fn shift(&mut self, h: f64) {
        self.system.shift(GAMMA.map(|[re, im]| [re / h, im / h]));
        self.stages.factor(&mut self.system);
        self.factored = h;
    }

    fn find_stages(&mut self, h: f64) -> Search {
        if self.continues {
            self.stages.guess_continued(h / self.last.1);
        } else {
            self.stages.guess_still(&self.rate);
        }
        self.factor(h);
        let attempt = Attempt { t: self.t, h, y: &self.y, weights: &self.weights };
        self.stages.find::<S, R>(&mut self.system, attempt)
    }

    /// Error estimate of the step in units of the error allowed, filtered by the linear part.
    fn estimate(&mut self, h: f64) -> f64 {
        let stiff = self.system.stiff();
        self.stages.error(h, &self.rate, &mut self.error);
        for (smoothed, error) in self.smoothed.iter_mut().zip(&self.error[stiff..]) {
            *smoothed = [error / (START * h), 0.0];
        }
        self.system.solve(0, &mut self.smoothed);
        for (error, [smoothed, _]) in self.error[stiff..].iter_mut().zip(&self.smoothed) {
            *error = *smoothed;
        }
        let squares = self.error.iter().zip(&self.weights).map(|(error, weight)| (error * weight).powi(2));
        squares.sum::<f64>().sqrt()
    }

    /// Takes over a step, which may reach an end.
    fn accept(&mut self, h: f64, end: Option<f64>) {
        self.last = (self.t, h);
        self.start.copy_from_slice(&self.y);
        self.stages.keep(&self.rate);
        self.stages.end(h, &mut self.change, &mut self.rate);
        accumulate(&mut self.y, &mut self.carry, &self.change);
        let change = h + self.late;
        let t = end.unwrap_or(self.t + change);
        self.late = if end.is_none() { change - (t - self.t) } else { 0.0 };
        self.t = t;
        self.work.steps += 1;
        self.work.implicit_steps += 1;
        self.continues = true;
        self.calm = self.calm.saturating_add(1);
        self.age.steps = self.age.steps.map(|steps| steps + 1);
    }

    /// Growth of the step that the iteration of the stages permits, where accuracy permits `wanted`; a linear part that is too old is
    /// evaluated again first.
    fn affordable(&mut self, ratio: f64, h: f64, wanted: f64) -> f64 {
        let Pace { contraction, .. } = self.stages.pace();
        let growth = if ratio > FAR_RATIO * contraction { SHORTER } else { (contraction / ratio).max(1.0) };
        let aged = self.system.changes() && self.age.shows(ratio / h, growth < wanted);
        if aged { growth.max(1.0) } else { growth }
    }
}

impl<S: Stiff, R: Arithmetic> Solver for Radau<S, R> {
    type State = Vec<f64>;

    fn t(&self) -> f64 {
        self.t
    }

    fn y(&self) -> &Vec<f64> {
        &self.y
    }

    fn work(&self) -> Work {
        Work { evaluations: self.work.evaluations + STAGES as u64 * self.stages.sweeps(), ..self.work }
    }

    fn step(&mut self, end: f64) -> Result<(), StepError> {
        let pace = self.stages.pace();
        let mut rejected = false;
        let mut undefined = self.rate.iter().any(|rate| !rate.is_finite());
        loop {
            let (h, reaches) = towards(end, self.t, self.h, undefined)?;
            let h = if reaches { h - self.late } else { h };
            let search = self.find_stages(h);
            undefined = matches!(search, Search::NotFinite);
            let factor = match search {
                Search::Found(ratio) => {
                    let error = self.estimate(h).max(f64::MIN_POSITIVE);
                    let factor = (SAFETY_FACTOR * error.powf(-1.0 / ORDER)).clamp(SHRINK, pace.grow);
                    if error <= 1.0 {
                        let growth = factor.min(self.affordable(ratio, h, factor));
                        let limit = if rejected || self.calm < pace.rest { 1.0 } else { pace.grow };
                        let growth = growth.min(limit);
                        let kept = if pace.kept.contains(&growth) { 1.0 } else { growth };
                        self.h = if reaches { self.h.max(h * kept) } else { h * kept };
                        self.accept(h, reaches.then_some(end));
                        return Ok(());
                    }
                    factor
                }
                Search::Slow(_) if self.system.changes() && self.age.is_to_blame() => 1.0,
                Search::Slow(ratio) => {
                    self.calm = 0;
                    (pace.contraction / ratio).clamp(SHRINK, 0.5)
                }
                Search::NotFinite => 0.5,
            };
            self.h = h * factor;
            self.work.rejected += 1;
            rejected = true;
        }
    }

    fn dense(&mut self) -> DenseOutput<Vec<f64>> {
        let (t, h) = self.last;
        let changes: [Vec<f64>; STAGES] = std::array::from_fn(|stage| self.stages.changes(stage, h));
        let coefficients = SPLIT.map(|weights| {
            let mut row = self.start.zeroed();
            let start = row.clone();
            row.combine::<R>(&start, 1.0, &weights, &changes);
            row
        });
        DenseOutput { t, h, y: self.start.clone(), coefficients }
    }

    fn enter(&mut self, stretch: Stretch) {
        self.system.enter(stretch);
    }

    fn restart(&mut self, stretch: Stretch) {
        self.system.enter(stretch);
        self.continues = false;
        self.system.rate::<R>(self.t, &self.y, &mut self.rate);
        self.work.evaluations += 1;
    }

    fn rule(&self) -> StepRule {
        StepRule::implicit(self.last)
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        let Self {
            t,
            late,
            y,
            carry,
            h,
            work,
            last,
            start,
            rate,
            stages,
            continues,
            calm,
            factored,
            age,
            renewed,
            ..
        } = self;
        [*t, *late, *h, last.0, last.1, *factored, renewed.0]
            .into_iter()
            .for_each(|number| checkpoint.save(number));
        [y, carry, start, rate, &renewed.1].into_iter().for_each(|list| checkpoint.save_list(list));
        checkpoint.save_work(*work);
        checkpoint.save_count(u64::from(*continues));
        checkpoint.save_count(u64::from(*calm));
        age.save(checkpoint);
        stages.save(checkpoint);
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let Self {
            t,
            late,
            y,
            carry,
            h,
            work,
            last,
            start,
            rate,
            stages,
            continues,
            calm,
            factored,
            age,
            renewed,
            ..
        } = self;
        for number in [t, late, h, &mut last.0, &mut last.1, factored, &mut renewed.0] {
            *number = checkpoint.load()?;
        }
        for list in [y, carry, start, rate] {
            checkpoint.load_into(list)?;
        }
        renewed.1 = checkpoint.load_list()?;
        *work = checkpoint.load_work()?;
        *continues = checkpoint.load_count()? == 1;
        *calm = u32::try_from(checkpoint.load_count()?).ok()?;
        *age = Age::load(checkpoint)?;
        stages.load(checkpoint)?;
        if self.renewed.1.len() == self.y.len() {
            self.system.renew(self.renewed.0, &self.renewed.1);
        }
        if self.factored > 0.0 {
            self.shift(self.factored);
        }
        Some(())
    }

    fn correct(&mut self, change: &Vec<f64>) {
        accumulate(&mut self.y, &mut self.carry, change);
    }

    fn rewind(&mut self, t: f64, y: Vec<f64>) {
        (self.t, self.late) = (t, 0.0);
        self.y = y;
        self.carry.fill(0.0);
        self.continues = false;
        self.system.rate::<R>(self.t, &self.y, &mut self.rate);
        self.work.evaluations += 1;
    }
}
