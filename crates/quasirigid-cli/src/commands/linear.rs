use quasirigid_study::linear::{LinearAt, LinearSettings};

use super::{open, whole};
use crate::args::LinearArgs;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Gives the linear model about a steady state.
pub fn linear(arguments: &LinearArgs) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    let at = arguments.at.as_deref().map(state).transpose()?;
    let asked = LinearSettings { at, inputs: arguments.inputs.clone(), outputs: arguments.outputs.clone() };
    let found = whole(&arguments.common, || study.linear(&asked))?;
    output::print_answer(arguments.common.json, || found.json(), || found.text())?;
    Ok(ExitStatus::Done)
}

fn state(word: &str) -> Result<LinearAt, Failure> {
    if let Some(known) = LinearAt::named(word) {
        return Ok(known);
    }
    let rate = word.split(',').map(|number| number.trim().parse().ok().filter(|rate: &f64| rate.is_finite()));
    let rate = rate.collect::<Option<Vec<f64>>>().and_then(|rate| <[f64; 3]>::try_from(rate).ok());
    rate.map(LinearAt::Rate).ok_or_else(|| Failure::NoSteadyState { word: word.to_owned() })
}
