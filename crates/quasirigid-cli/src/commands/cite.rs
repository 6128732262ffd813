use quasirigid_study::cite::{bibtex, keys};
use serde_json::json;

use super::{notes, open};
use crate::args::Cite;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Prints the references of what a model uses.
pub fn cite(arguments: &Cite) -> Result<ExitStatus, Failure> {
    let study = open(&arguments.common)?;
    notes(&study, &arguments.common);
    let entries = bibtex(&study.model);
    if arguments.common.json {
        let object = json!({ "name": study.model.name, "keys": keys(&study.model), "bibtex": entries });
        output::print(&format!("{object:#}\n"))?;
    } else {
        output::print(&entries)?;
    }
    Ok(ExitStatus::Done)
}
