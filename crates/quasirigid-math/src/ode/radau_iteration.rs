//! The two iterations for the stages of the Radau IIA method: stage after stage, and side by side in lanes where the system can evaluate its
//! rates so.

use std::ops::Range;

use super::Checkpoint;
use super::radau_lanes::LaneStages;
use super::radau_search::{Attempt, Search};
use super::radau_stages::Stages;
use super::radau_tableau::{ERROR, START};
use super::stiff::Stiff;
use crate::simd::{Arithmetic, Rounding};

/// Iteration for the stages of a step.
#[derive(Clone, Debug)]
pub(super) enum Iteration {
    /// Each stage with the newest rates of the others.
    InTurn(Stages),
    /// All stages at once.
    Beside(LaneStages),
}

/// How the length of a step follows an iteration.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    /// Factors of the step that are not worth a new factorisation: the step stays.
    pub kept: Range<f64>,
    /// Ratio of consecutive corrections of the stages up to which longer steps pay.
    pub contraction: f64,
    /// Limit of one growth of the step.
    pub grow: f64,
    /// Steps after stages that were not found in which the step does not grow.
    pub rest: u32,
}

/// Calls a method of the iteration in use.
macro_rules! either {
    ($self:expr, $stages:ident => $call:expr) => {
        match $self {
            Iteration::InTurn($stages) => $call,
            Iteration::Beside($stages) => $call,
        }
    };
}

impl Iteration {
    /// Iteration for a system with so many components.
    pub fn new(system: &impl Stiff, components: usize, rounding: Rounding) -> Self {
        match system.steering() {
            None => Self::InTurn(Stages::new(components, system.stiff())),
            Some(steering) => Self::Beside(LaneStages::new(components, steering, system.stiff(), rounding)),
        }
    }

    /// How the length of a step follows.
    ///
    /// In lanes a factorisation costs as much as two dozen sweeps, and a few sweeps more cost less than a shorter step.
    pub fn pace(&self) -> Pace {
        match self {
            Self::InTurn(_) => Pace { kept: 0.93..1.2, contraction: 0.12, grow: 5.0, rest: 0 },
            Self::Beside(_) => Pace { kept: 0.93..1.5, contraction: 0.2, grow: 5.0, rest: 8 },
        }
    }

    /// Sweeps over the stages so far.
    pub fn sweeps(&self) -> u64 {
        either!(self, stages => stages.sweeps)
    }

    /// First guess: nothing changes.
    pub fn guess_still(&mut self, rate: &[f64]) {
        either!(self, stages => stages.guess_still(rate));
    }

    /// First guess: the last steps continue over one that is `ratio` times as long as the last.
    pub fn guess_continued(&mut self, ratio: f64) {
        either!(self, stages => stages.guess_continued(ratio));
    }

    /// Takes over the factors of the linear part.
    pub fn factor(&mut self, system: &mut impl Stiff) {
        if let Self::Beside(stages) = self {
            stages.factor(system);
        }
    }

    /// Improves the guess until it satisfies the equations of the stages.
    pub fn find<S: Stiff, R: Arithmetic>(&mut self, system: &mut S, attempt: Attempt) -> Search {
        match self {
            Self::InTurn(stages) => stages.find::<S, R>(system, attempt),
            Self::Beside(stages) => stages.find(system, attempt),
        }
    }

    /// Error estimate of the step, before the filter, from its rates and the rate at its start.
    pub fn error(&self, h: f64, start: &[f64], error: &mut [f64]) {
        match self {
            Self::Beside(stages) => stages.error(h, error),
            Self::InTurn(stages) => {
                for (i, error) in error.iter_mut().enumerate() {
                    let rates = stages.rates.iter().zip(ERROR);
                    let sum: f64 = rates.map(|(rate, weight)| weight * rate[i]).sum();
                    *error = h * (sum + START * start[i]);
                }
            }
        }
    }

    /// Keeps the step for the guess of the next.
    pub fn keep(&mut self, rate: &[f64]) {
        match self {
            Self::InTurn(stages) => stages.keep(rate),
            Self::Beside(stages) => stages.keep(),
        }
    }

    /// Changes from the start of the step to a stage.
    pub fn changes(&self, stage: usize, h: f64) -> Vec<f64> {
        match self {
            Self::InTurn(stages) => stages.changes[stage].clone(),
            Self::Beside(stages) => stages.changes(stage, h),
        }
    }

    /// Writes the change from the start to the end of the step, and the rate there.
    pub fn end(&self, h: f64, change: &mut [f64], rate: &mut [f64]) {
        match self {
            Self::InTurn(stages) => {
                let ([.., changes], [.., rates]) = (&stages.changes, &stages.rates);
                change.copy_from_slice(changes);
                rate.copy_from_slice(rates);
            }
            Self::Beside(stages) => stages.end(h, change, rate),
        }
    }

    /// Saves the last steps, from which the next guess starts, and the count of sweeps.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        either!(self, stages => stages.save(checkpoint));
    }

    /// Loads saved steps.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        either!(self, stages => stages.load(checkpoint))
    }
}
