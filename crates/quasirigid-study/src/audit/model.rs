//! Loss that the model of the body explains: the time constant of its own nutation about the axis that the history circles.

use quasirigid::model::Mode;
use quasirigid_math::vec3::{dot, scale};

use super::drift::Drift;
use super::measure::Measured;
use super::rigid::Rigid;
use crate::modes::SteadySpinSettings;
use crate::study::Study;

/// Time constant of the model.
#[derive(Clone, Debug, PartialEq)]
pub enum OfModel {
    /// Decay rate of the small wobble (1/s), negative where it grows; zero of a body that loses nothing.
    Rate(f64),
    /// Why it is not known.
    Unknown(String),
}

/// The decay rate of the small wobble of a model about the axis that a history circles, at its angular momentum.
pub fn of_model(study: &Study, body: &Rigid, measured: &Measured, drift: &Drift) -> OfModel {
    if !study.forces.is_empty() {
        return OfModel::Unknown("forces act in the model".to_owned());
    }
    if study.body.coordinates().is_empty() {
        return OfModel::Rate(0.0);
    }
    let place = if drift.mode == Mode::LongAxis { 0 } else { 2 };
    let axis = body.principal.axes[place];
    let along = dot(axis, measured.file.rates[0]);
    let rate = drift.momentum / body.principal.moments[place] * along.signum();
    let asked = SteadySpinSettings { omega: Some(scale(rate, axis)), axis: None, all: false };
    let found = match study.modes(asked) {
        Ok(found) => found,
        Err(error) => return OfModel::Unknown(error.to_string()),
    };
    let nutation = found.spins.first().and_then(|spin| spin.modes.iter().find(|mode| mode.nutation));
    match nutation {
        Some(mode) if mode.neutral => OfModel::Rate(0.0),
        Some(mode) => OfModel::Rate(mode.decay_rate),
        None => OfModel::Unknown(found.unfound().map_or_else(
            || format!("its steady spin has no {}", study.model.kind.nutation()),
            str::to_owned,
        )),
    }
}
