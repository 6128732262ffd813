//! Parameters of a model from measurements: weighted least squares on columns of a history and on measured answers of any command, with
//! priors and ranges, and what the data do not tell.
//! The curvature at the least gives standard deviations and correlations; where it misleads, intervals are those of the profile likelihood.
//! Combinations of keys that the data hardly see are named, and their keys have no deviation. Equations (O4) to (O6), (O18) to (O21),
//! docs/theory/23-sensitivity.md.

mod answers;
mod curvature;
mod data;
pub mod design;
mod figure;
mod keys;
mod loss;
mod motions;
mod problem;
mod profile;
mod search;
mod text;
mod told;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use quasirigid_io::estimate::{Estimate, Limits};
use quasirigid_io::measured_file::Measurements;
use quasirigid_io::model::{KeyPath, System};
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::study::Study;
use crate::watch::{Flagging, Watch, watched, whole_pool};
use data::Data;
pub use loss::{Loss, RobustLoss};
use problem::Problem;
pub use profile::Profiles;

/// What is inferred, and from what.
#[derive(Clone, Debug)]
pub struct InferSettings {
    /// Keys to vary.
    pub vary: Vec<KeyPath>,
    /// System that is followed.
    pub system: System,
    /// Measured answers of commands, by their paths.
    pub measured: Vec<Estimate>,
    /// Keys that are known beforehand.
    pub priors: Vec<Estimate>,
    /// Ranges of keys.
    pub ranges: Vec<Limits>,
    /// How much a residual counts.
    pub loss: RobustLoss,
    /// Starts of the search beside that of the file.
    pub starts: usize,
    /// Keys whose intervals are those of the profile likelihood.
    pub profiles: Profiles,
}

/// Starts beside that of the file, unless another number is asked for.
const STARTS: usize = 2;

impl Default for InferSettings {
    fn default() -> Self {
        Self {
            vary: Vec::new(),
            system: System::Reduced,
            measured: Vec::new(),
            priors: Vec::new(),
            ranges: Vec::new(),
            loss: RobustLoss::default(),
            starts: STARTS,
            profiles: Profiles::Auto,
        }
    }
}

/// Parameters inferred from measurements; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct Inferred {
    /// Title of the model.
    pub name: String,
    /// The result in words.
    pub sentence: String,
    /// The keys.
    pub parameters: Vec<Parameter>,
    /// Covariance of the keys, in their units; `null` of those that the data do not tell, or that are at a bound.
    pub covariance: Vec<Vec<Option<f64>>>,
    /// Sum of the squares of the residuals over their deviations, of outliers left out under a robust loss.
    pub chi2: f64,
    /// Number of the values that `chi2` counts, priors among them, less that of the keys at no bound.
    pub degrees_of_freedom: usize,
    /// Deviation of the data that their scatter has, where none is given; else `null`.
    pub scatter: Option<f64>,
    /// Largest correlation of neighbouring residuals among the columns: about zero of noise, near one where the history misses the data.
    pub correlation: f64,
    /// Number of values more than four deviations off.
    pub outliers: usize,
    /// Columns of the history.
    pub columns: Vec<FittedColumn>,
    /// Measured answers.
    pub measured: Vec<FittedAnswer>,
    /// Combinations of keys that the data do not tell.
    pub not_distinguished: Vec<Combination>,
    /// Other minima that fit nearly as well.
    pub alternatives: Vec<Alternative>,
    /// Whether the search ended at a least.
    pub converged: bool,
    /// Whether the model explains the data within their deviations; without these `null`, or `false` where the residuals are no noise.
    pub explained: Option<bool>,
    /// Number of changed models that were followed.
    pub models: usize,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
    /// Times (s) of the rows of the history.
    #[serde(skip)]
    pub t: Vec<f64>,
}

/// Parameter that was inferred.
#[derive(Clone, Debug, Serialize)]
pub struct Parameter {
    /// Path of the key.
    pub key: String,
    /// Value that fits best, in its unit.
    pub value: f64,
    /// Standard deviation; `null` where the data do not tell it, and at a bound.
    pub sigma: Option<f64>,
    /// Ends of the interval of 68 %; `null` where the data set none.
    pub interval_68: [Option<f64>; 2],
    /// Ends of the interval of 95 %; `null` where the data set none.
    pub interval_95: [Option<f64>; 2],
    /// Whether the intervals are those of the profile likelihood, and not of the deviation.
    pub profiled: bool,
    /// Bound that the value is at, `low` or `high`; else `null`.
    pub at_bound: Option<&'static str>,
    /// Unit as the file writes it; empty of a plain number, which is in SI units.
    pub unit: String,
    /// Value in the file.
    pub before: f64,
}

