use super::{open, whole, with_inputs};
use crate::args::Common;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Checks the validity of the reduced equations and prints the verdict.
pub fn check(common: &Common) -> Result<ExitStatus, Failure> {
    let study = open(common)?;
    let report = whole(common, || study.check())?;
    output::print_answer(common.json, || with_inputs(&study, report.json()), || report.text())?;
    Ok(if report.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
