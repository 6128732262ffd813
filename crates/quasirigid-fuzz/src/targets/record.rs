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

const RECORD: &[u8] = include_bytes!("../../fixtures/record/record.json");
const SCENE: &[u8] = include_bytes!("../../fixtures/record/scene.json");
const HISTORY: &[u8] = include_bytes!("../../fixtures/record/history-reduced.csv");
const EVOLUTION: &[u8] = include_bytes!("../../fixtures/record/evolution.csv");
const BACKBONE: &[u8] = include_bytes!("../../fixtures/record/backbone.csv");

pub fn json(bytes: &[u8]) {
    read(("record.json", bytes), ("history-reduced.csv", HISTORY), ("scene.json", SCENE));
}

pub fn scene(bytes: &[u8]) {
    read(("record.json", RECORD), ("history-reduced.csv", HISTORY), ("scene.json", bytes));
}

pub fn csv(bytes: &[u8]) {
    read(("record.json", RECORD), ("history-reduced.csv", bytes), ("scene.json", SCENE));
}

pub fn npz(bytes: &[u8]) {
    read(("record.json", RECORD), ("history-reduced.npz", bytes), ("scene.json", SCENE));
}

pub fn parquet(bytes: &[u8]) {
    read(("record.json", RECORD), ("history-reduced.parquet", bytes), ("scene.json", SCENE));
}

/// The log of a run in work.
pub fn rows(bytes: &[u8]) {
    read(("record.json", RECORD), ("history-reduced.rows", bytes), ("scene.json", SCENE));
}

type File<'a> = (&'a str, &'a [u8]);

fn read(record: File<'_>, history: File<'_>, scene: File<'_>) {
    let others = [("evolution.csv", EVOLUTION), ("backbone.csv", BACKBONE)];
    with_files(&[record, history, scene, others[0], others[1]], |folder| match RunRecord::read(folder) {
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
