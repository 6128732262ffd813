//! Study files, and the points of their grids.

use std::path::Path;

use quasirigid_io::model::{KeyValue, ModelError};
use quasirigid_io::study_file::{StudyFile, Values};

/// Words of study files.
pub const WORDS: &[&str] = &[
    "[vary]\n",
    "[answer]\n",
    "[table]\n",
    "model = \"m.toml\"\n",
    "seed = ",
    "samples = ",
    "sampling = \"sobol\"\n",
    "part = ",
    "linear = [",
    "geometric = [",
    "list = [",
    "uniform = [",
    "log-uniform = [",
    "normal = {",
    "log-normal = {",
    "count = ",
    "quantities = [",
    "\"evolve.time\"",
    "\"check.valid\"",
    "percentiles = [",
    "times = [",
    "decades = ",
    "sigma = ",
    "median = ",
    "mean = ",
    "deviation = ",
    "min = ",
    "max = ",
    "columns = {",
    "keep = [",
    "file = ",
    "1e308",
    "\"1 km\"",
    "nan",
    "inf",
];

/// Points of a grid that are looked at.
const GRID_POINTS: usize = 5;

pub fn text(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match StudyFile::parse(Path::new("study.toml"), text) {
        Ok(study) => {
            for varied in &study.vary {
                let Values::Grid(grid) = &varied.values else { continue };
                assert!(!grid.is_empty(), "a grid has points");
                for look in 0..GRID_POINTS {
                    let point = grid.point((grid.len() - 1) / (GRID_POINTS - 1) * look);
                    assert!(
                        !matches!(point, KeyValue::Number(number) if !number.is_finite()),
                        "{}: {point}",
                        varied.key
                    );
                }
            }
        }
        Err(ModelError::Invalid { diagnostics, .. }) => {
            assert!(!diagnostics.is_empty(), "a refusal says why");
            assert!(
                diagnostics.iter().all(|one| text.get(one.span.clone()).is_some()),
                "places are in the text"
            );
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
