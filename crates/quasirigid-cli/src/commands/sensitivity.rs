use super::{Picture, open};
use crate::args::SensitivityArgs;
use crate::failure::Failure;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Gives the derivatives of an answer with respect to keys of the model.
pub fn sensitivity(arguments: &SensitivityArgs) -> Result<ExitStatus, Failure> {
    let picture = Picture::at(arguments.figure.as_deref(), arguments.overwrite)?;
    let study = open(&arguments.common)?;
    let found =
        study.sensitivity(&arguments.of, &arguments.with, &mut Terminal::of_whole(arguments.common.quiet))?;
    output::print_answer(
        arguments.common.json,
        || study.with_inputs(found.json()),
        || found.text(arguments.all),
    )?;
    let drawn = picture.write(|| found.picture(), arguments.common.quiet)?;
    let asked = !arguments.with.is_empty();
    Ok(if asked && !found.not_known.is_empty() || !drawn {
        ExitStatus::CheckFailed
    } else {
        ExitStatus::Done
    })
}
