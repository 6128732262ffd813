use super::{notes, open, whole};
use crate::args::Check;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Checks the validity of the reduced equations and prints the verdict.
pub fn check(arguments: &Check) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    notes(&study, &arguments.common);
    let report = whole(&arguments.common, || study.check())?;
    if arguments.common.json {
        output::print(&format!("{:#}\n", report.json()))?;
    } else {
        output::print(&report.text())?;
    }
    Ok(if report.holds() { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
