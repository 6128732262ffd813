//! Parameters of a model from a measured history: weighted least squares on the columns that were measured, and what the data do not tell.
//! The curvature at the least gives standard deviations and correlations; combinations of keys that the data hardly see are named, and
//! their keys have no deviation. Equations (O4) to (O6), docs/theory/23-sensitivity.md.

mod motions;
mod text;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use quasirigid_io::measured_file::Measurements;
use quasirigid_io::model::{KeyPath, System, Template, WrittenNumber};
use quasirigid_io::units::number_in;
use quasirigid_math::least_squares::{LeastSquares, least_squares};
use quasirigid_math::random::Random;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::study::Study;
use crate::watch::{Flagging, Watch, watched, whole_pool};
use crate::words::significant;
use motions::Motions;

/// Relative deviation of a combination of keys from which the data do not tell it.
const UNSEEN: f64 = 1.0;
/// Singular value, over the largest, below which it is the error of the differences.
const NULL: f64 = 1e-7;
/// Share of a key in a combination from which it is part of it.
const PART: f64 = 0.1;
/// Starts beside that of the file, and the most by which they differ from it.
const STARTS: usize = 2;
const SPREAD: f64 = 0.2;
const SEED: u64 = 20;
/// Standard deviations of χ² within which the model explains the data.
const EXPLAINED: f64 = 4.0;
/// Correlation of neighbouring residuals, over its deviation in noise, from which they are no noise.
const CORRELATED: f64 = 4.0;
/// Scatter of a column over its largest value below which they are exact: what is left is the error of the history.
const EXACT: f64 = 1e-6;
/// Values below which noise and misfit look the same.
const FEW: usize = 50;
/// Relative difference of squares from which a least is deeper than another.
const DEEPER: f64 = 1e-3;

/// What is inferred, and from what.
#[derive(Clone, Debug)]
pub struct InferSettings {
    /// Keys to vary.
    pub vary: Vec<KeyPath>,
    /// System that is followed.
    pub system: System,
}

/// Parameters inferred from a history; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct Inferred {
    /// Title of the model.
    pub name: String,
    /// The result in words.
    pub sentence: String,
    /// The keys.
    pub parameters: Vec<Parameter>,
    /// Covariance of the keys, in their units; `null` of those that the data do not tell.
    pub covariance: Vec<Vec<Option<f64>>>,
    /// Sum of the squares of the residuals over their deviations.
    pub chi2: f64,
    /// Number of measured values less that of keys.
    pub degrees_of_freedom: usize,
    /// Deviation of the data that their scatter has, where none is given; else `null`.
    pub scatter: Option<f64>,
    /// Largest correlation of neighbouring residuals among the columns: about zero of noise, near one where the history misses the data.
    pub correlation: f64,
    /// Combinations of keys that the data do not tell.
    pub not_distinguished: Vec<Combination>,
    /// Whether the search ended at a least.
    pub converged: bool,
    /// Whether the model explains the data within their deviations; without these `null`, or `false` where the residuals are no noise.
    pub explained: Option<bool>,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
}

/// Parameter that was inferred.
#[derive(Clone, Debug, Serialize)]
pub struct Parameter {
    /// Path of the key.
    pub key: String,
    /// Value that fits best, in its unit.
    pub value: f64,
    /// Standard deviation; `null` where the data do not tell it.
    pub sigma: Option<f64>,
    /// Unit as the file writes it; empty of a plain number, which is in SI units.
    pub unit: String,
    /// Value in the file.
    pub before: f64,
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
    /// Values of keys of the model with which its history fits a measured one best.
    ///
    /// # Errors
    /// [`StudyError::Change`] and [`StudyError::NoNumber`] for keys, [`StudyError::Infer`] for data that the model cannot have.
    pub fn infer(
        &self,
        data: &Measurements,
        asked: &InferSettings,
        watch: &mut dyn Watch,
    ) -> Result<Inferred, StudyError> {
        let template = Template::new(&self.model.source.text)?;
        let numbers = asked.vary.iter().map(|key| {
            let found = template.number(key)?;
            found.ok_or_else(|| StudyError::NoNumber { key: key.to_string() })
        });
        let numbers = numbers.collect::<Result<Vec<WrittenNumber>, StudyError>>()?;
        check(data, &numbers)?;
        let data = &in_units(self, data.clone(), asked.system)?;
        let cancelled: Arc<AtomicBool> = Arc::default();
        let motions =
            Motions { study: self, template: &template, numbers: &numbers, data, system: asked.system };
        let mut observer =
            Flagging { watch, cancelled: &cancelled, stage: "fitting the history", share: &|| 0.0 };
        let at_file = watched(&mut observer, || motions.checked())?;
        let found = watched(&mut observer, || Ok(whole_pool()?.install(|| best(&motions, &cancelled))))?;
        if cancelled.load(Ordering::Relaxed) {
            return Err(StudyError::Interrupted);
        }
        let (found, others) = found.ok_or_else(|| StudyError::Infer {
            problem: "the model answers at its own values, and not beside them: no derivatives exist"
                .to_owned(),
        })?;
        Ok(told(self, data, &numbers, &found, others, at_file))
    }
}

