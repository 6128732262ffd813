//! Arguments of an inference: what is measured, what is known beforehand, and how residuals count.

use std::path::PathBuf;
use std::str::FromStr;

use pyo3::prelude::*;
use quasirigid_io::estimate::EstimateError;
use quasirigid_io::measured_file::read_measurements;
use quasirigid_io::model::System;
use quasirigid_io::plan::Manoeuvre;
use quasirigid_study::Study;
use quasirigid_study::infer::design::{DesignSettings, Flown};
use quasirigid_study::infer::{InferSettings, Loss, Profiles, RobustLoss};

use crate::answers::{self, Answer};
use crate::arguments::{Quantity, named};
use crate::failure::Failure;
use crate::watching::Shared;

/// What is inferred, and from what, as a dictionary; measured answers, priors and ranges as the program takes them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct InferArgs {
    vary: Vec<String>,
    system: String,
    measured: Vec<String>,
    prior: Vec<String>,
    range: Vec<String>,
    loss: String,
    loss_scale: Option<f64>,
    starts: usize,
    profile: String,
}

impl InferArgs {
    /// The settings of the study.
    pub fn settings(&self) -> Result<InferSettings, Failure> {
        let kind = named::<Loss>(Some(&self.loss), "loss")?.unwrap_or(Loss::Squares);
        Ok(InferSettings {
            vary: answers::keys(&self.vary)?,
            system: named::<System>(Some(&self.system), "system")?.unwrap_or(System::Reduced),
            measured: each("measured", &self.measured)?,
            priors: each("prior", &self.prior)?,
            ranges: each("range", &self.range)?,
            loss: RobustLoss::new(kind, self.loss_scale),
            starts: self.starts,
            profiles: named::<Profiles>(Some(&self.profile), "profile")?.unwrap_or(Profiles::Auto),
        })
    }
}

/// What is planned, as a dictionary; sensors, manoeuvres and priors as the program takes them.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct DesignArgs {
    vary: Vec<String>,
    system: String,
    sensors: Vec<String>,
    manoeuvres: Vec<String>,
    prior: Vec<String>,
    duration: Option<Quantity>,
    samples: usize,
}

impl DesignArgs {
    /// The settings of the study.
    pub fn settings(&self) -> Result<DesignSettings, Failure> {
        let manoeuvres = each::<Manoeuvre>("manoeuvres", &self.manoeuvres)?;
        let duration = self.duration.as_ref().map(|duration| duration.seconds("duration"));
        Ok(DesignSettings {
            vary: answers::keys(&self.vary)?,
            system: named::<System>(Some(&self.system), "system")?.unwrap_or(System::Reduced),
            sensors: each("sensors", &self.sensors)?,
            manoeuvres: manoeuvres.into_iter().map(Flown::Changed).collect(),
            priors: each("prior", &self.prior)?,
            duration: duration.transpose()?,
            samples: self.samples,
        })
    }
}

/// What planned measurements would tell.
pub fn design(study: &Study, asked: &DesignSettings, mut shared: &Shared) -> Result<Answer, Failure> {
    let found = study.design(asked, &mut shared)?;
    let json = study.with_inputs(found.json());
    let notes = study.model.notes.clone();
    Ok(Answer::plain(json, found.text(), found.sentence.clone(), found.holds(), notes))
}

fn each<T: FromStr<Err = EstimateError>>(name: &str, texts: &[String]) -> Result<Vec<T>, Failure> {
    let read = |text: &String| text.parse().map_err(|error| Failure::Input(format!("{name}: {error}")));
    texts.iter().map(read).collect()
}

/// Numbers of the model inferred from a history, with the deviation of columns that have none, and from answers.
pub fn infer(
    study: &Study,
    (history, sigma): &(Option<PathBuf>, Option<f64>),
    asked: &InferSettings,
    mut shared: &Shared,
) -> Result<Answer, Failure> {
    let read =
        |file: &PathBuf| read_measurements(file, *sigma).map_err(|error| Failure::File(error.to_string()));
    let history = history.as_ref().map(read).transpose()?;
    let found = study.infer(history.as_ref(), asked, &mut shared)?;
    let notes = study.model.notes.iter().chain(&found.notes).cloned().collect();
    let json = study.with_inputs(found.json());
    Ok(Answer::plain(json, found.text(), found.sentence.clone(), found.holds(), notes))
}
