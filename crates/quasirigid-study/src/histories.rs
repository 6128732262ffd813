//! Histories of the spin: how long, how finely, by which equations.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::dynamics::{Event, Form, Method, Observer, Options, Outcome, PropagateError, Run, Sample};
use quasirigid::math::memory;
use quasirigid::math::sym::{dot, norm};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::{Comparison, Criterion, frequencies, reduce};
use quasirigid_io::model::{Stop, System};
use quasirigid_io::record::HistoryRecord;

use crate::error::StudyError;
use crate::motion::Motion;
use crate::record;
use crate::study::Study;
use crate::watch::Watch;

/// What a user says of a propagation; what is not said is the file's, or the usual.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Propagation {
    /// Duration (s); a hundred turns if nobody says.
    pub duration: Option<f64>,
    /// Error allowed per step, relative.
    pub tolerance: Option<f64>,
    /// Number of rows.
    pub samples: Option<usize>,
    /// Variable that is integrated.
    pub form: Option<Form>,
    /// How the full system is integrated.
    pub method: Option<Method>,
}

/// Turns that a propagation makes when nothing says how long it lasts.
const TURNS: f64 = 100.0;
/// Numbers of a row, in the history and in its table.
const ROW: usize = 40;
/// Rows that a table has.
const ROWS: std::ops::RangeInclusive<usize> = 2..=10_000_000;

impl Propagation {
    /// Duration (s) of a motion that starts with an angular velocity (rad/s).
    ///
    /// # Errors
    /// [`StudyError::NoDuration`].
    pub fn duration(&self, study: &Study, omega: [f64; 3]) -> Result<f64, StudyError> {
        let Some(seconds) = self.duration else {
            return Ok(study.model.run.duration.unwrap_or(TURNS * TAU / norm(omega)));
        };
        if seconds > 0.0 && seconds.is_finite() { Ok(seconds) } else { Err(StudyError::NoDuration { seconds }) }
    }

    /// Number of rows, or `usual`.
    #[must_use]
    pub fn samples(&self, study: &Study, usual: usize) -> usize {
        self.samples.or(study.model.run.samples).unwrap_or(usual)
    }

    /// Options of the integrator. Nutation is counted from the `axis`.
    ///
    /// # Errors
    /// [`StudyError::Vibration`].
    pub fn options(&self, study: &Study, axis: [f64; 3]) -> Result<Options, StudyError> {
        let run = &study.model.run;
        let usual = Options::default();
        Ok(Options {
            events: events(study, axis)?,
            method: self.method.or(run.method).unwrap_or(usual.method),
            tolerance: self.tolerance.or(run.tolerance).unwrap_or(usual.tolerance),
            form: self.form.or(run.form).unwrap_or(Form::Momentum),
            ..usual
        })
    }
}

/// What ends a propagation, as the file asks.
fn events(study: &Study, axis: [f64; 3]) -> Result<Vec<Event>, StudyError> {
    let Stop { energy, nutation, validity } = study.model.run.stop;
    let mut events: Vec<Event> = energy.map(Event::Energy).into_iter().collect();
    events.extend(nutation.map(|angle| Event::Nutation { axis, angle }));
    if validity && let Some(slowest) = frequencies(&study.body)?.first() {
        let limit = Criterion { comparison: Comparison::Spin, value: 0.0 }.failure();
        events.push(Event::Validity { slowest: *slowest, limit });
    }
    Ok(events)
}

