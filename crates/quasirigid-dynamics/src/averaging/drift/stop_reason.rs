//! Result of a drift: states at the output times, passages through the separatrix, and the reason of the end.
//! An end before the last time is a result, not an error, so that a caller keeps the states reached; the texts tell a user how to go on.

use std::fmt;

use super::{DriftState, SeparatrixPassage};
use crate::math::ode::StepError;

/// A drift as it was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct DriftHistory {
    /// States at the output times up to the end.
    pub states: Vec<DriftState>,
    /// State at the end, located to rounding, independently of the output times.
    pub end: DriftState,
    /// Reason of the end.
    pub ending: DriftStopReason,
    /// Passages through the separatrix, in their order.
    pub passages: Vec<SeparatrixPassage>,
    /// Time (s) at which the wobble first died out; none if it did not, or if the start has no wobble.
    pub died_out: Option<f64>,
    /// Steps of the integration.
    pub steps: u64,
}

/// Reason why a drift ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DriftStopReason {
    /// The last time was reached.
    Finished,
    /// The target was reached.
    Target,
    /// The separatrix was reached, and every region leads back to it.
    Held,
    /// The angular momentum fell to the share of its start that counts as rest.
    Rest {
        /// That share.
        share: f64,
    },
    /// The body spins as fast as the average allows.
    SpunUp {
        /// Rate of the body about the angular momentum (rad/s).
        rate: f64,
    },
    /// The body rotates so slowly that the magnetic field turns too much in one revolution.
    SlowedDown {
        /// Rate of the body about the angular momentum (rad/s).
        rate: f64,
    },
    /// The steps allowed were used up.
    StepLimit {
        /// Number of steps.
        steps: u64,
    },
    /// The caller asked for an end.
    Interrupted,
    /// No step could be made.
    Failed(StepError),
}

impl DriftStopReason {
    /// Tells whether the drift reached the last time or the target.
    #[must_use]
    pub fn done(&self) -> bool {
        matches!(self, Self::Finished | Self::Target)
    }

    /// Stop reason in a word: `finished`, `held`, `rest`, `spun-up`, `slowed`, `step-limit`, `interrupted`, `failed`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Finished | Self::Target => "finished",
            Self::Held => "held",
            Self::Rest { .. } => "rest",
            Self::SpunUp { .. } => "spun-up",
            Self::SlowedDown { .. } => "slowed",
            Self::StepLimit { .. } => "step-limit",
            Self::Interrupted => "interrupted",
            Self::Failed(_) => "failed",
        }
    }
}

impl fmt::Display for DriftStopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finished => f.write_str("the time asked for is over"),
            Self::Target => f.write_str("the target is reached"),
            Self::Held => f.write_str(
                "the rotation is held at the separatrix: it is driven there from every side, and keeps changing between \
                 circling the axis of least and that of greatest inertia; nothing that an average could follow is left",
            ),
            Self::Rest { share } => write!(
                f,
                "the angular momentum has fallen to {share:e} of its start: the body is all but at rest, and the average over \
                 its rotation ends; what follows depends on torques that do not vanish with the spin"
            ),
            Self::SpunUp { rate } => write!(
                f,
                "the torque has spun the body up to {rate:.3e} rad/s, the slowest elastic frequency: from there on neither the \
                 frozen body nor the average holds"
            ),
            Self::SlowedDown { rate } => write!(
                f,
                "the body has slowed to {rate:.3e} rad/s, ten times the rate at which the magnetic field turns along the orbit: from there on the \
                 average over its rotation does not hold; `simulate` follows the rotation"
            ),
            Self::StepLimit { steps } => write!(
                f,
                "the limit of {steps} integration steps was reached: the drift changes too often for an average over so long a time"
            ),
            Self::Interrupted => f.write_str("interrupted"),
            Self::Failed(StepError::TooSmall { .. } | StepError::Crawls { .. }) => f.write_str(
                "no step could be made: the rates change within the resolution of time; is a torque so strong that it acts in \
                 one turn? `simulate` follows that",
            ),
            Self::Failed(StepError::NotFinite { .. }) => f.write_str(
                "no step could be made: the mean power or the torque is not finite there; look for values in the model \
                 that are many orders of magnitude from the others",
            ),
        }
    }
}
