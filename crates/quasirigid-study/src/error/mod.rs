//! Errors of a study.

mod told;

use std::path::PathBuf;

use quasirigid::averaging::{FreeRotationError, ObservedError, Unaveraged};
use quasirigid::dynamics::{PropagateError, StepperError};
use quasirigid::elements::ElementError;
use quasirigid::model::DriveFault;
use quasirigid::modes::{CantileverError, EquilibriumError, LinearError, TruncationError};
use quasirigid::reduction::{ReductionError, ValidityError};
use quasirigid::submanifold::{ExpansionError, SubmanifoldError};
use quasirigid::verification::VerificationError;
use quasirigid_io::model::{BodyKind, ChangeError, ModelError};
use quasirigid_io::record::RecordError;
use quasirigid_math::eigen::NoConvergence;
use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

use crate::as_observed::Turned;
use crate::settings::{Setting, SettingError};
use crate::start::NoWobble;

/// A study that gives no answer. The text names settings by their keys; [`told`](Self::told) has other names for them.
#[derive(Debug, Error)]
#[error("{}", self.told(&Setting::key))]
#[non_exhaustive]
pub enum StudyError {
    /// The model file.
    Model(ModelError),
    /// The reduction.
    Reduction(ReductionError),
    /// The range of the reduced equations.
    Validity(ValidityError),
    /// The vibrations.
    Vibration(NoConvergence),
    /// A history.
    Propagate(PropagateError),
    /// The verification.
    Verification(VerificationError),
    /// The record.
    Record(RecordError),
    /// A torque over which no average is taken.
    Unaveraged(Unaveraged),
    /// A setting out of its range.
    Setting(SettingError),
    /// A body at rest without a duration: it has no revolutions to count by.
    RestWithoutDuration,
    /// A secular evolution that ends within its first revolution.
    WithinARevolution {
        /// Duration asked for (s).
        duration: f64,
        /// Time of a revolution of the start (s).
        revolution: f64,
    },
    /// No start is found.
    NoStart(EquilibriumError),
    /// A body or a state without a linear model.
    Linear(LinearError),
    /// A body without cantilever modes.
    Cantilever(CantileverError),
    /// Cantilever modes of a body without a carrier.
    NothingHeld,
    /// An input or output of a linear model that does not exist.
    NoChannel {
        /// Name asked for.
        name: String,
        /// What there is, in words.
        expected: String,
    },
    /// A key of a model to be varied that does not exist.
    Change(ChangeError),
    /// A key to be varied that is no number.
    NoNumber {
        /// Path of the key.
        key: String,
    },
    /// A quantity that the model does not have.
    NoQuantity {
        /// The quantity.
        name: String,
        /// The reason, in words.
        reason: String,
    },
    /// An answer without a certificate.
    Uncertified {
        /// The reason, in words.
        reason: String,
    },
    /// Keys and data from which nothing is inferred.
    Infer {
        /// The reason, in words.
        problem: String,
    },
    /// Tanks, fills and spins of which there is no map.
    FillMap {
        /// The reason, in words.
        problem: String,
    },
    /// A light curve that there is not.
    LightCurve {
        /// The reason, in words.
        problem: String,
    },
    /// A mean torque of sunlight that there is not.
    Yorp {
        /// The reason, in words.
        problem: String,
    },
    /// Threads that the system does not give.
    Threads {
        /// Number asked for.
        threads: usize,
        /// The reason of the system.
        cause: String,
    },
    /// A step that is not made.
    Step(StepperError),
    /// A number of states that a linear model cannot be truncated to.
    Truncation(TruncationError),
    /// A truncated linear model to be truncated.
    TruncatedAgain,
    /// Frequencies that are no band.
    NoBand {
        /// First frequency (rad/s).
        low: f64,
        /// Last frequency (rad/s).
        high: f64,
    },
    /// A body whose equations are more than those of a free body under a torque.
    NotExported {
        /// What stands against it and what to do, in words.
        what: String,
    },
    /// Controllers in an answer that does not have them.
    Controlled {
        /// Names of the controllers.
        names: Vec<String>,
        /// The answer.
        what: &'static str,
    },
    /// Hysteresis rods in an answer that does not have them. (Y11)
    Remembering {
        /// Names of the rods.
        names: Vec<String>,
        /// The answer.
        what: &'static str,
    },
    /// Liquids that slide along rings, in an answer that does not have them.
    Sliding {
        /// Names of their tanks.
        names: Vec<String>,
        /// The answer.
        what: &'static str,
    },
    /// Parts that drives move, in an answer that does not have them. (T7)
    Driven {
        /// Names of the parts.
        names: Vec<String>,
        /// The answer.
        what: &'static str,
    },
    /// A law that no drive follows. (T10)
    Drive {
        /// Name of the part.
        name: String,
        /// Fault of the law.
        fault: DriveFault,
    },
    /// Controllers without a linear model.
    NotLinear {
        /// Name of the controller.
        name: String,
        /// What stands against it and what to do, in words.
        what: &'static str,
    },
    /// Reduced equations of a body whose rotors or liquids the spin does not slave. (Q8)
    NoSlowSeries {
        /// The angular velocity of the start (rad/s).
        spin: f64,
    },
    /// A history that has no room.
    History {
        /// Number of rows.
        samples: usize,
        /// Memory that the history would take.
        cause: TooMuchMemory,
    },
    /// Coordinates of the rigid body, which has none.
    NoCoordinates {
        /// Setting that asks for coordinates.
        setting: Setting,
    },
    /// Spins without attitude, asked for a body under forces, or with events at which its histories end.
    SpinsAlone {
        /// Whether forces act.
        forces: bool,
    },
    /// The model has no initial rotation.
    NoSpin {
        /// File of the model.
        file: PathBuf,
    },
    /// Observed periods that no rotation has.
    Observed {
        /// File of the model.
        file: PathBuf,
        /// Cause.
        cause: ObservedError,
    },
    /// A ratio `D/I₃` that no rotation state has.
    NoRotationState {
        /// `D/I₃`.
        ratio: f64,
        /// Least ratio.
        least: f64,
    },
    /// A start about a principal axis, which does not evolve.
    Steady,
    /// A body that does not turn.
    AtRest,
    /// An energy that is not finite.
    BoundlessSpin,
    /// A body without an axis of greatest inertia.
    NoShortAxis {
        /// Principal moments (kg·m²), ascending.
        moments: [f64; 3],
    },
    /// A nutation that the body does not have.
    NoWobble {
        /// File of the model.
        file: PathBuf,
        /// Cause.
        cause: NoWobble,
    },
    /// A nutation, or periods, of a body that owes its axis to the bulge of its spin.
    Turned {
        /// File of the model.
        file: PathBuf,
        /// The moments with and without the spin.
        cause: Box<Turned>,
    },
    /// A nutation whose angle is out of range.
    Nutation {
        /// Angle (rad).
        angle: f64,
    },
    /// A rotation that no rigid body makes.
    FreeRotation(FreeRotationError),
    /// A target behind the start.
    Backwards {
        /// Start, `D/I₃`.
        from: f64,
        /// Target.
        to: f64,
    },
    /// No end of an evolution under a torque.
    NoEvolutionDuration,
    /// A body whose three principal moments are equal.
    EqualMoments {
        /// The moment (kg·m²).
        moment: f64,
    },
    /// A body whose three principal moments are equal, under a torque that is not the same about every axis.
    NoAxes {
        /// The moment (kg·m²).
        moment: f64,
    },
    /// Eddy currents too strong for an average.
    FastEddyCurrents {
        /// Bound on the rate (1/s) at which they change the rotation.
        rate: f64,
        /// Rate (rad/s) that is averaged over.
        against: f64,
        /// Whether that is one of the magnetic field, not of the body.
        of_field: bool,
    },
    /// A path past a centre of attraction that comes nearer than the body is large.
    Engulfed {
        /// Name of the force.
        name: String,
        /// Largest semi-axis (m) of the ellipsoid with the moments of the body.
        size: f64,
        /// Least distance (m).
        nearest: f64,
    },
    /// Eddy currents whose own field is not small.
    SkinEffect {
        /// Name of the force.
        name: String,
        /// The angular velocity of the start (rad/s).
        spin: f64,
        /// Share of the torque that the field of the currents takes.
        share: f64,
        /// Angular velocity (rad/s) up to which the torque holds.
        fastest: f64,
    },
    /// A target of more nutation than the start has.
    Calmer {
        /// Nutation at the start (rad).
        from: f64,
        /// Target (rad).
        to: f64,
        /// Kind of the body.
        kind: BodyKind,
    },
    /// A driven pole.
    DrivenPole,
    /// Request that has no meaning for a body with momentum wheels.
    Wheels {
        /// What holds instead.
        what: &'static str,
    },
    /// A body at one end of the ranges of the materials.
    Extreme {
        /// Error of the element.
        cause: Box<ElementError>,
    },
    /// A principal axis of a body that moments act on.
    AxisUnderForces,
    /// Reduced equations about a spin that were not found.
    Submanifold(SubmanifoldError),
    /// Reduced equations about a spin of a body on which forces act.
    ForcesAboutSpin {
        /// Names of the forces.
        names: Vec<String>,
    },
    /// Reduced equations about the axis of middle inertia.
    MiddleAxis {
        /// Kind of the body.
        kind: BodyKind,
    },
    /// Events in a history by the reduced equations about a spin.
    EventsAboutSpin,
    /// A steady spin that displaces a part beyond the range of its paths.
    SteadySpinBeyond {
        /// The part and its displacement, in words.
        what: String,
    },
    /// A master asked for that no mode about the spin is.
    NoMaster {
        /// Frequency asked for (rad/s).
        frequency: f64,
        /// Names and frequencies (rad/s) of the modes, nearest first.
        modes: Vec<(String, f64)>,
        /// Kind of the body.
        kind: BodyKind,
    },
    /// A file that cannot be written.
    Write {
        /// The file.
        path: PathBuf,
        /// Cause.
        cause: std::io::Error,
    },
    /// A run in work that cannot be started or gone on with.
    KeptRun {
        /// Folder of the run in work.
        folder: PathBuf,
        /// Reason.
        problem: &'static str,
    },
    /// Work that was told to end.
    Interrupted,
}

impl StudyError {
    /// Whether the slow series has no motion to start from, of which the full system knows nothing.
    pub(crate) fn is_of_the_series(&self) -> bool {
        matches!(self, Self::NoSlowSeries { .. } | Self::Propagate(PropagateError::NoAngularMomentum))
    }
}

impl From<SubmanifoldError> for StudyError {
    fn from(cause: SubmanifoldError) -> Self {
        match cause {
            SubmanifoldError::Expansion(ExpansionError::Interrupted) => Self::Interrupted,
            cause => Self::Submanifold(cause),
        }
    }
}

impl From<FreeRotationError> for StudyError {
    fn from(cause: FreeRotationError) -> Self {
        match cause {
            FreeRotationError::Nutation { nutation } => Self::Nutation { angle: nutation },
            cause => Self::FreeRotation(cause),
        }
    }
}
