//! Interfaces of initial value problems: systems, solvers, dense output and errors of a step.
//! Solvers take the state as array or list and the arithmetic as a type, so that small systems compile to vector code without heap.

use std::ops::Add;

use thiserror::Error;

use super::{Checkpoint, StepRule, Stretch};
use crate::simd::{Arithmetic, Task, scaled_sum};

/// State of a system: a list of numbers, of a length known to the compiler or not.
pub trait State: Clone + AsRef<[f64]> + AsMut<[f64]> {
    /// Becomes `base + h Σ weight · stage`.
    fn combine<R: Arithmetic>(&mut self, base: &Self, h: f64, weights: &[f64], stages: &[Self]);

    /// A list of this length with every number zero.
    #[must_use]
    fn zeroed(&self) -> Self {
        let mut zero = self.clone();
        zero.as_mut().fill(0.0);
        zero
    }
}

impl<const N: usize> State for [f64; N] {
    #[inline(always)]
    fn combine<R: Arithmetic>(&mut self, base: &Self, h: f64, weights: &[f64], stages: &[Self]) {
        let mut sum = [0.0; N];
        for (weight, stage) in weights.iter().zip(stages) {
            sum = scaled_sum::<R, N>(*stage, *weight, sum);
        }
        *self = scaled_sum::<R, N>(sum, h, *base);
    }
}

impl State for Vec<f64> {
    #[inline(always)]
    fn combine<R: Arithmetic>(&mut self, base: &Self, h: f64, weights: &[f64], stages: &[Self]) {
        self.fill(0.0);
        for (weight, stage) in weights.iter().zip(stages).filter(|(weight, _)| **weight != 0.0) {
            for (sum, entry) in self.iter_mut().zip(stage) {
                *sum = R::mul_add(*entry, *weight, *sum);
            }
        }
        for (sum, base) in self.iter_mut().zip(base) {
            *sum = R::mul_add(*sum, h, *base);
        }
    }
}

/// A system `ẏ = rate(t, y)`.
pub trait System<Y> {
    /// Writes the rate of the state into `rate`.
    fn rate<R: Arithmetic>(&mut self, t: f64, y: &Y, rate: &mut Y);

    /// Told before a stretch of time between two breakpoints: rates asked for from then on are those inside it. (Z1)
    fn enter(&mut self, stretch: Stretch) {
        let _ = stretch;
    }
}

/// Rate of a system at the places where a method needs it.
///
/// A method needs it at half a dozen places; [`Arithmetic::call`] compiles a rate once for all of them, as it may be long.
pub(super) struct Rate<'a, S, Y> {
    pub system: &'a mut S,
    pub t: f64,
    pub y: &'a Y,
    pub rate: &'a mut Y,
}

impl<S: System<Y>, Y> Task for Rate<'_, S, Y> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arithmetic>(self) {
        self.system.rate::<A>(self.t, self.y, self.rate);
    }
}

/// Solver: a method that advances a system step by step.
pub trait Solver {
    /// State of the system.
    type State: State;

    /// Time reached.
    fn t(&self) -> f64;

    /// State reached.
    fn y(&self) -> &Self::State;

    /// Work done so far.
    fn work(&self) -> Work;

    /// Makes one step, not beyond `end`.
    ///
    /// # Errors
    /// [`StepError`] if no step can be made; the state is then the last good one.
    fn step(&mut self, end: f64) -> Result<(), StepError>;

    /// The solution over the last step.
    fn dense(&mut self) -> DenseOutput<Self::State>;

    /// The state at a time in the last step, whose dense output is given.
    fn output(&mut self, dense: &DenseOutput<Self::State>, t: f64) -> Self::State {
        dense.at(t)
    }

    /// Adds a small change to the state reached, as a projection on a known invariant does: no larger than the error
    /// of a step.
    fn correct(&mut self, change: &Self::State);

    /// Goes back to a state within the last step.
    fn rewind(&mut self, t: f64, y: Self::State);

    /// Goes on in another stretch from the state reached, as after [`load`](Self::load).
    fn enter(&mut self, stretch: Stretch);

    /// Begins anew from the state reached, at a breakpoint of the rate: nothing is carried over from before it. (Z1)
    fn restart(&mut self, stretch: Stretch);

