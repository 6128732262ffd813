//! Errors of the study as exceptions of Python.
//! One class stands for each kind of failure, so that a program can catch the one it can mend; the message is the study's own, with the
//! names that the arguments have in Python. The classes are in python/quasirigid/_errors.py.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use quasirigid::dynamics::StepperError;
use quasirigid::submanifold::SubmanifoldError;
use quasirigid_io::model::{Diagnostic, FileProblem, ModelError};
use quasirigid_io::visible::visible;
use quasirigid_study::sweep::SweepError;
use quasirigid_study::{Setting, StudyError};

/// A failure on its way to Python.
#[derive(Debug)]
pub enum Failure {
    /// An error of the study.
    Study(StudyError),
    /// An error of a study of many bodies.
    Sweep(SweepError),
    /// An invalid argument.
    Input(String),
    /// A file that is in the way, or cannot be made.
    File(String),
    /// A panic: an error of ours.
    Panic(String),
    /// Python itself: the exception that a signal or an observer raised.
    Raised(PyErr),
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        Self::Study(error)
    }
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        Self::Sweep(error)
    }
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self::Raised(error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| exception(py, failure).unwrap_or_else(|error| error))
    }
}

impl Failure {
    /// A panic with its message.
    pub fn panicked(cause: &(dyn std::any::Any + Send)) -> Self {
        Self::Panic(quasirigid_study::panic_message(cause))
    }

    /// The text for a row of many.
    pub fn text(&self) -> String {
        visible(&match self {
            Self::Study(StudyError::Interrupted) => "the work was stopped on request".to_owned(),
            Self::Study(error) => error.told(&argument),
            Self::Sweep(error) => error.told(&argument),
            Self::Input(text) | Self::File(text) => text.clone(),
            Self::Panic(text) => format!("{OURS}: {text}"),
            Self::Raised(error) => error.to_string(),
        })
    }
}

const OURS: &str = "quasirigid failed by an internal error; please report it with the model";

/// The name of a setting among the arguments.
fn argument(setting: Setting) -> &'static str {
    match setting {
        Setting::Resume => "resume=True",
        other => other.name(),
    }
}

/// The class of an error of the study.
fn class(error: &StudyError) -> &'static str {
    match error {
        StudyError::Record(_) | StudyError::Write { .. } => "FileError",
        StudyError::Model(_) | StudyError::Extreme { .. } => "ModelError",
        StudyError::Reduction(_) | StudyError::Validity(_) | StudyError::Vibration(_) => "ReductionError",
        StudyError::Drive { .. }
        | StudyError::Propagate(_)
        | StudyError::Step(StepperError::Failed(_) | StepperError::Long { .. }) => "PropagationError",
        StudyError::Verification(_) => "VerificationError",
        StudyError::History { .. } => "TooLargeError",
        StudyError::NoSpin { .. }
        | StudyError::NoStart(_)
        | StudyError::NoSlowSeries { .. }
        | StudyError::Observed { .. }
        | StudyError::NoWobble { .. }
        | StudyError::Nutation { .. }
        | StudyError::FreeRotation(_)
        | StudyError::Steady
        | StudyError::AtRest
        | StudyError::BoundlessSpin
        | StudyError::SkinEffect { .. } => "StartError",
        StudyError::Submanifold(SubmanifoldError::Degree { .. }) | StudyError::NoChannel { .. } => {
            "InputError"
        }
        StudyError::Submanifold(
            SubmanifoldError::NoEquations { .. }
            | SubmanifoldError::External { .. }
            | SubmanifoldError::TooLarge { .. }
            | SubmanifoldError::NoNutation,
        )
        | StudyError::ForcesAboutSpin { .. }
        | StudyError::EventsAboutSpin
        | StudyError::SpinsAlone { .. }
        | StudyError::Cantilever(_)
        | StudyError::NothingHeld
        | StudyError::Linear(_)
        | StudyError::Step(StepperError::Timed { .. } | StepperError::Cornered { .. })
        | StudyError::NotExported { .. }
        | StudyError::Driven { .. }
        | StudyError::Uncertified { .. } => "UnsupportedError",
        StudyError::Submanifold(_) | StudyError::SteadySpinBeyond { .. } => "ReductionError",
        StudyError::Unaveraged(_)
        | StudyError::NoAxes { .. }
        | StudyError::FastEddyCurrents { .. }
        | StudyError::DrivenPole
        | StudyError::Wheels { .. }
        | StudyError::NoShortAxis { .. } => "UnsupportedError",
        StudyError::Interrupted => "Interrupted",
        _ => "InputError",
    }
}

fn exception(py: Python<'_>, failure: Failure) -> PyResult<PyErr> {
    let text = failure.text();
    let of = |name: &str| py.import("quasirigid._errors")?.getattr(name);
    let class = match &failure {
        Failure::Raised(error) => return Ok(error.clone_ref(py)),
        Failure::Study(StudyError::Model(error))
        | Failure::Sweep(SweepError::File(error) | SweepError::Model(error)) => {
            return of_model(py, text, error);
        }
        Failure::Study(error) => class(error),
        Failure::Sweep(error) => class_of_sweep(error),
        Failure::Input(_) => "InputError",
        Failure::File(_) => "FileError",
        Failure::Panic(_) => "InternalError",
    };
    Ok(PyErr::from_value(of(class)?.call1((text,))?))
}

/// The class of an error of a study of many bodies.
fn class_of_sweep(error: &SweepError) -> &'static str {
    match error {
        SweepError::OtherStudy { .. }
        | SweepError::Exists { .. }
        | SweepError::Foreign { .. }
        | SweepError::NoFolder { .. }
        | SweepError::Unfinished { .. }
        | SweepError::Table(_)
        | SweepError::Io { .. } => "FileError",
        SweepError::Interrupted => "Interrupted",
        _ => "InputError",
    }
}

/// An error in the text of a model or a study, with its places, or of its file.
fn of_model(py: Python<'_>, text: String, error: &ModelError) -> PyResult<PyErr> {
    let of = |name: &str| py.import("quasirigid._errors")?.getattr(name);
    Ok(PyErr::from_value(match error {
        ModelError::Invalid { model, diagnostics } => {
            let file = model.file.display().to_string();
            let found = diagnostics.iter().map(|each| diagnosed(py, each, &model.text));
            of("ModelError")?.call1((text, file, found.collect::<PyResult<Vec<_>>>()?))?
        }
        ModelError::Unreadable { problem: FileProblem::Missing, .. } => {
            of("MissingFileError")?.call1((text,))?
        }
        _ => of("FileError")?.call1((text,))?,
    }))
}

/// A diagnostic with its place in the text.
fn diagnosed<'py>(py: Python<'py>, diagnostic: &Diagnostic, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let (line, column) = diagnostic.position(text);
    let place = PyDict::new(py);
    place.set_item("line", line)?;
    place.set_item("column", column)?;
    place.set_item("message", visible(&diagnostic.message))?;
    place.set_item("label", &diagnostic.label)?;
    place.set_item("help", diagnostic.help.as_deref())?;
    py.import("quasirigid._errors")?.getattr("Diagnostic")?.call((), Some(&place))
}
