//! Which measurement would tell most: deviations of the keys from the Fisher information of planned sensors and manoeuvres, without data.
//! Equation (O21), docs/theory/23-sensitivity.md.

mod text;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize};

use quasirigid_io::estimate::Estimate;
use quasirigid_io::measured_file::{MeasuredColumn, Measurements};
use quasirigid_io::model::{KeyPath, Model, PartialRun, System, Template};
use quasirigid_io::plan::{Deviation, Manoeuvre, Sensor};
use quasirigid_io::study_file::Quantity;
use quasirigid_math::least_squares::jacobian;
use serde::Serialize;
use serde_json::{Value, json};

use super::curvature::Seen;
use super::data::{Data, MeasuredAnswer};
use super::keys::{self, Key};
use super::problem::Problem;
use super::{InferSettings, RobustLoss, answers, motions};
use crate::asked::unit;
use crate::error::StudyError;
use crate::histories::even_times;
use crate::settings::RunSettings;
use crate::study::Study;
use crate::watch::{Flagging, Watch, watched, whole_pool};

/// Name of the motion of the file.
const AS_IT_STANDS: &str = "as it stands";

/// A motion that may be flown: changes of the model, or another model of the same body.
#[derive(Debug)]
pub enum Flown {
    /// Changes.
    Changed(Manoeuvre),
    /// Another model, by the name of its file.
    Other(String, Box<Study>),
}

/// What is planned.
#[derive(Debug)]
pub struct DesignSettings {
    /// Keys to infer.
    pub vary: Vec<KeyPath>,
    /// Keys that are known beforehand.
    pub priors: Vec<Estimate>,
    /// Sensors.
    pub sensors: Vec<Sensor>,
    /// Motions beside that of the file.
    pub manoeuvres: Vec<Flown>,
    /// Time (s) for which columns are measured; that of the model by default.
    pub duration: Option<f64>,
    /// Number of times at which columns are measured.
    pub samples: usize,
    /// System that is followed.
    pub system: System,
}

/// Plans of measurements and what they would tell; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct Design {
    /// Title of the model.
    pub name: String,
    /// What would tell most, in words.
    pub sentence: String,
    /// The keys.
    pub keys: Vec<DesignKey>,
    /// Plans, that which tells most first.
    pub plans: Vec<Plan>,
    /// Manoeuvres that are not answered.
    pub not_answered: Vec<NotAnswered>,
}

/// Key of a design.
#[derive(Clone, Debug, Serialize)]
pub struct DesignKey {
    /// Path of the key.
    pub key: String,
    /// Value in the file.
    pub value: f64,
    /// Unit as the file writes it; empty of a plain number, which is in SI units.
    pub unit: String,
}

/// Sensors in a motion, and what they would tell.
#[derive(Clone, Debug, Serialize)]
pub struct Plan {
    /// The motion.
    pub manoeuvre: String,
    /// The sensors.
    pub sensors: Vec<String>,
    /// Whether these are all sensors.
    pub complete: bool,
    /// Standard deviation of each key; `null` where the plan does not tell it.
    pub sigma: Vec<Option<f64>>,
    /// Largest deviation over the size of its key; `null` where a key is not told.
    pub worst: Option<f64>,
}

/// Manoeuvre without an answer.
#[derive(Clone, Debug, Serialize)]
pub struct NotAnswered {
    /// The manoeuvre.
    pub manoeuvre: String,
    /// The reason, in words.
    pub reason: String,
}

impl Study {
    /// Deviations that planned measurements would give to keys of the model.
    ///
    /// # Errors
    /// [`StudyError::Change`] and [`StudyError::NoNumber`] for keys, [`StudyError::Infer`] for sensors that the model does not have.
    pub fn design(&self, asked: &DesignSettings, watch: &mut dyn Watch) -> Result<Design, StudyError> {
        if asked.sensors.is_empty() || asked.vary.is_empty() {
            return refuse("a design needs a key and a sensor at least".to_owned());
        }
        let run =
            PartialRun { duration: asked.duration, samples: Some(asked.samples), ..PartialRun::default() };
        let run = RunSettings::resolve(&run, self)?;
        let times = even_times(asked.samples, run.duration(self.initial()?.omega)?);
        let cancelled: Arc<AtomicBool> = Arc::default();
        let mut observer =
            Flagging { watch, cancelled: &cancelled, stage: "differentiating the plans", share: &|| 0.0 };
        let flown = |name: &str, study: &Study| {
            whole_pool()?.install(|| planned(study, asked, (name, &times), &cancelled))
        };
        let (keys, mut plans) = watched(&mut observer, || flown(AS_IT_STANDS, self))?;
        let mut not_answered = Vec::new();
        for manoeuvre in &asked.manoeuvres {
            let (name, found) = match manoeuvre {
                Flown::Changed(manoeuvre) => {
                    let work = || flown(&manoeuvre.text, &changed(self, manoeuvre)?);
                    (&manoeuvre.text, watched(&mut observer, work))
                }
                Flown::Other(name, study) => (name, watched(&mut observer, || flown(name, study))),
            };
            match found {
                Ok((_, found)) => plans.extend(found),
                Err(StudyError::Interrupted) => return Err(StudyError::Interrupted),
                Err(error) => not_answered
                    .push(NotAnswered { manoeuvre: name.clone(), reason: first_line(&error.to_string()) }),
            }
        }
        plans.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
        let name = self.model.name.clone();
        let mut design = Design { name, sentence: String::new(), keys, plans, not_answered };
        design.sentence = design.told();
        Ok(design)
    }
}

