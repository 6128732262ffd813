use std::path::Path;

use proptest::prelude::*;
use quasirigid_io::model::{Model, ModelError};

use super::{CARRIER, HINGED, POINT};

proptest! {
    /// A good model with some of its text replaced is read or refused with places inside the text.
    #[test]
    fn no_mutation_makes_it_panic(start in 0usize..700, length in 0usize..12, patch in "([a-z0-9]|[\\[\\]={}.,\"'#\n -]|é){0,12}") {
        let spring = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = \"6 N/cm\"\ndamping = [1, 2, 3]\n";
        let hinge = "axes = [[0, 0, 1]]\nstiffness = [[3]]\n";
        let rest = "[support]\nkind = \"free\"\n[initial]\nangular_velocity = [1, \"2 rpm\", 3]\n[run]\norder = 3\n";
        let mut text = format!("{CARRIER}{POINT}motion = {{ line = [1, 0, 0] }}\n{spring}{HINGED}{hinge}{rest}");
        let start = start.min(text.len());
        text.replace_range(start..(start + length).min(text.len()), &patch);
        if let Err(error) = Model::parse(Path::new("model.toml"), &text) {
            prop_assert!(error.to_string().starts_with("model.toml:"));
            let ModelError::Invalid { diagnostics, .. } = error else { return Err(TestCaseError::fail("readable")) };
            prop_assert!(diagnostics.iter().all(|diagnostic| text.get(diagnostic.span.clone()).is_some()));
        }
    }

    #[test]
    fn no_text_makes_it_panic(text in "(\\PC|\n|\\[\\[?(point|spring|carrier)\\]\\]?\n){0,40}") {
        let _ = Model::parse(Path::new("model.toml"), &text);
    }
}
