use std::path::Path;

use quasirigid_io::array_file::ArrayFormat;
use quasirigid_study::linear::{LinearAt, LinearSettings, LinearTruncation, truncation_method};

use super::{open, whole};
use crate::args::LinearArgs;
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Gives the linear model about a steady state.
pub fn linear(arguments: &LinearArgs) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    let at = arguments.at.as_deref().map(state).transpose()?;
    let asked = LinearSettings {
        at,
        inputs: arguments.inputs.clone(),
        outputs: arguments.outputs.clone(),
        band: arguments.band,
        truncation: truncation(arguments),
    };
    let format = arguments.out.as_deref().map(|path| format(path, arguments.overwrite)).transpose()?;
    let found = whole(&arguments.common, || study.linear(&asked))?;
    output::print_answer(arguments.common.json, || found.json(), || found.text())?;
    if let (Some(path), Some(format)) = (arguments.out.as_deref(), format) {
        let write = |cause| Failure::Write { path: path.to_owned(), cause };
        let bytes = format.bytes(&found.arrays()).map_err(write)?;
        let placed = output::to_file(path, arguments.overwrite, |out| out.write_all(&bytes))?;
        if !arguments.common.quiet {
            remark(&format!("wrote {}", placed.path.display()));
        }
        if !placed.told(path) {
            return Ok(ExitStatus::CheckFailed);
        }
    }
    Ok(if found.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

fn truncation(arguments: &LinearArgs) -> Option<LinearTruncation> {
    let method = arguments.truncate.as_deref().and_then(truncation_method)?;
    Some(LinearTruncation { method, states: arguments.keep? })
}

fn format(path: &Path, overwrite: bool) -> Result<ArrayFormat, Failure> {
    let format = ArrayFormat::of(path).ok_or_else(|| Failure::ArrayEnding { path: path.to_owned() })?;
    output::check_file(path, overwrite)?;
    Ok(format)
}

fn state(word: &str) -> Result<LinearAt, Failure> {
    if let Some(known) = LinearAt::named(word) {
        return Ok(known);
    }
    let rate = word.split(',').map(|number| number.trim().parse().ok().filter(|rate: &f64| rate.is_finite()));
    let rate = rate.collect::<Option<Vec<f64>>>().and_then(|rate| <[f64; 3]>::try_from(rate).ok());
    rate.map(LinearAt::Rate).ok_or_else(|| Failure::NoSteadyState { word: word.to_owned() })
}
