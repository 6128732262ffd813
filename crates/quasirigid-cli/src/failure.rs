//! Failures of commands, with their messages: those of the study, and those of files, options and signals.
//! The study names settings by the keys of the model file; here each setting gets the flag that a user typed.

use std::path::PathBuf;

use quasirigid_io::attitude::Unwritten;
use quasirigid_io::estimate::{EstimateError, EstimateFileError};
use quasirigid_io::light_curve::LightCurveFileError;
use quasirigid_io::measured_file::MeasuredFileError;
use quasirigid_io::model::{ModelError, TargetError};
use quasirigid_io::record::RecordError;
use quasirigid_io::units::UnitError;
use quasirigid_study::audit::AuditError;
use quasirigid_study::difference::DifferenceError;
use quasirigid_study::report::PngError;
use quasirigid_study::sweep::SweepError;
use quasirigid_study::{Setting, StudyError};
use thiserror::Error;

/// Failure: the reason why a command could not run.
#[derive(Debug, Error)]
pub enum Failure {
    #[error("{}", .0.told(&flag))]
    Study(StudyError),
    #[error("{}", .0.told(&flag))]
    Sweep(#[from] SweepError),
    #[error(transparent)]
    Difference(#[from] DifferenceError),
    #[error(transparent)]
    Audit(AuditError),
    #[error(transparent)]
    Measured(#[from] MeasuredFileError),
    #[error(transparent)]
    Estimate(#[from] EstimateError),
    #[error(transparent)]
    Estimates(#[from] EstimateFileError),
    #[error(transparent)]
    LightCurveFile(#[from] LightCurveFileError),
    #[error("{option} {text}: {cause}; {advice}", advice = cause.advice())]
    Time { option: &'static str, text: String, cause: Box<UnitError> },
    #[error("{first} and {second} are both models; an audit has one", first = first.display(), second = second.display())]
    TwoModels { first: PathBuf, second: PathBuf },
    #[error("--duration {text}: {cause}; {advice}", advice = cause.advice())]
    Duration { text: String, cause: Box<UnitError> },
    #[error("the model file has no table {name:?}; {advice}")]
    NoTable { name: String, advice: String },
    #[error("--file {path}: there is no such file", path = path.display())]
    NoFile { path: PathBuf },
    #[error("a model of the kind {kind} reads no file; leave --file out, or take mesh, nastran or shape")]
    ReadsNoFile { kind: String },
    #[error("a model file is UTF-8 text, and cannot name {path}; rename it", path = path.display())]
    OddName { path: PathBuf },
    #[error("an angular velocity has three components, not {count}: --spin 0,0,1.5")]
    NotAVector { count: usize },
    #[error("a point has three coordinates, not {count}: --about 0.6,0,0.2")]
    NotAPoint { count: usize },
    #[error(
        "{word:?} is no steady state; give --at rest, --at spin, or an angular velocity such as --at 0,0,1.5"
    )]
    NoSteadyState { word: String },
    #[error(
        "a record is named after the file of its model, and standard input has no name; name its folder with -o DIR"
    )]
    NamelessRun,
    #[error("{path} already exists; choose another with {option}, or add --overwrite", path = path.display())]
    Exists { path: PathBuf, option: &'static str },
    #[error("{path} already exists and is not only a record of quasirigid, so it is never replaced; choose another folder with -o", path = path.display())]
    Foreign { path: PathBuf },
    #[error("{path} is a folder; name a file in it with --out", path = path.display())]
    IsFolder { path: PathBuf },
    #[error("cannot write {path}: there is no folder {folder}; create it first", path = path.display(), folder = folder.display())]
    NoFolder { path: PathBuf, folder: PathBuf },
    #[error("cannot write {path}: {cause}", path = path.display())]
    Write { path: PathBuf, cause: std::io::Error },
    #[error("{path} is written, but the system does not say that it is on the disk: {cause}; write it again before you rely on it", path = path.display())]
    Unsettled { path: PathBuf, cause: std::io::Error },
    #[error("{option}: {cause}; {advice}", advice = cause.advice())]
    Target { option: &'static str, cause: Box<TargetError> },
    #[error("{}: the record has no scene to draw; run the model again with this version", folder.display())]
    NoScene { folder: PathBuf },
    #[error("{}: the record has no figure {name:?}; it has {}", folder.display(), known.join(", "))]
    NoFigure { folder: PathBuf, name: String, known: Vec<&'static str> },
    #[error("{}: the record has no data for a figure", folder.display())]
    NoFigures { folder: PathBuf },
    #[error("{}: pictures are svg or png files; name the format with --format", path.display())]
    PictureEnding { path: PathBuf },
    #[error("{}: a figure is an .svg or .png file", path.display())]
    FigureEnding { path: PathBuf },
    #[error("{}: a map of fills is a .csv, .svg or .png file; JSON is that of --json", path.display())]
    FillMapEnding { path: PathBuf },
    #[error("{}: a light curve is a .csv, .parquet, .npz, .svg or .png file, .txt for DAMIT or .alcdef; JSON is that of --json", path.display())]
    LightCurveEnding { path: PathBuf },
    #[error("{}: torques of sunlight are a .csv, .parquet, .npz, .svg or .png file; JSON is that of --json", path.display())]
    YorpEnding { path: PathBuf },
    #[error(
        "give the directions to Sun and observer, --sun 1,0,0 --observer 0.9,0.4,0, or a file of both, --view FILE"
    )]
    NoView,
    #[error("no point of the map has a nutation with a time constant: there is nothing to draw")]
    NoNutation,
    #[error("{}: a linear model is a .mat or .npz file; JSON is that of --json", path.display())]
    ArrayEnding { path: PathBuf },
    #[error("--pixels belongs to PNG pictures; an SVG picture has any size")]
    PixelsOfSvg,
    #[error(transparent)]
    Picture(#[from] PngError),
    #[error(
        "a certificate does not go to standard output, where the answer goes; name a file: --certificate FILE.json"
    )]
    CertificateOnStdout,
    #[error("--out - and {option} both ask for standard output; name a file with --out")]
    TwiceOnStdout { option: &'static str },
    #[error(
        "{option} - asks for standard output, but a folder is written; name one, or ./- for a folder of that name"
    )]
    FolderOnStdout { option: &'static str },
    #[error("a browser cannot open standard output; name a file with --out")]
    OpenedStdout,
    #[error("{format} is a binary format, not text for a terminal; name a file with --out")]
    BinaryOnTerminal { format: &'static str },
    #[error("--epoch, --time-system, --frame and --without-rates belong to attitude files; add {with}")]
    NoAttitudeFile { with: &'static str },
    #[error("{}: the endings of attitude files are aem, a, msopck and npz; name the format with --format", path.display())]
    AttitudeEnding { path: PathBuf },
    #[error("an attitude file has one history; name one record with --attitude")]
    OneAttitude,
    #[error("{}: the record has no history {system:?}; it has {}", folder.display(), known.join(", "))]
    NoHistory { folder: PathBuf, system: String, known: Vec<String> },
    #[error(transparent)]
    Unwritten(Unwritten),
    #[error("--degree, --masters, --style and --axis belong to the equations about a spin; add {with}")]
    NotAboutSpin { with: &'static str },
    #[error("LaTeX has the equations about rest alone; take --format json for those about the spin")]
    NoLatexAboutSpin,
    #[error("a glTF file shows one body in motion; name one record with --gltf")]
    OneScene,
    #[error("{path}: what stands in this file has the name of the file; name it {name} with the same ending", path = path.display())]
    NamedLikeItsFile { path: PathBuf, name: String },
    #[error("cannot open {path} in a browser: {cause}; open it by hand", path = path.display())]
    Browser { path: PathBuf, cause: std::io::Error },
    #[error("{option} is {value}, but must be positive")]
    NotPositive { option: &'static str, value: f64 },
    #[error("cannot listen for Ctrl-C: {0}")]
    Signals(std::io::Error),
    #[error("interrupted; the table is incomplete")]
    Interrupted,
    #[error("interrupted; the rows answered so far are kept; continue with --resume")]
    Left,
    #[error("interrupted; no file was written or changed")]
    Abandoned,
    #[error("broken pipe")]
    BrokenPipe,
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Interrupted => Self::Interrupted,
            StudyError::Write { path, cause } => Self::Write { path, cause },
            other => Self::Study(other),
        }
    }
}

impl From<AuditError> for Failure {
    fn from(error: AuditError) -> Self {
        match error {
            AuditError::Study(error) => error.into(),
            other => Self::Audit(other),
        }
    }
}

impl From<RecordError> for Failure {
    fn from(error: RecordError) -> Self {
        Self::Study(error.into())
    }
}

impl Failure {
    /// Whether the failure is one of writing, so that the same work ends well once there is room and access.
    pub fn is_of_writing(&self) -> bool {
        matches!(self, Self::Write { .. } | Self::Unsettled { .. } | Self::Study(StudyError::Record(_)))
    }

    /// Error of the model file, if the failure is one.
    pub fn model(&self) -> Option<&ModelError> {
        match self {
            Self::Study(StudyError::Model(error)) => Some(error),
            Self::Sweep(error) => error.located(),
            _ => None,
        }
    }
}

/// The flag of a setting; that of the folder is told by its letter.
fn flag(setting: Setting) -> &'static str {
    if setting == Setting::Out { "-o" } else { setting.flag() }
}
