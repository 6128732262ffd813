use std::marker::PhantomData;
use std::ops::Range;

use super::radau_tableau::{A, C, ERROR, FROM_EIGEN, GAMMA, INVERSE, SHIFTS, SPLIT, STAGES, START, TO_EIGEN};
use super::system::{Dense, POWERS, Solver, State, StepError, System, Work, accumulate};
use crate::math::simd::Arithmetic;

/// A system with a stiff linear part `L` that does not change: `rate = L y + (what is not stiff)`.
///
/// `L` acts on a range of the components, and only there.
pub trait Stiff<Y>: System<Y> {
    /// Components that `L` acts on.
    fn stiff(&self) -> Range<usize>;

    /// Prepares to solve `(s − L) x = right` at the shifts `s` (1/s): real and imaginary part.
    fn shift(&mut self, shifts: [[f64; 2]; 4]);

    /// Solves `(s − L) x = right` in place, at the shift with this number.
    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]);
}

/// Implicit Runge–Kutta method Radau IIA of seven stages and order 13 `[@hairer1999]` for systems whose stiff part is
/// linear and constant, so that no Jacobian is ever formed and a factorisation lasts as long as the step.
///
/// The stages are found by fixed-point iteration on what is not stiff, and by the constant linear part on the rest. The
/// step is controlled by an embedded formula of order 7, as far as the dense output is good; the state at the end of the step
/// is better by far.
#[derive(Clone, Debug)]
pub struct Radau<S, Y, R> {
    system: S,
    t: f64,
    y: Y,
    carry: Y,
    /// Error allowed per step in each component; infinite where it is not controlled.
    allowed: Y,
    h: f64,
    work: Work,
    /// Start and length of the last step.
    last: (f64, f64),
    start: Y,
    /// Rate at the state reached.
    rate: Y,
    /// Changes of the state from the start of the step to each stage.
    changes: [Y; STAGES],
    /// Rates at the stages.
    rates: [Y; STAGES],
    place: Y,
    /// The last step as a polynomial, which predicts the next.
    predictor: Option<Dense<Y>>,
    /// Step for which the linear part is factored.
    factored: f64,
    arithmetic: PhantomData<R>,
}

/// Iterations of the stages, at most.
const ITERATIONS: usize = 16;
/// The iteration ends when what is left of it is below this share of the error allowed.
const CONVERGED: f64 = 1e-3;
/// Caution, and the limits of one change of the step.
const CAUTION: f64 = 0.9;
const SHRINK: f64 = 0.2;
const GROW: f64 = 5.0;
/// Steps that would grow by less are kept, and with them the factorisation.
const WORTHWHILE: f64 = 1.15;
/// Order of the error estimate plus one.
const ORDER: f64 = 8.0;

/// How an attempt at the stages ended.
enum Stages {
    Found,
    Slow,
    NotFinite,
}

impl<S: Stiff<Y>, Y: State, R: Arithmetic> Radau<S, Y, R> {
    /// Starts at a state with a first step (s), and with the error allowed per step in each component.
    pub fn new(system: S, t: f64, y: Y, allowed: Y, h: f64) -> Self {
        let zero = y.zeroed();
        let list = || std::array::from_fn(|_| zero.clone());
        let mut solver = Self {
            system,
            t,
            carry: zero.clone(),
            allowed,
            h,
            work: Work::default(),
            last: (t, 0.0),
            start: y.clone(),
            rate: zero.clone(),
            changes: list(),
            rates: list(),
            place: zero.clone(),
            predictor: None,
            factored: 0.0,
            arithmetic: PhantomData,
            y,
        };
        solver.evaluate_end();
        solver
    }

    /// The system followed.
    pub fn system(&self) -> &S {
        &self.system
    }

    /// Step that the method would make next.
    pub fn h(&self) -> f64 {
        self.h
    }

    fn evaluate_end(&mut self) {
        self.system.rate::<R>(self.t, &self.y, &mut self.rate);
        self.work.evaluations += 1;
    }

