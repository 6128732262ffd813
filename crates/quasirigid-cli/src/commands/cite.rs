use quasirigid_study::cite::{bibtex, keys};
use serde_json::json;

use super::open;
use crate::args::Common;
use crate::failure::Failure;
use crate::{ExitStatus, output};

/// Prints the references of what a model uses.
pub fn cite(common: &Common) -> Result<ExitStatus, Failure> {
    let study = open(common)?;
    let entries = bibtex(&study.model);
    let object = || {
        study.with_inputs(json!({ "name": study.model.name, "keys": keys(&study.model), "bibtex": entries }))
    };
    output::print_answer(common.json, object, || entries.clone())?;
    Ok(ExitStatus::Done)
}
