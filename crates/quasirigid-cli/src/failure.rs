use std::path::PathBuf;

use quasirigid::averaging::{ObservedError, Unaveraged};
use quasirigid::dynamics::PropagateError;
use quasirigid::elements::ElementError;
use quasirigid::math::eigen::NoConvergence;
use quasirigid::math::memory::TooMuchMemory;
use quasirigid::modes::EquilibriumError;
use quasirigid::reduction::{ReductionError, ValidityError};
use quasirigid::verification::VerificationError;
use quasirigid_io::model::{ModelError, TargetError};
use quasirigid_io::record::RecordError;
use quasirigid_io::units::UnitError;
use thiserror::Error;

use crate::describe::significant;
use crate::rotation::NoWobble;

/// Why a command could not run.
#[derive(Debug, Error)]
pub enum Failure {
    #[error(transparent)]
    Model(#[from] ModelError),
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    #[error(transparent)]
    Validity(#[from] ValidityError),
    #[error(transparent)]
    Vibration(#[from] NoConvergence),
    #[error(transparent)]
    Propagate(#[from] PropagateError),
    #[error(transparent)]
    Verification(#[from] VerificationError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error("--duration {text}: {cause}; {advice}", advice = cause.advice())]
    Duration { text: String, cause: Box<UnitError> },
    #[error("--duration {seconds} s is not a duration; give one above zero, such as \"2 h\"")]
    NoDuration { seconds: f64 },
    #[error(
        "the start: {0}; the slow manifold has no meaning at this spin; give [initial] displacements = \"rest\", or numbers"
    )]
    NoStart(EquilibriumError),
    #[error(
        "--axis names a principal axis of a body that no moment acts on; under forces give --spin, or nothing"
    )]
    AxisUnderForces,
    #[error("an angular velocity has three components, not {count}: --spin 0,0,1.5")]
    NotAVector { count: usize },
    #[error("--samples {samples} is out of range; give 2 to 10000000")]
    Samples { samples: usize },
    #[error("{samples} rows: {cause}; ask for fewer with --samples")]
    History { samples: usize, cause: TooMuchMemory },
    #[error("{option}: the rigid body has no internal coordinates; take --system reduced or --system full")]
    NoCoordinates { option: &'static str },
    #[error("{file}: the model has no initial spin; add a table such as\n\n    [initial]\n    angular_velocity = [0.0, 0.1, 1.0]   # rad/s, body axes\n", file = file.display())]
    NoSpin { file: PathBuf },
    #[error(
        "a record is named after the file of its model, and standard input has no name; name its folder with -o DIR"
    )]
    NamelessRun,
    #[error("{path} is there already; choose another with {option}, or add --overwrite", path = path.display())]
    Exists { path: PathBuf, option: &'static str },
    #[error("{path} is there already and is more or other than a record of quasirigid, so it is never replaced; choose another folder with -o", path = path.display())]
    Foreign { path: PathBuf },
    #[error("{path} is a folder; name a file in it with --out", path = path.display())]
    IsFolder { path: PathBuf },
    #[error("cannot write {path}: there is no folder {folder}; make it first", path = path.display(), folder = folder.display())]
    NoFolder { path: PathBuf, folder: PathBuf },
    #[error("cannot write {path}: {cause}", path = path.display())]
    Write { path: PathBuf, cause: std::io::Error },
    #[error("{file}: [initial] periods: {cause}", file = file.display())]
    Observed { file: PathBuf, cause: ObservedError },
    #[error("{option}: {cause}; {advice}", advice = cause.advice())]
    Target { option: &'static str, cause: Box<TargetError> },
    #[error(
        "no rotation of this body has D/I3 = {ratio}: it lies between {least:.6}, a spin about the axis of least inertia, and 1, one about that of greatest, and neither end ages"
    )]
    NoStage { ratio: f64, least: f64 },
    #[error(
        "the body spins about a principal axis, so nothing ages; give [initial] a wobble, or choose another start with --from"
    )]
    Steady,
    #[error("the body does not turn, so there is no rotation to follow; give [initial] an angular velocity")]
    AtRest,
    #[error("the energy of the rotation is beyond the range of numbers; give [initial] a slower spin")]
    BoundlessSpin,
    #[error(
        "this body has no axis of greatest inertia that a wobble could be counted from: its two greatest moments are equal, {} and {} kg m^2; say how far to go by D/I3, such as --to 0.9",
        significant(moments[1], 6), significant(moments[2], 6)
    )]
    NoShortAxis { moments: [f64; 3] },
    #[error("{file}: [initial] wobble: {cause}", file = file.display())]
    NoWobble { file: PathBuf, cause: NoWobble },
    #[error("a wobble of {} degrees is none; give an angle above 0 and below 90 degrees", significant(angle.to_degrees(), 6))]
    Nutation { angle: f64 },
    #[error(
        "dissipation only raises D/I3, and the target {to} lies below the start, {from}; choose a higher one with --to, or an earlier start with --from"
    )]
    Backwards { from: f64, to: f64 },
    #[error(
        "under a torque the rotation need not reach any target; say how long to follow it, with --duration or with evolve = {{ duration = \"10 yr\" }} in [run]"
    )]
    NoEvolutionDuration,
    #[error(
        "dissipation only lowers the wobble, and that at the start, {} degrees, is smaller than the target, {} degrees; choose a smaller one with --to, or an earlier start with --from",
        significant(from.to_degrees(), 3), significant(to.to_degrees(), 3)
    )]
    Calmer { from: f64, to: f64 },
    #[error("{0} (kinds \"spin-drag\" and \"torque\")")]
    Unaveraged(#[from] Unaveraged),
    #[error(
        "the pole of this body is driven, so its rotation is not free; evolve follows free bodies and fixed points"
    )]
    DrivenPole,
    #[error(
        "this body has momentum wheels, and the average over free rotations knows none; follow it with `simulate`, or see in `modes` how fast its nutation grows or decays"
    )]
    Wheels,
    #[error("at one end of the ranges of the materials: {cause}")]
    Extreme { cause: Box<ElementError> },
    #[error("cannot listen for Ctrl-C: {0}")]
    Signals(#[from] ctrlc::Error),
    #[error("interrupted; the table breaks off here")]
    Interrupted,
    #[error("interrupted; no file was written or changed")]
    Abandoned,
    #[error("the reader of the output went away")]
    BrokenPipe,
}