    fn factor(&mut self, h: f64) {
        if self.factored != h {
            self.system.shift(GAMMA.map(|[re, im]| [re / h, im / h]));
            self.factored = h;
            self.work.factorizations += 1;
        }
    }

    /// First guess of the stages: the last step continued.
    fn predict(&mut self, h: f64) {
        for (change, c) in self.changes.iter_mut().zip(C) {
            match &self.predictor {
                Some(dense) => {
                    change.clone_from(&dense.at(self.t + c * h));
                    for (change, y) in change.as_mut().iter_mut().zip(self.y.as_ref()) {
                        *change -= y;
                    }
                }
                None => change.as_mut().fill(0.0),
            }
        }
    }

    /// Finds the stages of a step.
    fn find_stages(&mut self, h: f64) -> Stages {
        self.predict(h);
        let mut before = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            self.evaluate_stages(h);
            let moved = self.improve(h);
            if !moved.is_finite() {
                return Stages::NotFinite;
            }
            let ratio = moved / before;
            if iteration > 0 && ratio < 1.0 && moved * ratio / (1.0 - ratio) < CONVERGED {
                return Stages::Found;
            }
            if iteration > 1 && ratio >= 1.0 {
                return if moved < 1.0 { Stages::Found } else { Stages::Slow };
            }
            let left = (ITERATIONS - iteration) as f64;
            if iteration > 2 && moved * ratio.powf(left) > CONVERGED {
                return Stages::Slow;
            }
            before = moved;
        }
        Stages::Slow
    }

    fn evaluate_stages(&mut self, h: f64) {
        for stage in 0..STAGES {
            self.place.clone_from(&self.y);
            for (place, change) in self.place.as_mut().iter_mut().zip(self.changes[stage].as_ref()) {
                *place += change;
            }
            self.system.rate::<R>(self.t + C[stage] * h, &self.place, &mut self.rates[stage]);
        }
        self.work.evaluations += STAGES as u64;
    }

    /// Improves the stages once; how far they moved, in units of the error allowed.
    fn improve(&mut self, h: f64) -> f64 {
        let stiff = self.system.stiff();
        let (mut moved, zero) = (0.0_f64, self.y.zeroed());
        let mut next: [Y; STAGES] = std::array::from_fn(|_| zero.clone());
        for (stage, next) in next.iter_mut().enumerate() {
            next.combine::<R>(&zero, h, &A[stage], &self.rates);
        }
        for (shift, right) in self.defects(h).iter_mut().enumerate() {
            self.system.solve(shift, right);
            for (stage, next) in next.iter_mut().enumerate() {
                let [re, im] = FROM_EIGEN[shift][stage];
                for (i, [x, y]) in stiff.clone().zip(right.iter()) {
                    let sum = if shift == 0 { self.changes[stage].as_ref()[i] } else { next.as_ref()[i] };
                    next.as_mut()[i] = sum + re * x - im * y;
                }
            }
        }
        for (next, change) in next.iter().zip(&mut self.changes) {
            let entries = next.as_ref().iter().zip(change.as_ref()).zip(self.allowed.as_ref());
            for ((next, change), allowed) in entries {
                if !next.is_finite() {
                    return f64::NAN;
                }
                moved = moved.max(((next - change) / allowed).abs());
            }
            change.clone_from(next);
        }
        moved
    }

    /// What the stiff components lack of the equations of the stages, one list per shift; a complex one counts twice.
    fn defects(&mut self, h: f64) -> [Vec<[f64; 2]>; SHIFTS] {
        let stiff = self.system.stiff();
        let mut lists: [Vec<[f64; 2]>; SHIFTS] = std::array::from_fn(|_| vec![[0.0; 2]; stiff.len()]);
        for stage in 0..STAGES {
            for (place, i) in stiff.clone().enumerate() {
                let slope: f64 = (0..STAGES).map(|j| INVERSE[stage][j] * self.changes[j].as_ref()[i]).sum();
                let defect = self.rates[stage].as_ref()[i] - slope / h;
                for (shift, list) in lists.iter_mut().enumerate() {
                    let twice = if shift == 0 { 1.0 } else { 2.0 };
                    let [re, im] = TO_EIGEN[shift][stage];
                    list[place][0] += twice * re * defect;
                    list[place][1] += twice * im * defect;
                }
            }
        }
        lists
    }

    /// Error estimate of the step in units of the error allowed, smoothed by the linear part.
    fn error(&mut self, h: f64) -> f64 {
        let mut error = self.y.zeroed();
        error.combine::<R>(&self.y.zeroed(), h, &ERROR, &self.rates);
        for (error, rate) in error.as_mut().iter_mut().zip(self.rate.as_ref()) {
            *error += START * h * rate;
        }
        let stiff = self.system.stiff();
        let mut smoothed: Vec<_> = error.as_ref()[stiff.clone()].iter().map(|e| [e / (START * h), 0.0]).collect();
        self.system.solve(0, &mut smoothed);
        for (error, [smooth, _]) in error.as_mut()[stiff].iter_mut().zip(smoothed) {
            *error = smooth;
        }
        let scaled = error.as_ref().iter().zip(self.allowed.as_ref()).map(|(error, allowed)| error / allowed);
        scaled.fold(0.0, |sum, part| sum + part * part).sqrt()
    }

    fn accept(&mut self, h: f64, t: f64) {
        self.last = (self.t, h);
        self.start.clone_from(&self.y);
        let change = self.changes[STAGES - 1].clone();
        accumulate(&mut self.y, &mut self.carry, &change);
        self.t = t;
        self.work.steps += 1;
        self.work.implicit_steps += 1;
        self.predictor = Some(self.polynomial());
        self.evaluate_end();
    }

    fn polynomial(&self) -> Dense<Y> {
        let (t, h) = self.last;
        let zero = self.y.zeroed();
        let mut coefficients: [Y; POWERS] = std::array::from_fn(|_| zero.clone());
        for (row, weights) in coefficients.iter_mut().zip(&SPLIT) {
            row.combine::<R>(&zero, 1.0, weights, &self.changes);
        }
        Dense { t, h, y: self.start.clone(), coefficients }
    }
}

