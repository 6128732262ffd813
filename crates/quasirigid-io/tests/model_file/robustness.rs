//! Random and mutated model files: read, or refused with places inside the text, and never a panic.
//! Mutations start from models with every kind of element, since random text alone hardly passes the TOML parser.

use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use quasirigid_io::model::{Model, ModelError};

use super::{CARRIER, HINGED, POINT, ROCK, made_of};

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1978), ..ProptestConfig::default() })]

    /// A good model with some of its text replaced is read or refused with places inside the text.
    #[test]
    fn no_mutation_makes_it_panic(start in 0usize..1300, length in 0usize..12, elastic: bool, patch in "([a-z0-9]|[\\[\\]={}.,\"'#\n -]|é){0,12}") {
        let mut text = if elastic { elastic_throughout() } else { good() };
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

/// A model with a table of every kind that goes with a carrier.
fn good() -> String {
    let spring =
        "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = \"6 N/cm\"\ndamping = [1, 2, 3]\n";
    let hinge = "axes = [[0, 0, 1]]\nstiffness = [[3]]\n";
    let force = "[[force]]\nkind = \"expression\"\non = \"tip\"\nforce = [\"-2*\\u0076x\", 'sin(t)', 0]\n";
    let pull =
        "[[force]]\nkind = \"thrust\"\non = \"carrier\"\nat = [0, 0, 1]\nforce = [0, 0, 1]\nperiod = 3\n";
    let orbit =
        "[[force]]\nkind = \"central-gravity\"\norbit = { body = \"Earth\", semi_major_axis = 7e6 }\n";
    let support = "[support]\nkind = \"prescribed\"\npoint = [0, 0, 0]\nacceleration = [\"0\", \"t\", 3]\n";
    let initial =
        "[initial]\nangular_velocity = [1, \"2 rpm\", 3]\ndisplacements = { tip = [1, 0, 0], boom = [1] }\n";
    let run = "[run]\norder = 3\nsystems = [\"full\"]\nstop = { energy = 1 }\nverify = { orders = [1, 2] }\n";
    let rest = format!("{force}{pull}{orbit}{support}{initial}{run}");
    format!("{CARRIER}{POINT}motion = {{ line = [1, 0, 0] }}\n{spring}{HINGED}{hinge}{rest}")
}

/// A model with a table of every kind that goes without a carrier.
fn elastic_throughout() -> String {
    let maxwell = "rheology = { kind = \"maxwell\", time = \"2 h\", range = [3600, 9e3] }\n";
    let ice = "[material.ice]\ndensity = 900\nshear = \"3 GPa\"\npoisson = 0.3\n";
    let rows =
        "[material.ice.rheology]\nkind = \"table\"\nrows = [[\"1 Hz\", \"9 GPa\", 0.1], [9, 1e9, 0.2]]\n";
    let initial = "[initial]\ndisplacements = \"rest\"\nperiods = { rotation = 9, precession = 2, mode = \"long-axis\" }\n";
    let run = "[run]\nevolve = { until = \"98 % of I3\", duration = \"1 Gyr\", samples = 99 }\n";
    made_of(&format!("{ROCK}{maxwell}{ice}{rows}{initial}{run}"))
}

#[test]
fn the_texts_that_are_mutated_are_good() {
    assert_eq!(super::read(&good()).assembly.forces.len(), 3);
    assert!(super::read(&elastic_throughout()).extremes.is_some());
}

#[test]
fn formulas_without_end_are_refused_without_delay() {
    let start = std::time::Instant::now();
    let force = |formula: &str| {
        let force = "[[force]]\nkind = \"expression\"\non = \"tip\"\n";
        super::refusal_of(&format!("{force}force = [\"{formula}\", \"0\", \"0\"]\n"))
    };
    insta::assert_snapshot!(force(&"t + ".repeat(25_000)), @"
    model.toml:12:11: `force`: the formula has 100000 bytes, more than 16384; split it or tabulate it
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    insta::assert_snapshot!(force(&"(".repeat(16_000)), @"
    model.toml:12:212: `force`: more than 200 parentheses, signs or powers inside one another; split the formula
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    insta::assert_snapshot!(force(&"(".repeat(1_000_000)), @"
    model.toml:12:11: `force`: the formula has 1000000 bytes, more than 16384; split it or tabulate it
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    insta::assert_snapshot!(force("1e400"), @"
    model.toml:12:11: `force`: `1e400` is beyond the largest number, 1.8e308
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    insta::assert_snapshot!(force("0*nan"), @"
    model.toml:12:13: `force`: unknown name `nan`; known are `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `wx`, `wy`, `wz`, `qw`, `qx`, `qy`, `qz`, `pi`, `e`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    // work that grows with the square of the length takes minutes
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}

#[test]
fn many_displacements_are_read_without_delay() {
    let points: String = (0..100_000)
        .map(|index| format!("[[point]]\nname = \"p{index}\"\nmass = 1\nposition = [0, 0, 1]\n"))
        .collect();
    let displacements: String = (0..100_000).map(|index| format!("p{index} = [0, 0, 0.1]\n")).collect();
    let start = std::time::Instant::now();
    let _ = super::read(&format!("{CARRIER}{points}[initial.displacements]\n{displacements}"));
    // ten times what an unoptimised build on a busy machine needs; quadratic work takes minutes
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}
