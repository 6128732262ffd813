//! Settings of histories.

use std::f64::consts::TAU;

use quasirigid::dynamics::{Event, Form, Method, Options};
use quasirigid::reduction::{Comparison, Criterion, frequencies};
use quasirigid_io::model::{PartialRun, Stop};
use quasirigid_math::vec3::norm;

use super::{Setting, SettingError, count, time};
use crate::error::StudyError;
use crate::study::Study;

/// Revolutions of a history without a duration.
const REVOLUTIONS: f64 = 100.0;

/// Settings of histories.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Duration (s); none for a hundred revolutions of the start.
    pub duration: Option<f64>,
    /// Number of rows; none for the number that suits the question.
    pub samples: Option<usize>,
    /// Error allowed per step, relative.
    pub tolerance: f64,
    /// Variable that is integrated.
    pub form: Form,
    /// Integrator of the full system.
    pub integrator: Method,
}

impl RunSettings {
    /// Settings asked for, else those of the file, else the defaults.
    ///
    /// # Errors
    /// [`SettingError`] for a duration that is not above zero, and a number of rows out of range.
    pub fn resolve(asked: &PartialRun, study: &Study) -> Result<Self, SettingError> {
        let PartialRun { duration, tolerance, samples, form, integrator } =
            asked.clone().or(study.model.run.histories.clone());
        let usual = Options::default();
        Ok(Self {
            duration: time(Setting::Duration, duration)?,
            samples: count(Setting::Samples, samples)?,
            tolerance: tolerance.unwrap_or(usual.tolerance),
            form: form.unwrap_or(Form::AngularMomentum),
            integrator: integrator.unwrap_or(usual.method),
        })
    }

    /// Duration (s) of a motion that starts with an angular velocity (rad/s).
    ///
    /// # Errors
    /// [`StudyError::RestWithoutDuration`].
    pub fn duration(&self, omega: [f64; 3]) -> Result<f64, StudyError> {
        let usual = Some(REVOLUTIONS * TAU / norm(omega)).filter(|seconds| seconds.is_finite());
        self.duration.or(usual).ok_or(StudyError::RestWithoutDuration)
    }

    /// Options of the integrator, with the events at which the file ends a history. Nutation is counted from the `axis`.
    ///
    /// # Errors
    /// [`StudyError::Vibration`].
    pub fn options(&self, study: &Study, axis: [f64; 3]) -> Result<Options, StudyError> {
        Ok(Options {
            events: events(study, axis)?,
            method: self.integrator,
            tolerance: self.tolerance,
            form: self.form,
            ..Options::default()
        })
    }
}

/// Events that end a history, as the file asks.
fn events(study: &Study, axis: [f64; 3]) -> Result<Vec<Event>, StudyError> {
    let Stop { energy, nutation, validity } = study.model.run.stop;
    let mut events: Vec<Event> = energy.map(Event::Energy).into_iter().collect();
    events.extend(nutation.map(|angle| Event::Nutation { axis, angle }));
    // a liquid that slides has no frequency of its own
    let study = study.held()?.unwrap_or(study);
    if validity && let Some(slowest) = frequencies(&study.body)?.first() {
        let limit = Criterion { comparison: Comparison::Spin, value: 0.0 }.failure();
        events.push(Event::Validity { slowest: *slowest, limit });
    }
    Ok(events)
}
