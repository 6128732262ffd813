use quasirigid_study::Study;
use quasirigid_study::modes::SteadySpinSettings;

use super::{certificate, open, whole};
use crate::args::ModesArgs;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Finds the steady spin and the small motions about it.
pub fn modes(arguments: &ModesArgs) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    if arguments.effective_masses {
        return effective_masses(arguments, &study);
    }
    certificate::check(arguments.certificate.as_deref(), arguments.overwrite)?;
    let omega = arguments.spin.as_ref().map(|spin| vector(spin)).transpose()?;
    let asked = SteadySpinSettings { omega, axis: arguments.axis, all: arguments.all };
    let found = whole(&arguments.common, || study.modes(asked))?;
    let certified = arguments.certificate.is_some().then(|| study.certify_modes(&found)).transpose()?;
    let name = &study.model.name;
    output::print_answer(
        arguments.common.json,
        || study.with_inputs(found.json(name)),
        || found.text(name, arguments.all),
    )?;
    let in_place = certificate::write(
        certified.as_ref().zip(arguments.certificate.as_deref()),
        arguments.overwrite,
        arguments.common.quiet,
    )?;
    Ok(if found.found() && in_place { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Gives the cantilever modes with the masses that they carry.
fn effective_masses(arguments: &ModesArgs, study: &Study) -> Result<ExitStatus, Failure> {
    let point = |about: &Vec<f64>| {
        <[f64; 3]>::try_from(about.as_slice()).map_err(|_| Failure::NotAPoint { count: about.len() })
    };
    let about = arguments.about.as_ref().map(point).transpose()?;
    let found = whole(&arguments.common, || study.effective_masses(about))?;
    output::print_answer(
        arguments.common.json,
        || study.with_inputs(found.json()),
        || found.text(arguments.all),
    )?;
    Ok(ExitStatus::Done)
}

fn vector(numbers: &[f64]) -> Result<[f64; 3], Failure> {
    <[f64; 3]>::try_from(numbers).map_err(|_| Failure::NotAVector { count: numbers.len() })
}
