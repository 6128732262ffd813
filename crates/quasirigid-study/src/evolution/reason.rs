//! Reasons why an evolution has no answer, as data; [`refusals`](super::refusals) says them.

use quasirigid::averaging::{LevelError, Way};
use quasirigid::dynamics::PropagateError;
use quasirigid::model::Mode;
use quasirigid::modes::{EquilibriumError, ModesError, SpinMode};
use quasirigid::reduction::ReductionError;
use quasirigid::secular::{AverageCriteria, DirectStopReason, MeasureError};
use quasirigid::submanifold::SubmanifoldError;

use crate::error::StudyError;

/// Reason why no method leads to an answer. Wobbles are angles (rad) from the steady spin.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Material that is no solid in this motion, in words. (G16)
    NoSolid(String),
    /// Liquids whose response is not known about an axis, in words.
    UnknownLiquids(String),
    /// Momentum wheel whose speed changes, so that its motor works on the body.
    ChangingWheel,
    /// Relative equilibrium that was not found at the angular momentum of the start.
    Equilibrium(EquilibriumError),
    /// Modes that were not found about the axes of least and of greatest inertia.
    Modes(ModesError),
    /// Modes that were not found about the steady spin of a body with momentum wheels.
    AttractorModes(ModesError),
    /// Steady spin of least energy of a body with momentum wheels that was not found.
    NoAttractor,
    /// Instability of a steady spin.
    Unstable(Instability),
    /// Losses that the equations of motion leave out, as a share of the rate of a small wobble; infinite where it is not known.
    LossesLeftOut { share: f64 },
    /// Criteria of the average under a torque, which do not hold.
    AverageUnderTorque(AverageCriteria),
    /// Rate of a small wobble at an end of the way that is unknown or not positive.
    NoRateOfModes,
    /// Relative error of the average at the axis, for a wobble too wide for the modes.
    TooWideForModes { error: f64, wobble: f64 },
    /// Wobble too wide for the response of a liquid that spins.
    TooWideForLiquids { wobble: f64 },
    /// Wobble of a body with momentum wheels wider than the widest for which the modes alone are followed.
    TooWideForNutation { widest: f64 },
    /// Rate of the nutation of a body with momentum wheels that is unknown or not positive.
    NoRateOfNutation,
    /// Ratio `D/I₃` as the target of level curves.
    RatioOfLevels,
    /// Level curves of the slow energy of a body that has none, or spins too fast for them.
    NotOnLevels,
    /// Level curves of the slow energy that cannot be followed.
    Levels(LevelError),
    /// Separatrix of level curves, at a time (s).
    Separatrix { t: f64 },
    /// Separatrix of a body with momentum wheels, at a time (s), with the ways behind it.
    Ways { t: f64, ways: Vec<Way> },
    /// Power of zero on level curves.
    Lossless,
    /// Power of zero on level curves, for a body with momentum wheels.
    LosslessWithWheels,
    /// Reduced equations about a spin that were not found.
    Submanifold(SubmanifoldError),
    /// Reduced equations about a spin, between two axes.
    ManifoldBetweenAxes,
    /// Reduced equations about a spin, beyond a separatrix or for more coordinates than are tried unasked.
    ManifoldThroughSeparatrix,
    /// Reduced equations about a spin that do not hold at the wobble of the start.
    BeyondManifold { wobble: f64 },
    /// Reduced equations about the spin of a body with momentum wheels that do not hold at the wobble of the start.
    BeyondManifoldWithWheels,
    /// Reduced equations about the spin of a body with momentum wheels that do not lead to the end.
    ManifoldWithoutEnd,
    /// Mean power in short runs of the full system that was not measured.
    Measured(MeasureError),
    /// Short runs of the full system, of a body with momentum wheels.
    ShortRunsWithWheels,
    /// Energy of the full system that falls to the target within a revolution, after a time (s).
    WithinRevolution { t: f64 },
    /// Full system that was followed for a time (s) and some revolutions, but not to the end.
    Unfinished { t: f64, revolutions: f64, ending: DirectStopReason, instability: Option<Instability> },
    /// Full system with momentum wheels that was followed for a time (s), but not to the end; its failure in words, or the limit of steps.
    UnfinishedWithWheels { t: f64, failure: Option<String> },
    /// Revolutions of the full system to the end, whose number the modes do not tell.
    UnknownRevolutions,
    /// Time to the end of a body with momentum wheels that the modes do not tell.
    UnknownDuration,
    /// Wall-clock time (s) that work would take, and the most that it may take unasked.
    TooLong { work: Work, seconds: f64, most: f64 },
    /// Wall-clock time (s) that was spent, the most that work takes unasked.
    Spent { seconds: f64 },
    /// Two reasons, of methods that were tried one after the other.
    Both(Box<[Reason; 2]>),
}

/// Instability of a steady spin: a mode that grows.
#[derive(Clone, Debug, PartialEq)]
pub struct Instability {
    /// Mode that circles the axis; none about the spin of least energy of a body with momentum wheels.
    pub about: Option<Mode>,
    /// Name of the mode that grows.
    pub name: String,
    /// Decay rate (1/s), below zero.
    pub decay_rate: f64,
}

impl Instability {
    pub fn new(about: Option<Mode>, mode: &SpinMode) -> Self {
        Self { about, name: mode.name.clone(), decay_rate: mode.decay_rate }
    }
}

/// Work in the full system that may take long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Short runs that measure the mean power.
    ShortRuns,
    /// History from start to end.
    History,
}

/// End of a choice without a method.
#[derive(Debug)]
pub enum Stop {
    /// No method leads to an answer.
    Refused(Reason),
    /// The choice itself failed.
    Failed(StudyError),
}

impl Stop {
    /// Reason of a refusal.
    ///
    /// # Errors
    /// The [`StudyError`] of a choice that failed.
    pub fn reason(self) -> Result<Reason, StudyError> {
        match self {
            Self::Refused(reason) => Ok(reason),
            Self::Failed(error) => Err(error),
        }
    }
}

impl From<Reason> for Stop {
    fn from(reason: Reason) -> Self {
        Self::Refused(reason)
    }
}

impl From<StudyError> for Stop {
    fn from(error: StudyError) -> Self {
        Self::Failed(error)
    }
}

impl From<PropagateError> for Stop {
    fn from(error: PropagateError) -> Self {
        Self::Failed(error.into())
    }
}

impl From<ReductionError> for Stop {
    fn from(error: ReductionError) -> Self {
        Self::Failed(error.into())
    }
}

impl From<MeasureError> for Stop {
    fn from(error: MeasureError) -> Self {
        match error {
            MeasureError::Interrupted => Self::Failed(StudyError::Interrupted),
            error => Self::Refused(Reason::Measured(error)),
        }
    }
}