/// The data in the units of the columns of a history.
fn in_units(study: &Study, mut data: Measurements, system: System) -> Result<Measurements, StudyError> {
    let units = motions::units(study, system)?;
    for column in &mut data.columns {
        let own = units.iter().find(|(name, _)| *name == column.name).map(|(_, unit)| unit.as_str());
        let (Some(unit), Some(own)) = (column.unit.take(), own) else { continue };
        let factor = number_in(&format!("1 {unit}"), own).ok_or_else(|| StudyError::Infer {
            problem: format!("the data have {} in {unit}, and the history has it in {own}", column.name),
        })?;
        column.scale(factor);
    }
    Ok(data)
}

/// Refuses keys that nothing scales, keys named twice, and data that are fewer than the keys.
fn check(data: &Measurements, numbers: &[WrittenNumber]) -> Result<(), StudyError> {
    let refuse = |problem: String| Err(StudyError::Infer { problem });
    for (at, number) in numbers.iter().enumerate() {
        if number.scale == 0.0 {
            return refuse(format!(
                "{} is zero, and nothing beside it gives its scale; write a first guess in the model",
                number.path
            ));
        }
        if numbers[..at].iter().any(|other| other.path == number.path) {
            return refuse(format!("{} is named twice", number.path));
        }
    }
    let count = data.count();
    if numbers.is_empty() || count <= numbers.len() {
        let keys = numbers.len();
        return refuse(format!(
            "{count} measured values for {keys} keys; give more values than keys, and a key"
        ));
    }
    Ok(())
}

/// The deepest least of all starts, with the squares of the others.
fn best(motions: &Motions<'_>, cancelled: &AtomicBool) -> Option<(LeastSquares, Vec<f64>)> {
    let mut residuals = |points: &[Vec<f64>]| -> Vec<Option<Vec<f64>>> {
        if cancelled.load(Ordering::Relaxed) {
            return vec![None; points.len()];
        }
        points.par_iter().map(|point| motions.residuals(point)).collect()
    };
    let mut random = Random::new(SEED);
    let file = motions.start();
    let mut starts = vec![file.clone()];
    for _ in 0..STARTS {
        starts.push(file.iter().map(|x| x + SPREAD * (2.0 * random.unit() - 1.0)).collect());
    }
    let mut found: Vec<LeastSquares> =
        starts.iter().filter_map(|start| least_squares(start, &mut residuals)).collect();
    found.sort_by(|a, b| a.square.total_cmp(&b.square));
    let others = found.iter().skip(1).map(|other| other.square).collect();
    found.into_iter().next().map(|first| (first, others))
}

