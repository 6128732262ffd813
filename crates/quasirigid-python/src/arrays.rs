//! Files of named arrays, as the program writes them.

use std::path::Path;

use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use quasirigid_io::array_file::{ArrayFormat, ArrayValue, NamedArray};

/// The bytes of a file named so, `.npz` or `.mat`, with these matrices, texts and lists of texts.
#[pyfunction]
pub fn array_file(
    name: &str,
    matrices: Vec<(String, PyReadonlyArray2<'_, f64>)>,
    texts: Vec<(String, String)>,
    lists: Vec<(String, Vec<String>)>,
) -> PyResult<Vec<u8>> {
    let format = ArrayFormat::of(Path::new(name));
    let format = format.ok_or_else(|| PyValueError::new_err(format!("{name}: give a .npz or .mat file")))?;
    let matrix = |matrix: &PyReadonlyArray2<'_, f64>| {
        let view = matrix.as_array();
        ArrayValue::Matrix { size: [view.nrows(), view.ncols()], entries: view.iter().copied().collect() }
    };
    let matrices = matrices.iter().map(|(name, own)| (name.clone(), matrix(own)));
    let texts = texts.into_iter().map(|(name, text)| (name, ArrayValue::Text(text)));
    let lists = lists.into_iter().map(|(name, list)| (name, ArrayValue::Texts(list)));
    let arrays = matrices.chain(texts).chain(lists).map(|(name, value)| NamedArray { name, value });
    Ok(format.bytes(&arrays.collect::<Vec<_>>())?)
}
