use quasirigid_io::measured_file::read_measurements;
use quasirigid_study::infer::InferSettings;

use super::open;
use crate::args::{InferArgs, positive};
use crate::failure::Failure;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Infers numbers of a model from a measured history.
pub fn infer(arguments: &InferArgs) -> Result<ExitStatus, Failure> {
    let sigma = arguments.sigma.map(|sigma| positive("--sigma", sigma)).transpose()?;
    let study = open(&arguments.common)?;
    let data = read_measurements(&arguments.data, sigma)?;
    let asked = InferSettings { vary: arguments.vary.clone(), system: arguments.system };
    let found = study.infer(&data, &asked, &mut Terminal::of_whole(arguments.common.quiet))?;
    output::print_answer(arguments.common.json, || study.with_inputs(found.json()), || found.text())?;
    Ok(if found.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