impl<S: Stiff<Y>, Y: State, R: Arithmetic> Solver for Radau<S, Y, R> {
    type State = Y;

    fn t(&self) -> f64 {
        self.t
    }

    fn y(&self) -> &Y {
        &self.y
    }

    fn work(&self) -> Work {
        self.work
    }

    fn step(&mut self, end: f64) -> Result<(), StepError> {
        let mut rejected = false;
        let mut undefined = self.rate.as_ref().iter().any(|rate| !rate.is_finite());
        loop {
            let remaining = end - self.t;
            let reaches = self.h >= 0.999_999 * remaining;
            let h = if reaches { remaining } else { self.h };
            if !(h > f64::EPSILON * self.t.abs()) {
                return Err(StepError::at(self.t, undefined));
            }
            self.factor(h);
            let stages = self.find_stages(h);
            undefined = matches!(stages, Stages::NotFinite);
            if !matches!(stages, Stages::Found) {
                self.h = 0.5 * h;
                self.work.rejected += 1;
                rejected = true;
                continue;
            }
            let error = self.error(h).max(f64::MIN_POSITIVE);
            let factor = (CAUTION * error.powf(-1.0 / ORDER)).clamp(SHRINK, GROW);
            if error <= 1.0 {
                let growth = if rejected { factor.min(1.0) } else { factor };
                let kept = if (1.0..WORTHWHILE).contains(&growth) { 1.0 } else { growth };
                self.h = if reaches { self.h.max(h * kept) } else { h * kept };
                self.accept(h, if reaches { end } else { self.t + h });
                return Ok(());
            }
            self.h = h * factor;
            self.work.rejected += 1;
            rejected = true;
        }
    }

    fn dense(&mut self) -> Dense<Y> {
        self.polynomial()
    }

    fn correct(&mut self, change: &Y) {
        accumulate(&mut self.y, &mut self.carry, change);
    }

    fn rewind(&mut self, t: f64, y: Y) {
        self.t = t;
        self.y = y;
        self.carry.as_mut().fill(0.0);
        self.predictor = None;
        self.evaluate_end();
    }
}
