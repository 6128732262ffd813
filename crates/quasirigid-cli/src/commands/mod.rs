//! One command a file.

pub mod check;
pub mod derive;
pub mod run;
pub mod simulate;
mod summary;

use std::path::Path;

use quasirigid::dynamics::{Form, Options, SpinState};
use quasirigid::math::sym::norm;
use quasirigid::model::FlexibleBody;
use quasirigid_io::model::Model;
use quasirigid_io::units::{Dimension, quantity};

use crate::args::{self, Common, Propagation};
use crate::failure::Failure;
use crate::message::remark;

/// A model file with its flexible body.
struct Loaded {
    model: Model,
    body: FlexibleBody,
    order: usize,
}

fn load(common: &Common) -> Result<Loaded, Failure> {
    let model = Model::read(&common.model)?;
    let errors = model.assembly.check();
    if !errors.is_empty() {
        return Err(model.diagnose_all(&errors).into());
    }
    let body = model.assembly.body().map_err(|error| model.diagnose(&error))?;
    let order = common.order.unwrap_or(model.run.order);
    Ok(Loaded { model, body, order })
}

/// Says what is suspect in the model, on standard error.
fn notes(model: &Model, common: &Common) {
    if !common.quiet {
        model.notes.iter().for_each(|note| remark(&format!("note: {note}")));
    }
}

/// The state the file starts from.
fn initial(model: &Model, file: &Path) -> Result<SpinState, Failure> {
    let omega = model.initial.angular_velocity.ok_or_else(|| Failure::NoSpin { file: file.into() })?;
    Ok(SpinState { omega, attitude: model.initial.attitude })
}

/// Turns that a propagation makes when nothing says how long it lasts.
const TURNS: f64 = 100.0;

/// Duration (s): the command's, the file's, or a hundred turns.
fn duration(model: &Model, propagation: &Propagation, omega: [f64; 3]) -> Result<f64, Failure> {
    let Some(text) = &propagation.duration else {
        return Ok(model.run.duration.unwrap_or(TURNS * std::f64::consts::TAU / norm(omega)));
    };
    let seconds = match text.parse() {
        Ok(seconds) => seconds,
        Err(_) => quantity(text, Dimension::TIME)
            .map_err(|cause| Failure::Duration { text: text.clone(), cause: Box::new(cause) })?,
    };
    if seconds > 0.0 && f64::is_finite(seconds) { Ok(seconds) } else { Err(Failure::NoDuration { seconds }) }
}

/// Options of a propagation: the command's, the file's, or the defaults.
fn options(model: &Model, propagation: &Propagation) -> Options {
    let mut options = Options::default();
    if let Some(tolerance) = propagation.tolerance.or(model.run.tolerance) {
        options.tolerance = tolerance;
    }
    let paper = match propagation.form {
        Some(form) => form == args::Form::Paper,
        None => model.run.form == Some(quasirigid_io::model::Form::Paper),
    };
    options.form = if paper { Form::Paper } else { Form::Momentum };
    options
}

/// Output times from zero to `duration`.
fn even_times(samples: usize, duration: f64) -> Result<Vec<f64>, Failure> {
    if !(2..=10_000_000).contains(&samples) {
        return Err(Failure::Samples { samples });
    }
    let last = samples - 1;
    Ok((0..samples).map(|i| if i == last { duration } else { duration * i as f64 / last as f64 }).collect())
}
