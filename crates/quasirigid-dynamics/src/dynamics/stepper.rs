//! What steppers of a body say after each step, and what they refuse.

use thiserror::Error;

use super::run::PropagateError;
use crate::math::ode::StepError;
use crate::model::Displaced;

/// Whether the equations hold where a step has led.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepStatus {
    /// They hold.
    Holds,
    /// Reduced equations: the spin is beyond the range in which they hold, and below that in which they fail.
    Marginal,
    /// Reduced equations: the spin is in the range in which they fail.
    Fails,
    /// Full equations: a part is displaced beyond the range of its paths.
    Left(Displaced),
}

/// A step that is not made; the state stays that of the step before.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StepperError {
    /// The length of the step is no positive number.
    #[error("a step of {dt} s is no positive length of time")]
    Step {
        /// Length of the step (s).
        dt: f64,
    },
    /// The torque is not finite.
    #[error("the torque [{}, {}, {}] N·m is not finite", torque[0], torque[1], torque[2])]
    Torque {
        /// Torque (N·m), body axes.
        torque: [f64; 3],
    },
    /// A force acts in windows or by a table.
    #[error(
        "the force {name:?} changes at given times, which steps of another length do not meet; leave it out of the model, and give its torque to the steps"
    )]
    Timed {
        /// Name of the force.
        name: String,
    },
    /// The law of a driven part may have corners, or change in a short time.
    #[error(
        "the law that drives {name:?} may have corners or change in a moment, which steps of another length do not meet; write it by sums and products of t, sines and cosines, or follow the body by a history"
    )]
    Cornered {
        /// Name of the part.
        name: String,
    },
    /// More sub-steps than are worked with are needed.
    #[error(
        "a step of {dt} s needs more than {MOST_SUBSTEPS} steps of the integrator; give shorter steps, or a looser tolerance"
    )]
    Long {
        /// Length of the step (s).
        dt: f64,
    },
    /// The start.
    #[error(transparent)]
    Start(#[from] PropagateError),
    /// The integrator.
    #[error(transparent)]
    Failed(#[from] StepError),
}

/// Steps of the integrator in one step from outside.
pub(super) const MOST_SUBSTEPS: usize = 100_000;

/// Refuses what no step takes.
pub(super) fn check(torque: [f64; 3], dt: f64) -> Result<(), StepperError> {
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(StepperError::Step { dt });
    }
    if torque.iter().any(|entry| !entry.is_finite()) {
        return Err(StepperError::Torque { torque });
    }
    Ok(())
}
