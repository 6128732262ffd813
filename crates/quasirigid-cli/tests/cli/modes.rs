//! `modes`: its flags, its exit code, and what is refused.

use crate::support::{MODEL, folder_of, numbers, one_line, ran_in, ran_with};

#[test]
fn what_has_no_steady_state_fails_and_an_axis_under_forces_is_refused() {
    let folder = folder_of("gravity-gradient");
    let eccentric = ran_in(folder.path(), "modes model.toml");
    assert!(eccentric.code == Some(1) && one_line(&eccentric.stdout).contains("is eccentric (0.072)"));
    let axis = ran_in(folder.path(), "modes model.toml --axis least");
    assert!(one_line(axis.refusal()).contains("--axis names a principal axis"), "{axis:?}");
}

#[test]
fn a_spin_has_three_components() {
    insta::assert_snapshot!(ran_with(MODEL, "modes model.toml --spin 1,2").refusal().trim(), @"quasirigid: an angular velocity has three components, not 2: --spin 0,0,1.5");
    let asked = ran_with(MODEL, "modes model.toml --spin 0,0,0.3 --json").json();
    let spin: f64 = numbers(&asked["spin"]).iter().map(|w| w * w).sum();
    assert!((spin.sqrt() - 0.3).abs() < 1e-12, "{asked}");
}

#[test]
fn overdamped_motions_are_listed_on_request() {
    let heavy = MODEL.replace("damping = 30.0", "damping = 3000.0");
    let [text, all] =
        ["", " --all"].map(|flag| ran_with(&heavy, &format!("modes model.toml --axis least{flag}")).stdout);
    assert!(one_line(&text).contains("overdamped motions, of"), "{text}");
    assert!(!all.contains("overdamped") && all.lines().count() > text.lines().count(), "{all}");
}