/// The result: the covariance, and what the data do not tell. (O5), (O6)
fn told(
    study: &Study,
    data: &Measurements,
    numbers: &[WrittenNumber],
    found: &LeastSquares,
    others: Vec<f64>,
    mut notes: Vec<String>,
) -> Inferred {
    let freedom = data.count() - numbers.len();
    let given = data.has_deviations();
    let scatter = (!given).then(|| (found.square / freedom as f64).sqrt());
    let unit = scatter.unwrap_or(1.0);
    let deviations: Vec<f64> = found.singular.iter().map(|value| unit / value).collect();
    let largest = found.singular.first().copied().unwrap_or(0.0);
    let unseen: Vec<usize> = (0..numbers.len())
        .filter(|k| !(deviations[*k] <= UNSEEN) || found.singular[*k] <= NULL * largest)
        .collect();
    let part = |k: usize, i: usize| found.combinations[k][i].abs() > PART;
    let lost = |i: usize| unseen.iter().any(|k| part(*k, i));
    let covariance = |i: usize, j: usize| {
        let seen = (0..numbers.len()).filter(|k| !unseen.contains(k));
        let sum: f64 =
            seen.map(|k| deviations[k].powi(2) * found.combinations[k][i] * found.combinations[k][j]).sum();
        (!lost(i) && !lost(j)).then_some(sum * numbers[i].scale * numbers[j].scale)
    };
    let count = numbers.len();
    let covariance: Vec<Vec<Option<f64>>> =
        (0..count).map(|i| (0..count).map(|j| covariance(i, j)).collect()).collect();
    let parameter = |(i, number): (usize, &WrittenNumber)| Parameter {
        key: number.path.to_string(),
        value: found.parameters[i] * number.scale,
        sigma: covariance[i][i].map(f64::sqrt),
        unit: number.unit.clone().unwrap_or_default(),
        before: number.number,
    };
    let combination = |k: &usize| Combination {
        changes: (0..count)
            .filter(|i| part(*k, *i))
            .map(|i| Change { key: numbers[i].path.to_string(), relative: found.combinations[*k][i] })
            .collect(),
        sigma: (found.singular[*k] > NULL * largest).then_some(deviations[*k]),
    };
    let chi2 = found.square;
    let correlation = correlation(data, &found.residuals);
    let no_noise = correlation > CORRELATED / (data.t.len() as f64).sqrt();
    let explained = if given {
        Some((chi2 - freedom as f64) <= EXPLAINED * (2.0 * freedom as f64).sqrt())
    } else {
        no_noise.then_some(false)
    };
    if given && no_noise {
        notes.push(format!(
            "neighbouring residuals are alike (correlation {}): the deviations given cover a misfit or errors that last, and sigma knows of neither",
            significant(correlation, 2)
        ));
    }
    if !given && data.count() < FEW {
        notes.push(
            "so few values cannot show whether what is left is noise or a misfit; give their deviations"
                .to_owned(),
        );
    }
    if others.iter().any(|other| *other > chi2 * (1.0 + DEEPER) && chi2 > 0.0) {
        notes.push("some starts end in shallower minima: the deepest one that was found is told".to_owned());
    }
    let mut inferred = Inferred {
        name: study.model.name.clone(),
        sentence: String::new(),
        parameters: numbers.iter().enumerate().map(parameter).collect(),
        covariance,
        chi2,
        degrees_of_freedom: freedom,
        scatter,
        correlation,
        not_distinguished: unseen.iter().map(combination).collect(),
        converged: found.converged,
        explained,
        notes,
    };
    inferred.sentence = inferred.told();
    inferred
}

/// Largest correlation of neighbouring residuals among the columns; zero of those that are missed by no more than the error of a history.
fn correlation(data: &Measurements, residuals: &[f64]) -> f64 {
    let rows = data.t.len();
    let columns = data.columns.iter().zip(residuals.chunks_exact(rows));
    let correlations = columns.map(|(column, residuals)| {
        let missed = residuals.iter().enumerate().map(|(row, r)| (r * column.deviation(row)).powi(2));
        let largest = column.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let is_exact = (missed.sum::<f64>() / rows as f64).sqrt() <= EXACT * largest;
        let neighbours: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        if is_exact { 0.0 } else { neighbours / residuals.iter().map(|r| r * r).sum::<f64>() }
    });
    correlations.fold(0.0, f64::max)
}

impl Inferred {
    /// Whether the numbers are those of the data: a least was found, the model explains the data, and the data tell every key.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.converged && self.explained != Some(false) && self.not_distinguished.is_empty()
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }
}
