//! Linear models as files for other programs.

use std::path::Path;

use pyo3::prelude::*;
use quasirigid_io::array_file::ArrayFormat;
use quasirigid_study::linear::LinearObject;

use crate::failure::Failure;

/// The bytes of a file named so, `.npz` or `.mat`, of a linear model in the JSON of its answer.
#[pyfunction]
pub fn linear_file(name: &str, model: &str) -> PyResult<Vec<u8>> {
    let refused = |why: String| Failure::Input(why);
    let format = ArrayFormat::of(Path::new(name));
    let format = format.ok_or_else(|| refused(format!("{name}: give a .mat or a .npz file")))?;
    let model: LinearObject =
        serde_json::from_str(model).map_err(|error| refused(format!("no linear model: {error}")))?;
    Ok(format.bytes(&model.arrays())?)
}
