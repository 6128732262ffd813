//! Histories of changed copies of a model against a measured one.

use std::panic::{AssertUnwindSafe, catch_unwind};

use quasirigid_io::measured_file::Measurements;
use quasirigid_io::model::{Model, PartialRun, PartialSpinManifold, System, Template, WrittenNumber};

use crate::error::StudyError;
use crate::histories::{History, Table};
use crate::study::Study;

/// Columns of the attitude, whose two signs are one attitude.
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];

/// Names and units of the columns of a history.
pub fn units(study: &Study, system: System) -> Result<Vec<(String, String)>, StudyError> {
    let table = Table { times: Some(vec![0.0]), ..table(system) };
    let settings = PartialRun { samples: Some(2), ..PartialRun::default() };
    let history = study.simulate_from(study.initial()?, &settings, &table, &mut ())?;
    Ok(history.columns.into_iter().map(|column| (column.name, column.unit)).collect())
}

fn table(system: System) -> Table {
    let manifold = PartialSpinManifold::default();
    Table { system, coordinates: false, displacements: false, times: None, manifold }
}

/// Histories at the times of the data, by the keys that are varied, each over its scale.
pub struct Motions<'a> {
    pub study: &'a Study,
    pub template: &'a Template,
    pub numbers: &'a [WrittenNumber],
    pub data: &'a Measurements,
    pub system: System,
}

impl Motions<'_> {
    /// The keys as the file has them, over their scales.
    pub fn start(&self) -> Vec<f64> {
        self.numbers.iter().map(|number| number.number / number.scale).collect()
    }

    /// Notes on the history of the file itself, whose errors are told.
    pub fn checked(&self) -> Result<Vec<String>, StudyError> {
        let history = self.history(&self.start())?;
        let problem = |problem: String| Err(StudyError::Infer { problem });
        for column in &self.data.columns {
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
        if self.of(&history).is_none() {
            return problem("the history of the model ends before the data do".to_owned());
        }
        Ok(history.notes)
    }

    /// Residuals over their deviations; none where the model or its history does not exist there.
    pub fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        let work = || self.history(point).ok().filter(|history| history.reason().is_none());
        self.of(&catch_unwind(AssertUnwindSafe(work)).ok()??)
    }

    fn history(&self, point: &[f64]) -> Result<History, StudyError> {
        let changes = self.numbers.iter().zip(point);
        let changes: Vec<_> =
            changes.map(|(number, x)| (number.path.clone(), number.with(x * number.scale))).collect();
        let text = self.template.changed(&changes)?;
        let order = self.study.order_given.then_some(self.study.order);
        let study = Study::new(Model::parse(&self.study.model.source.file, &text)?, order)?;
        let table = Table { times: Some(self.data.t.clone()), ..table(self.system) };
        let settings = PartialRun { samples: Some(2), ..PartialRun::default() };
        study.simulate_from(study.initial()?, &settings, &table, &mut ())
    }

    fn of(&self, history: &History) -> Option<Vec<f64>> {
        let find = |name: &str| history.columns.iter().find(|own| own.name == name).map(|own| &own.values);
        let measured = |name: &str| self.data.columns.iter().find(|column| column.name == name);
        let attitudes: Option<Vec<_>> =
            QUATERNION.iter().map(|name| Some((find(name)?, measured(name)?))).collect();
        let sign = |row: usize| {
            let product =
                attitudes.iter().flatten().map(|(own, data)| own[row] * data.values[row]).sum::<f64>();
            if product < 0.0 { -1.0 } else { 1.0 }
        };
        let mut residuals = Vec::with_capacity(self.data.count());
        for column in &self.data.columns {
            let own = find(&column.name)?;
            if own.len() != self.data.t.len() {
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
}