fn refuse<T>(problem: String) -> Result<T, StudyError> {
    Err(StudyError::Infer { problem })
}

fn first_line(text: &str) -> String {
    text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().trim().to_owned()
}

/// Worst relative deviation; plans that leave a key untold come last, those that tell more keys first.
fn rank(plan: &Plan) -> f64 {
    let untold = plan.sigma.iter().filter(|sigma| sigma.is_none()).count();
    plan.worst.unwrap_or(f64::MAX * (0.5 + 0.4 * untold as f64 / plan.sigma.len() as f64))
}

/// The model with the changes of a manoeuvre.
fn changed(study: &Study, manoeuvre: &Manoeuvre) -> Result<Study, StudyError> {
    let text = Template::new(&study.model.source.text)?.changed(&manoeuvre.changes)?;
    let order = study.order_given.then_some(study.order);
    Study::new(Model::parse(&study.model.source.file, &text)?, order)
}

/// What the sensors tell in a motion: all together, each alone, and all but one.
fn planned(
    study: &Study,
    asked: &DesignSettings,
    (name, times): (&str, &[f64]),
    cancelled: &Arc<AtomicBool>,
) -> Result<(Vec<DesignKey>, Vec<Plan>), StudyError> {
    let template = keys::template(study)?;
    let inferred = InferSettings {
        vary: asked.vary.clone(),
        priors: asked.priors.clone(),
        system: asked.system,
        ..InferSettings::default()
    };
    let keys = keys::keys(study, &template, &inferred)?;
    let (data, owners) = simulated(study, asked, times, cancelled)?;
    let problem = Problem {
        study,
        template: &template,
        keys: &keys,
        data: &data,
        system: asked.system,
        loss: RobustLoss::default(),
        cancelled,
        models: AtomicUsize::new(0),
    };
    let x = problem.start();
    let at_file = problem.residuals(&x);
    let columns =
        at_file.and_then(|r| jacobian(&x, &r, &problem.bounds(), &mut |points| problem.all(points)));
    let Some(columns) = columns else {
        return refuse(
            "the model answers at its own values, and not beside them: no derivatives exist".to_owned(),
        );
    };
    let plan = |sensors: Vec<usize>| told(&keys, &columns, &owners, (name, asked), &sensors);
    let count = asked.sensors.len();
    let mut plans = vec![plan((0..count).collect())];
    if count > 1 {
        plans.extend((0..count).map(|one| plan(vec![one])));
    }
    if count > 2 {
        plans.extend((0..count).map(|out| plan((0..count).filter(|each| *each != out).collect())));
    }
    let listed = keys.iter().map(|key| DesignKey {
        key: key.number.path.to_string(),
        value: key.number.number,
        unit: key.number.unit.clone().unwrap_or_default(),
    });
    Ok((listed.collect(), plans))
}

/// Deviations of the keys by some of the sensors, and by what is known beforehand. (O21)
fn told(
    keys: &[Key],
    columns: &[Vec<f64>],
    owners: &[usize],
    (name, asked): (&str, &DesignSettings),
    sensors: &[usize],
) -> Plan {
    let sizes: Vec<f64> = keys.iter().map(|key| key.size(key.start())).collect();
    // rows of no sensor are those of priors
    let is_counted = |row: usize| owners.get(row).is_none_or(|owner| sensors.contains(owner));
    let scaled = columns.iter().zip(&sizes).map(|(column, size)| {
        let rows = column.iter().enumerate().filter(|(row, _)| is_counted(*row));
        rows.map(|(_, d)| d * size).collect()
    });
    let scaled: Vec<Vec<f64>> = scaled.collect();
    let seen = Seen::of(&scaled, &scaled, 1.0);
    let relative: Vec<Option<f64>> = (0..keys.len()).map(|i| seen.covariance(i, i).map(f64::sqrt)).collect();
    let sigma = relative.iter().zip(&sizes).zip(keys);
    let worst = relative.iter().copied().collect::<Option<Vec<f64>>>();
    Plan {
        manoeuvre: name.to_owned(),
        sensors: sensors.iter().map(|each| asked.sensors[*each].names.join(",")).collect(),
        complete: sensors.len() == asked.sensors.len(),
        sigma: sigma.map(|((sigma, size), key)| sigma.map(|s| s * size * key.number.scale)).collect(),
        worst: worst.map(|all| all.into_iter().fold(0.0, f64::max)),
    }
}