    /// The last step as a rule of quadrature.
    fn rule(&self) -> StepRule;

    /// Saves what decides the next steps. Between steps alone.
    fn save(&self, checkpoint: &mut Checkpoint);

    /// Goes on from a checkpoint of a solver of the same system; none if it is of another.
    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()>;
}

/// Work done.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Evaluations of the rate.
    pub evaluations: u64,
    /// Factorisations of the linear part; none in an explicit method.
    pub factorizations: u64,
    /// Steps made by the implicit method.
    pub implicit_steps: u64,
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            rejected: self.rejected + other.rejected,
            evaluations: self.evaluations + other.evaluations,
            factorizations: self.factorizations + other.factorizations,
            implicit_steps: self.implicit_steps + other.implicit_steps,
        }
    }
}

/// A step that could not be made.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum StepError {
    /// The step fell to the rounding of `t`.
    #[error(
        "the step at t = {t} s fell below the resolution of time: the solution runs away, or the tolerance is too small"
    )]
    TooSmall {
        /// Time reached (s).
        t: f64,
    },
    /// The steps are so short that the end is out of reach.
    #[error(
        "at t = {t} s the steps fell to {step:.1e} s and stay there, so that the run would never end: a force that switches back at once whatever it changes does that; give the switch a width, as `0.5*(1 + tanh(x/width))`"
    )]
    Crawls {
        /// Time reached (s).
        t: f64,
        /// Mean of the last steps (s).
        step: f64,
    },
    /// The rate is NaN or infinite.
    #[error(
        "the rates of the system are not finite numbers beyond t = {t} s: look for a square root, logarithm or division in a force that fails there"
    )]
    NotFinite {
        /// Time reached (s).
        t: f64,
    },
}

impl StepError {
    /// Error of a step that has shrunk to nothing, with the rate undefined or not just beyond it.
    pub(super) fn at(t: f64, undefined: bool) -> Self {
        if undefined { Self::NotFinite { t } } else { Self::TooSmall { t } }
    }
}

/// The solution over a step, as a polynomial of degree 7 in time.
#[derive(Clone, Debug)]
pub struct DenseOutput<Y> {
    pub(super) t: f64,
    pub(super) h: f64,
    pub(super) y: Y,
    /// Factors of `x`, `x(1−x)`, `x²(1−x)`, `x²(1−x)²`, …
    pub(super) coefficients: [Y; POWERS],
}

/// Degree of the dense output.
pub(super) const POWERS: usize = 7;

impl<Y: State> DenseOutput<Y> {
    /// The state at a time in the step.
    #[must_use]
    pub fn at(&self, t: f64) -> Y {
        let x = (t - self.t) / self.h;
        let mut state = self.y.zeroed();
        for (power, row) in self.coefficients.iter().enumerate().rev() {
            let factor = if power % 2 == 0 { x } else { 1.0 - x };
            for (sum, entry) in state.as_mut().iter_mut().zip(row.as_ref()) {
                *sum = (*sum + entry) * factor;
            }
        }
        for (sum, start) in state.as_mut().iter_mut().zip(self.y.as_ref()) {
            *sum += start;
        }
        state
    }
}

/// Share of the rest from which on a step is made to reach the end.
pub(super) const REACH: f64 = 0.999_999;

/// Step of length `h` from `t`, or the rest until `end`, and whether it reaches `end`; `undefined` says whether the rate just beyond `t` is
/// undefined.
#[inline(always)]
pub(super) fn towards(end: f64, t: f64, h: f64, undefined: bool) -> Result<(f64, bool), StepError> {
    let remaining = end - t;
    let reaches = h >= REACH * remaining;
    let h = if reaches { remaining } else { h };
    if h > f64::EPSILON * t.abs() { Ok((h, reaches)) } else { Err(StepError::at(t, undefined)) }
}

/// Adds a change to a state kept in two parts, so that many small changes lose no digits: `carry` takes the rounding error of `y`.
#[inline(always)]
pub(super) fn accumulate<Y: State>(y: &mut Y, carry: &mut Y, change: &Y) {
    for ((y, carry), change) in y.as_mut().iter_mut().zip(carry.as_mut()).zip(change.as_ref()) {
        let change = change + *carry;
        let sum = *y + change;
        *carry = change - (sum - *y);
        *y = sum;
    }
}
