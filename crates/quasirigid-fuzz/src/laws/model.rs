//! A model text through every door of the program: read, assembled, reduced, judged, exported.

use std::path::Path;

use quasirigid_io::model::{Model, ModelError};
use quasirigid_study::modes::SteadySpinSettings;
use quasirigid_study::{Study, StudyError};

use super::{dissipation, exports, momentum, size};

/// Name of the model, in the folder of the files that models may name.
const MODEL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/model/model.toml");
/// Highest order of the reduction.
const ORDER: usize = 4;
/// Most coordinates of a body that is judged by its spin.
const JUDGED: usize = 24;

/// Reads a model, and holds the body, if it is one, to the laws.
///
/// # Panics
/// Where a law or a promise of a reader is broken.
pub fn check(text: &str) {
    let model = match Model::parse(Path::new(MODEL), text) {
        Ok(model) => model,
        Err(error) => return refused(text, &error),
    };
    if !size::is_small(&model.assembly) {
        return;
    }
    let order = model.run.order.min(ORDER);
    let study = match Study::new(model, Some(order)) {
        Ok(study) => study,
        Err(StudyError::Model(error)) => return refused(text, &error),
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    dissipation::of_body(&study.body);
    if study.body.coordinates().len() > size::COORDINATES {
        return;
    }
    let equations = match study.derive() {
        Ok(equations) => equations,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let reduced = equations.reduced();
    dissipation::of_reduced(reduced);
    momentum::of_reduced(reduced);
    exports::agree(&study.body, reduced, &equations);
    // a spinning liquid takes a factorisation for each frequency that a mode tries
    if study.body.coordinates().len() > JUDGED || !study.body.memories().is_empty() {
        return;
    }
    momentum::of_full(&study, reduced);
    match study.check() {
        Ok(report) => assert!(!report.sentence().is_empty() && report.json().is_object()),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    match study.modes(SteadySpinSettings::default()) {
        Ok(modes) => assert!(modes.json("body").is_object()),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A refusal says why, and where in the text.
fn refused(text: &str, error: &ModelError) {
    assert!(!error.to_string().is_empty());
    if let ModelError::Invalid { diagnostics, .. } = error {
        assert!(!diagnostics.is_empty(), "a refusal says why");
        for one in diagnostics {
            assert!(
                text.get(one.span.clone()).is_some(),
                "{:?} is a place of the text: {}",
                one.span,
                one.message
            );
        }
    }
}
