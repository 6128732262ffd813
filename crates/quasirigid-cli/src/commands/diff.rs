use quasirigid_study::difference::{difference, text};
use serde_json::json;

use crate::args::DiffArgs;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Says which inputs and which answers of two results differ.
pub fn diff(arguments: &DiffArgs) -> Result<ExitStatus, Failure> {
    let found = difference(&arguments.first, &arguments.second)?;
    output::print_answer(arguments.json, || json!(found), || text(&found))?;
    Ok(if found.same { ExitStatus::Done } else { ExitStatus::CheckFailed })
}
