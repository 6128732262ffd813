//! Settings of an evolution.

use quasirigid_io::model::{BodyKind, EvolveMethod, PartialEvolve, Power, Target};

use super::{Setting, SettingError, count, time};
use crate::study::Study;

/// Rows of the history unless another number is given.
const SAMPLES: usize = 201;

/// Settings of an evolution.
#[derive(Clone, Debug, PartialEq)]
pub struct EvolveSettings {
    /// Start; none for the initial state of the model.
    pub start: Option<Target>,
    /// Target; none for 1 % of the energy of the nutation.
    pub until: Option<Target>,
    /// Longest time (s).
    pub duration: Option<f64>,
    /// Rows of the history.
    pub samples: usize,
    /// Source of the power; none takes the harmonics only where a material needs them.
    pub power: Option<Power>,
    /// Method; none leaves the choice to the criteria.
    pub method: Option<EvolveMethod>,
    /// Kind of the body, for the words.
    pub(crate) kind: BodyKind,
}

impl EvolveSettings {
    /// Settings asked for, else those of the file, else the defaults.
    ///
    /// # Errors
    /// [`SettingError`] for a duration that is not above zero, and a number of rows out of range.
    pub fn resolve(asked: PartialEvolve, study: &Study) -> Result<Self, SettingError> {
        let file = study.model.run.evolve.clone().unwrap_or_default();
        let PartialEvolve { start, until, duration, samples, power, method } = asked.or(file);
        Ok(Self {
            start,
            until,
            duration: time(Setting::EvolutionDuration, duration)?,
            samples: count(Setting::EvolutionSamples, samples)?.unwrap_or(SAMPLES),
            power,
            method,
            kind: study.model.kind,
        })
    }

    /// Time (s) up to which a steady spin that is reached stays: that asked for without a target.
    pub(crate) fn stays(&self) -> Option<f64> {
        self.duration.filter(|_| self.until.is_none())
    }

    /// Settings for the rest of the evolution after a time (s).
    pub(crate) fn after(&self, t: f64) -> Self {
        Self { duration: self.duration.map(|duration| (duration - t).max(0.0)), ..self.clone() }
    }
}
