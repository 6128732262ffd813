//! Linear models from the JSON of their answers: as files for other programs, and with fewer states.

use std::path::Path;

use pyo3::prelude::*;
use quasirigid_io::array_file::ArrayFormat;
use quasirigid_study::linear::{LinearObject, LinearTruncation, truncation_method};

use crate::answers::{Answer, of_linear};
use crate::failure::Failure;

/// The bytes of a file named so, `.npz` or `.mat`, of a linear model in the JSON of its answer.
#[pyfunction]
pub fn linear_file(name: &str, model: &str) -> PyResult<Vec<u8>> {
    let format = ArrayFormat::of(Path::new(name));
    let format = format.ok_or_else(|| Failure::Input(format!("{name}: give a .mat or a .npz file")))?;
    Ok(format.bytes(&read(model)?.arrays())?)
}

/// A linear model in the JSON of its answer, with so many states.
#[pyfunction]
pub fn linear_truncated(model: &str, method: &str, states: usize, notes: Vec<String>) -> PyResult<Answer> {
    let unknown = || Failure::Input(format!("method = {method:?}; give 'balanced' or 'modal'"));
    let method = truncation_method(method).ok_or_else(unknown)?;
    let found = read(model)?.truncated(LinearTruncation { method, states }).map_err(Failure::from)?;
    Ok(of_linear(&found, notes))
}

fn read(model: &str) -> Result<LinearObject, Failure> {
    serde_json::from_str(model).map_err(|error| Failure::Input(format!("no linear model: {error}")))
}