/// Column of a measured history beside the history that fits best.
#[derive(Clone, Debug, Serialize)]
pub struct FittedColumn {
    /// Name of the column.
    pub name: String,
    /// Root of the mean square of its residuals, over their deviations.
    pub rms: f64,
    /// Greatest residual, over its deviation.
    pub largest: f64,
    /// Unit of the column.
    #[serde(skip)]
    pub unit: String,
    /// Measured values.
    #[serde(skip)]
    pub measured: Vec<f64>,
    /// Values of the history that fits best.
    #[serde(skip)]
    pub fitted: Vec<f64>,
    /// Residuals, over their deviations.
    #[serde(skip)]
    pub residuals: Vec<f64>,
}

/// Measured answer beside that of the model that fits best.
#[derive(Clone, Debug, Serialize)]
pub struct FittedAnswer {
    /// Path of the answer.
    pub quantity: String,
    /// Measured value.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Value of the model that fits best.
    pub fitted: f64,
    /// Residual over the deviation.
    pub residual: f64,
    /// Unit; empty of a pure number.
    pub unit: String,
}

/// Minimum elsewhere, of a sum that is within that of the interval of 95 %.
#[derive(Clone, Debug, Serialize)]
pub struct Alternative {
    /// Values of the keys there.
    pub values: Vec<f64>,
    /// How much larger the sum of squares is, over its rise in one deviation.
    pub rise: f64,
}

/// Combination of keys that the data do not tell: they stay as they are if each key changes by its share.
#[derive(Clone, Debug, Serialize)]
pub struct Combination {
    /// Relative change of each key.
    pub changes: Vec<Change>,
    /// Standard deviation of the combination; `null` if the data do not see it at all.
    pub sigma: Option<f64>,
}

/// Share of a key in a combination.
#[derive(Clone, Debug, Serialize)]
pub struct Change {
    /// Path of the key.
    pub key: String,
    /// Relative change, of a zero over the largest number beside it.
    pub relative: f64,
}

impl Study {
    /// Values of keys of the model with which its history and its answers fit measured ones best.
    ///
    /// # Errors
    /// [`StudyError::Change`] and [`StudyError::NoNumber`] for keys, [`StudyError::Infer`] for data that the model cannot have.
    pub fn infer(
        &self,
        history: Option<&Measurements>,
        asked: &InferSettings,
        watch: &mut dyn Watch,
    ) -> Result<Inferred, StudyError> {
        let template = keys::template(self)?;
        let keys = keys::keys(self, &template, asked)?;
        let data = Data::new(self, history, asked)?;
        data.check(&keys, asked)?;
        let cancelled: Arc<AtomicBool> = Arc::default();
        let problem = Problem {
            study: self,
            template: &template,
            keys: &keys,
            data: &data,
            system: asked.system,
            loss: asked.loss,
            cancelled: &cancelled,
            models: AtomicUsize::new(0),
        };
        let mut observer =
            Flagging { watch, cancelled: &cancelled, stage: "fitting the measurements", share: &|| 0.0 };
        let notes = watched(&mut observer, || problem.checked())?;
        let found = watched(&mut observer, || {
            Ok(whole_pool()?.install(|| search::deepest(&problem, asked.starts, asked.profiles)))
        })?;
        if cancelled.load(Ordering::Relaxed) {
            return Err(StudyError::Interrupted);
        }
        let found = found.ok_or_else(|| StudyError::Infer {
            problem: "the model answers at its own values, and not beside them: no derivatives exist"
                .to_owned(),
        })?;
        Ok(told::told(&problem, &found, notes))
    }
}

impl Inferred {
    /// Whether the numbers are those of the data: one least was found, the model explains the data, and the data tell every key.
    #[must_use]
    pub fn holds(&self) -> bool {
        let is_one = self.alternatives.is_empty() && self.not_distinguished.is_empty();
        self.converged && self.explained != Some(false) && is_one
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }
}
