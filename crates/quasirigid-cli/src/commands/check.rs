use super::{open_with, whole};
use crate::args::Common;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Checks the validity of the reduced equations and prints the verdict.
pub fn check(common: &Common) -> Result<ExitStatus, Failure> {
    // The text begins with what was left out of files.
    let study = open_with(common, |study, note| common.json || !study.model.file_notes.contains(note))?;
    let report = whole(common, || study.check())?;
    output::print_answer(common.json, || study.with_inputs(report.json()), || report.text())?;
    Ok(if report.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
