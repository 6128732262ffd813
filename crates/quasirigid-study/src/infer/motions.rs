//! Histories of changed copies of a model against a measured one.

use quasirigid_io::measured_file::Measurements;
use quasirigid_io::model::{Model, PartialRun, PartialSpinManifold, System};

use crate::error::StudyError;
use crate::histories::{History, Table};
use crate::study::Study;

/// Columns of the attitude, whose two signs are one attitude.
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];

/// Names and units of the columns of a history.
pub fn units(study: &Study, system: System) -> Result<Vec<(String, String)>, StudyError> {
    let history = of_study(study, vec![0.0], system)?;
    Ok(history.columns.into_iter().map(|column| (column.name, column.unit)).collect())
}

/// Notes on the history of the text as it stands, whose errors are told.
pub fn checked(
    study: &Study,
    text: &str,
    data: &Measurements,
    system: System,
) -> Result<Vec<String>, StudyError> {
    let history = history(study, text, &data.t, system)?;
    let problem = |problem: String| Err(StudyError::Infer { problem });
    for column in &data.columns {
        if !history.columns.iter().any(|own| own.name == column.name) {
            let names: Vec<&str> = history.columns.iter().map(|own| own.name.as_str()).collect();
            return problem(format!(
                "the data have the column {:?}, which the history has not; it has {}",
                column.name,
                names.join(", ")
            ));
        }
    }
    if let Some(reason) = history.reason() {
        return problem(format!("the history of the model does not hold: {reason}"));
    }
    if of(&history, data).is_none() {
        return problem("the history of the model ends before the data do".to_owned());
    }
    Ok(history.notes)
}

/// Residuals over their deviations, column by column; none where the model or its history does not exist.
pub fn residuals(study: &Study, text: &str, data: &Measurements, system: System) -> Option<Vec<f64>> {
    let history = history(study, text, &data.t, system).ok().filter(|history| history.reason().is_none());
    of(&history?, data)
}

/// Values of columns at times.
pub fn values(
    study: &Study,
    text: &str,
    names: &[&str],
    times: &[f64],
    system: System,
) -> Result<Vec<Vec<f64>>, StudyError> {
    let history = history(study, text, times, system)?;
    let problem = |problem: String| StudyError::Infer { problem };
    if let Some(reason) = history.reason() {
        return Err(problem(format!("the history of the model does not hold: {reason}")));
    }
    let column = |name: &&str| {
        let found = history.columns.iter().find(|own| own.name == *name);
        let values = found.map(|column| column.values.clone()).filter(|values| values.len() == times.len());
        values.ok_or_else(|| problem("the history of the model ends before the last measurement".to_owned()))
    };
    names.iter().map(column).collect()
}

fn history(study: &Study, text: &str, times: &[f64], system: System) -> Result<History, StudyError> {
    let order = study.order_given.then_some(study.order);
    let study = Study::new(Model::parse(&study.model.source.file, text)?, order)?;
    of_study(&study, times.to_vec(), system)
}

fn of_study(study: &Study, times: Vec<f64>, system: System) -> Result<History, StudyError> {
    let manifold = PartialSpinManifold::default();
    let table = Table {
        system: Some(system),
        coordinates: false,
        displacements: false,
        times: Some(times),
        manifold,
    };
    let settings = PartialRun { samples: Some(2), ..PartialRun::default() };
    study.simulate_from(study.initial()?, &settings, &table, &mut ())
}

fn of(history: &History, data: &Measurements) -> Option<Vec<f64>> {
    let find = |name: &str| history.columns.iter().find(|own| own.name == name).map(|own| &own.values);
    let measured = |name: &str| data.columns.iter().find(|column| column.name == name);
    let attitudes: Option<Vec<_>> =
        QUATERNION.iter().map(|name| Some((find(name)?, measured(name)?))).collect();
    let sign = |row: usize| {
        let product = attitudes.iter().flatten().map(|(own, data)| own[row] * data.values[row]).sum::<f64>();
        if product < 0.0 { -1.0 } else { 1.0 }
    };
    let mut residuals = Vec::with_capacity(data.count());
    for column in &data.columns {
        let own = find(&column.name)?;
        if own.len() != data.t.len() {
            return None;
        }
        let turns = QUATERNION.contains(&column.name.as_str());
        for (row, (own, value)) in own.iter().zip(&column.values).enumerate() {
            let own = if turns { sign(row) * own } else { *own };
            residuals.push((own - value) / column.deviation(row));
        }
    }
    residuals.iter().all(|residual| residual.is_finite()).then_some(residuals)
}
