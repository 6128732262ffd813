//! Bodies that a program of Python moves step by step.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use quasirigid::dynamics::{FullState, FullStepper, ReducedStepper, Start, StepStatus};
use quasirigid_study::{Study, StudyError};
use self_cell::self_cell;

use crate::failure::Failure;

/// A body under a torque that is held over each step.
#[pyclass(module = "quasirigid._core")]
#[derive(Debug)]
pub struct Stepper {
    body: Moved,
    status: StepStatus,
    wrong: Option<String>,
    notes: Vec<String>,
    /// Spins (rad/s) below which reduced equations hold, and from which they fail.
    range: Option<[f64; 2]>,
}

#[derive(Debug)]
enum Moved {
    Reduced(Box<ReducedStepper>),
    Full(FullSystem),
}

self_cell!(
    /// The full system of a study, kept beside the study that it borrows.
    struct FullSystem {
        owner: Arc<Study>,
        #[not_covariant]
        dependent: FullStepper,
    }
    impl {Debug}
);

impl FullSystem {
    fn read<T>(&self, read: impl FnOnce(&FullStepper<'_>) -> T) -> T {
        self.with_dependent(|_, stepper| read(stepper))
    }

    fn change<T>(&mut self, change: impl FnOnce(&mut FullStepper<'_>) -> T) -> T {
        self.with_dependent_mut(|_, stepper| change(stepper))
    }
}

impl Stepper {
    /// The reduced equations.
    pub fn reduced(study: &Study, tolerance: f64) -> Result<Self, Failure> {
        let found = study.reduced_steps(tolerance)?;
        Ok(Self {
            body: Moved::Reduced(Box::new(found.stepper)),
            status: if found.wrong.is_none() { StepStatus::Holds } else { StepStatus::Fails },
            wrong: found.wrong,
            notes: found.notes,
            range: Some(found.range),
        })
    }

    /// The full system.
    pub fn full(study: &Arc<Study>, tolerance: f64) -> Result<Self, Failure> {
        let notes = study.model.notes.clone();
        let system = FullSystem::try_new(Arc::clone(study), |study| study.full_stepper(tolerance))?;
        let body = Moved::Full(system);
        Ok(Self { body, status: StepStatus::Holds, wrong: None, notes, range: None })
    }
}

#[pymethods]
impl Stepper {
    /// Moves the body; the status after the step.
    fn step(&mut self, torque: [f64; 3], dt: f64) -> PyResult<&'static str> {
        let found = match &mut self.body {
            Moved::Reduced(body) => body.step(torque, dt),
            Moved::Full(body) => body.change(|body| body.step(torque, dt)),
        };
        self.status = found.map_err(|cause| Failure::from(StudyError::Step(cause)))?;
        Ok(word(self.status))
    }

    /// Puts the body into another state; coordinates and rates of the full system alone.
    fn place(
        &mut self,
        rotation: ([f64; 3], [f64; 4]),
        inside: Option<(Vec<f64>, Vec<f64>)>,
        outside: Option<([f64; 3], [f64; 3])>,
    ) -> PyResult<()> {
        let (omega, attitude) = rotation;
        let placed = match &mut self.body {
            Moved::Reduced(body) => body.place(Start::new(omega, attitude)).map_err(StudyError::from),
            Moved::Full(body) => body.change(|body| {
                let now = body.state();
                let (q, rate) = inside.unwrap_or((now.q, now.rate));
                let (place, velocity) = outside.unwrap_or((now.place, now.velocity));
                body.place(&FullState { omega, attitude, q, rate, place, velocity }).map_err(StudyError::Step)
            }),
        };
        Ok(placed.map_err(Failure::from)?)
    }

    /// Angular velocity, attitude and angular momentum, and of the full system what is inside and its place.
    fn state<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let state = PyDict::new(py);
        match &mut self.body {
            Moved::Reduced(body) => {
                state.set_item("omega", body.omega())?;
                state.set_item("attitude", body.attitude())?;
                state.set_item("angular_momentum", body.angular_momentum())?;
            }
            Moved::Full(body) => {
                let FullState { omega, attitude, q, rate, place, velocity } =
                    body.change(|body| body.state());
                state.set_item("omega", omega)?;
                state.set_item("attitude", attitude)?;
                state.set_item("angular_momentum", body.read(|body| body.angular_momentum()))?;
                state.set_item("q", q)?;
                state.set_item("rate", rate)?;
                state.set_item("place", place)?;
                state.set_item("velocity", velocity)?;
            }
        }
        Ok(state)
    }

    #[getter]
    fn time(&self) -> f64 {
        match &self.body {
            Moved::Reduced(body) => body.time(),
            Moved::Full(body) => body.read(|body| body.time()),
        }
    }

    #[getter]
    fn status(&self) -> &'static str {
        word(self.status)
    }

    #[getter]
    fn wrong(&self) -> Option<&str> {
        self.wrong.as_deref()
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    #[getter]
    fn range(&self) -> Option<[f64; 2]> {
        self.range
    }
}

fn word(status: StepStatus) -> &'static str {
    match status {
        StepStatus::Holds => "holds",
        StepStatus::Marginal => "marginal",
        StepStatus::Fails => "fails",
        StepStatus::Left(_) => "left",
    }
}
