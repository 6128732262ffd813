//! The chapter of the guide on model files.

use std::path::Path;

use quasirigid_io::model::Model;

use super::{CARRIER, HINGED, POINT};

/// Files that a model names stand in `data`, beside the chapter.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/guide/model.toml");

/// Complete models are read as they stand, parts of a model with a body whose names they use.
#[test]
fn every_model_in_the_guide_is_read() {
    let body = format!("{CARRIER}{POINT}{HINGED}axes = [[0, 1, 0], [0, 0, 1]]\nstiffness = 3\n");
    let chapter = include_str!("../../../../docs/guide/02-model-file.md");
    let blocks = chapter.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next());
    let mut count = 0;
    for block in blocks {
        let complete = block.starts_with("# complete");
        let text = if complete { block.to_owned() } else { format!("{body}{block}") };
        let model = Model::parse(Path::new(FILE), &text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(model.assembly.check(), [], "{block}");
        count += 1;
    }
    assert_eq!(count, 7);
}