/// What the sensors would give of the model as it stands, with the sensor of each value in the order of the residuals.
fn simulated(
    study: &Study,
    asked: &DesignSettings,
    times: &[f64],
    cancelled: &Arc<AtomicBool>,
) -> Result<(Data, Vec<usize>), StudyError> {
    let template = keys::template(study)?;
    let text = template.changed(&[])?;
    let known = motions::units(study, asked.system)?;
    let (mut columns, mut answered) = (Vec::new(), Vec::new());
    for (owner, sensor) in asked.sensors.iter().enumerate() {
        for name in &sensor.names {
            match known.iter().find(|(own, _)| own == name) {
                Some((_, unit)) => columns.push((owner, name.clone(), column_deviation(sensor, unit)?)),
                None if name.contains('.') => answered.push((owner, answer(name)?)),
                None => {
                    let names: Vec<&str> = known.iter().map(|(name, _)| name.as_str()).collect();
                    let names = names.join(", ");
                    return refuse(format!(
                        "{name:?} is no column of a history, which has {names}, and no answer of a command"
                    ));
                }
            }
        }
    }
    let mut measured: Vec<MeasuredAnswer> = answered.iter().map(|(_, answer)| answer.clone()).collect();
    let source = &study.model.source;
    if !measured.is_empty() {
        let values = answers::values(source, &text, &measured, asked.system, cancelled)
            .map_err(|problem| StudyError::Infer { problem })?;
        for ((each, (owner, _)), value) in measured.iter_mut().zip(&answered).zip(values) {
            (each.value, each.sigma) = (value, answer_deviation(&asked.sensors[*owner], each, value)?);
        }
    }
    let names: Vec<&str> = columns.iter().map(|(_, name, _)| name.as_str()).collect();
    let history = (!names.is_empty())
        .then(|| motions::values(study, &text, &names, times, asked.system))
        .transpose()?;
    let rows = if history.is_some() { times.len() } else { 0 };
    let owners = columns.iter().flat_map(|(owner, ..)| std::iter::repeat_n(*owner, rows));
    let owners = owners.chain(answered.iter().map(|(owner, _)| *owner)).collect();
    let history = history.map(|values| {
        let columns = columns.iter().zip(values);
        let columns = columns.map(|((_, name, sigma), values)| MeasuredColumn::new(name, values, *sigma));
        Measurements::of_columns(times.to_vec(), columns.collect())
    });
    let units = vec![String::new(); names.len()];
    Ok((Data { history, units, answers: measured }, owners))
}

fn column_deviation(sensor: &Sensor, unit: &str) -> Result<f64, StudyError> {
    match &sensor.sigma {
        Deviation::Amount(amount) => amount.in_unit(unit).map_or_else(
            || refuse(format!("{} is in {unit}, and {amount} is something else", sensor.names.join(","))),
            Ok,
        ),
        Deviation::Share(_) => refuse(format!(
            "the deviation of {} is a share, and its values pass through zero; write it in {unit}",
            sensor.names.join(",")
        )),
    }
}

fn answer_deviation(sensor: &Sensor, answer: &MeasuredAnswer, value: f64) -> Result<f64, StudyError> {
    let sigma = match &sensor.sigma {
        Deviation::Amount(amount) => amount.in_unit(answer.unit),
        Deviation::Share(share) => Some(share * value.abs()),
    };
    match sigma {
        Some(sigma) if sigma > 0.0 => Ok(sigma),
        Some(_) => refuse(format!("{} is zero, and a share of it is no deviation", answer.quantity.name)),
        None => refuse(format!(
            "{} is printed in {:?}, and its deviation is something else",
            answer.quantity.name, answer.unit
        )),
    }
}

fn answer(name: &str) -> Result<MeasuredAnswer, StudyError> {
    let quantity: Quantity =
        name.parse().map_err(|error| StudyError::Infer { problem: format!("{name}: {error}") })?;
    Ok(MeasuredAnswer { value: 0.0, sigma: 1.0, unit: unit(&quantity), quantity })
}

impl Design {
    /// Whether a plan tells every key, and every manoeuvre is answered.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.not_answered.is_empty() && self.plans.iter().any(|plan| plan.worst.is_some())
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }
}
