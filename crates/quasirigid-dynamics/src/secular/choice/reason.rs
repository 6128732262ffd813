//! Reasons of a choice, as data: why a method does not hold or gives no answer.

use crate::averaging::{LevelError, Way};
use crate::model::Mode;
use crate::modes::{EquilibriumError, ModesError, SpinMode};
use crate::secular::{AverageCriteria, DirectStopReason, MeasureError};
use crate::submanifold::SubmanifoldError;

/// Reason why a method, or every method, leads to no answer. Wobbles are angles (rad) from the steady spin.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Relative equilibrium that was not found at the angular momentum of the start.
    Equilibrium(EquilibriumError),
    /// Modes that were not found about the steady spins.
    Modes(ModesError),
    /// Steady spin of least energy of a body with momentum wheels that was not found.
    NoAttractor,
    /// Steady spin that is unstable.
    Unstable(Instability),
    /// Liquids whose response is not known about a steady spin of the evolution.
    UnknownLiquidResponse(Vec<UnknownLiquid>),
    /// Losses that the equations of motion leave out.
    LossesLeftOut {
        /// Share of the rate of a small wobble; infinite where it is not known.
        share: f64,
    },
    /// Average whose criteria fail.
    AverageFails(AverageCriteria),
    /// Average of which the case of a method that was asked for has no response or equations: in the spinning frame, on level curves.
    NotPrepared,
    /// Average under a torque whose criteria fail.
    AverageUnderTorque(AverageCriteria),
    /// Rate of a small wobble at an end of the evolution that is unknown or not positive.
    NoModalRate,
    /// Average that is off at the axis, for a wobble too wide for the modes.
    TooWideForModes {
        /// Relative error at the axis.
        error: f64,
        /// Widest wobble.
        wobble: f64,
    },
    /// Wobble too wide for the response of a liquid that spins.
    TooWideForLiquids {
        /// Widest wobble (rad); none on a way through the separatrix.
        wobble: Option<f64>,
    },
    /// Wobble of a body with momentum wheels that is too wide for the rate of its nutation.
    TooWideForNutation {
        /// Widest wobble that is followed at this rate.
        widest: f64,
    },
    /// Level curves whose end is given by a ratio `D/I₃`.
    RatioOfLevels,
    /// Level curves of a body that has none, or spins too fast for them.
    NotOnLevels,
    /// Level curves that cannot be followed.
    Levels(LevelError),
    /// Level curves whose error is too large.
    LevelsFail {
        /// Bound of the relative error of the time.
        error: f64,
    },
    /// Separatrix of the level curves, behind which the phase chooses the way.
    Separatrix {
        /// Time (s).
        t: f64,
        /// Ways behind it, where they are known.
        ways: Vec<Way>,
    },
    /// Power of zero on level curves.
    Lossless,
    /// Reduced equations about a spin that were not found.
    Submanifold(SubmanifoldError),
    /// Reduced equations about a spin, between two axes or through a separatrix.
    ManifoldThroughSeparatrix,
    /// Reduced equations about a spin that do not hold at the start.
    BeyondManifold {
        /// Wobble of the start.
        wobble: f64,
    },
    /// Reduced equations about a spin that do not lead to the end.
    ManifoldWithoutEnd,
    /// Reduced equations about a spin that take longer than this work (s) to follow.
    LongManifold {
        /// Time of work (s).
        seconds: f64,
    },
    /// Mean power in short runs that was not measured.
    Measured(MeasureError),
    /// Short runs of a body with momentum wheels.
    ShortRunsWithWheels,
    /// Energy of the full system that falls to the target within a revolution.
    WithinRevolution {
        /// Time (s).
        t: f64,
    },
    /// Full system that was followed, but not to the end.
    Unfinished {
        /// Time (s).
        t: f64,
        /// Revolutions.
        revolutions: f64,
        /// Reason of the end.
        ending: DirectStopReason,
        /// Instability of a steady spin on the way.
        instability: Option<Instability>,
    },
    /// Length of a history of the full system that the modes do not tell.
    UnknownLength,
    /// Body that dissipates nothing.
    NothingDissipated,
    /// Work that would take too long unasked.
    TooLong {
        /// Work.
        work: Work,
        /// Wall-clock time (s) that it would take.
        seconds: f64,
        /// Wall-clock time (s) that the choice has taken before.
        spent: f64,
        /// Longest wall-clock time (s) that is worked unasked.
        most: f64,
    },
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
    /// Instability by a mode about an axis.
    #[must_use]
    pub fn new(about: Option<Mode>, mode: &SpinMode) -> Self {
        Self { about, name: mode.name.clone(), decay_rate: mode.decay_rate }
    }
}

/// Liquid whose response about a steady spin is not known.
#[derive(Clone, Debug, PartialEq)]
pub struct UnknownLiquid {
    /// Name of its cavity.
    pub cavity: String,
    /// Reynolds number at the spin.
    pub reynolds: f64,
}

/// Work in the full system that may take long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Short runs that measure the mean power.
    ShortRuns,
    /// History from start to end.
    History,
}
