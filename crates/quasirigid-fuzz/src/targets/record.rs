//! Records of runs: one file of a folder is the input, the others are those of a good record; what reads well is drawn.

use std::path::Path;

use quasirigid_io::record::RunRecord;
use quasirigid_report::{GltfOptions, figure_names, gltf, page, picture};

use super::disk::with_files;

/// Words of JSON files.
pub const JSON: &[&str] = &[
    "null",
    "true",
    "[]",
    "{}",
    "\"\"",
    "1e999",
    "-1",
    "\"columns\":",
    "\"rows\":",
    "[[[[",
    "\\ud800",
    ",",
    "18446744073709551615",
];

/// Files of a good record.
const GOOD: [(&str, &[u8]); 5] = [
    ("record.json", include_bytes!("../../fixtures/record/record.json")),
    ("scene.json", include_bytes!("../../fixtures/record/scene.json")),
    ("history-reduced.csv", include_bytes!("../../fixtures/record/history-reduced.csv")),
    ("evolution.csv", include_bytes!("../../fixtures/record/evolution.csv")),
    ("backbone.csv", include_bytes!("../../fixtures/record/backbone.csv")),
];

/// Reads the good record with one of its files replaced, in any format; `.rows` is the log of a run in work.
pub fn read(name: &str, bytes: &[u8]) {
    let stem = |name: &str| Path::new(name).file_stem().map(ToOwned::to_owned);
    let files = GOOD.map(|good| if stem(good.0) == stem(name) { (name, bytes) } else { good });
    with_files(&files, |folder| match RunRecord::read(folder) {
        Ok(record) => draw(folder, &record),
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}

fn draw(folder: &Path, record: &RunRecord) {
    assert!(page(record).contains("</html>"));
    for name in figure_names(record) {
        let drawn = picture(record, name);
        assert!(drawn.is_none_or(|drawn| !drawn.contains("NaN")), "figure {name} has numbers alone");
    }
    if let Some(scene) = &record.scene {
        let _ = gltf(scene, &GltfOptions::default());
    }
    for history in &record.histories {
        let _ = history.whole_table(folder);
    }
}
