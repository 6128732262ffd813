use std::path::Path;

use quasirigid_io::estimate::{Estimate, read_estimates};
use quasirigid_io::measured_file::read_measurements;
use quasirigid_io::model::Model;
use quasirigid_study::infer::design::{DesignSettings, Flown};
use quasirigid_study::infer::{InferSettings, RobustLoss};
use quasirigid_study::{Study, StudyError};

use super::{Picture, open};
use crate::args::{InferArgs, positive, positive_seconds};
use crate::failure::Failure;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Infers numbers of a model from measurements.
pub fn infer(arguments: &InferArgs) -> Result<ExitStatus, Failure> {
    if arguments.design {
        return design(arguments);
    }
    let sigma = arguments.sigma.map(|sigma| positive("--sigma", sigma)).transpose()?;
    let asked = settings(arguments)?;
    let picture = Picture::at(arguments.figure.as_deref(), arguments.overwrite)?;
    let study = open(&arguments.common)?;
    let data = arguments.data.as_ref().map(|file| read_measurements(file, sigma)).transpose()?;
    let found = study.infer(data.as_ref(), &asked, &mut Terminal::of_whole(arguments.common.quiet))?;
    output::print_answer(arguments.common.json, || study.with_inputs(found.json()), || found.text())?;
    let drawn = picture.write(|| found.picture(), arguments.common.quiet)?;
    Ok(if found.holds() && drawn { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Says which planned measurement would tell most.
fn design(arguments: &InferArgs) -> Result<ExitStatus, Failure> {
    let duration =
        arguments.duration.as_deref().map(|text| positive_seconds("--duration", text)).transpose()?;
    let flown = arguments.manoeuvre.iter().map(|text| flown(text, arguments));
    let asked = DesignSettings {
        vary: arguments.vary.clone(),
        priors: arguments.prior.clone(),
        sensors: arguments.sensor.clone(),
        manoeuvres: flown.collect::<Result<Vec<_>, Failure>>()?,
        duration,
        samples: arguments.samples,
        system: arguments.system,
    };
    let study = open(&arguments.common)?;
    let found = study.design(&asked, &mut Terminal::of_whole(arguments.common.quiet))?;
    output::print_answer(arguments.common.json, || study.with_inputs(found.json()), || found.text())?;
    Ok(if found.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Changes of the model, or another model.
fn flown(text: &str, arguments: &InferArgs) -> Result<Flown, Failure> {
    if text.contains('=') {
        return Ok(Flown::Changed(text.parse()?));
    }
    let model = Model::read(Path::new(text)).map_err(StudyError::from)?;
    Ok(Flown::Other(text.to_owned(), Box::new(Study::new(model, arguments.common.order)?)))
}

fn settings(arguments: &InferArgs) -> Result<InferSettings, Failure> {
    let scale = arguments.loss_scale.map(|scale| positive("--loss-scale", scale)).transpose()?;
    let measured =
        arguments.measured.iter().map(|text| measured(text)).collect::<Result<Vec<_>, Failure>>()?;
    Ok(InferSettings {
        vary: arguments.vary.clone(),
        system: arguments.system,
        measured: measured.concat(),
        priors: arguments.prior.clone(),
        ranges: arguments.range.clone(),
        loss: RobustLoss::new(arguments.loss, scale),
        starts: arguments.starts,
        profiles: arguments.profile,
    })
}

/// One measured answer, or those of a file.
fn measured(text: &str) -> Result<Vec<Estimate>, Failure> {
    Ok(if text.contains('=') { vec![text.parse()?] } else { read_estimates(Path::new(text))? })
}
