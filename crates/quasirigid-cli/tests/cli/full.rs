//! The full system, ends of histories, and `verify`.

use quasirigid_io::record::RunRecord;

use crate::support::{MODEL, folder_with, one_line, ran, ran_in, ran_with};

/// A spin for which the springs of the model are too soft.
fn fast() -> String {
    MODEL.replace("angular_velocity = [0.12, 0.035, 0.02]", "angular_velocity = [9, 4, 3]")
}

#[test]
fn verify_fails_where_an_order_is_not_reached() {
    let ran = ran_with(&fast(), "verify model.toml --orders 1 --halvings 1 --revolutions 60");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stdout.contains("NOT REACHED"), "{}", ran.stdout);
}

/// A history that breaks off fails, and its table is valid up to there; one that an event of the file ends does not fail.
#[test]
fn ends_of_histories_are_told() {
    let force =
        "[[force]]\nkind = \"expression\"\non = \"tip\"\nforce = [\"1e-30*sqrt(20 - t)\", \"0\", \"0\"]\n";
    let line = "simulate model.toml --system full --times 0,10,19,30 --quiet";
    let ran = ran_with(&format!("{MODEL}{force}"), line);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let said = one_line(&ran.stderr);
    assert!(said.contains("not finite numbers beyond t = ") && said.contains("valid up to there"), "{said}");
    assert!(ran.stdout.lines().count() == 4 && !ran.stdout.contains("NaN"), "{}", ran.stdout);
    let still = ran_with(MODEL, "simulate model.toml --times 0 --json --quiet").json()["energy"].clone();
    let mark = (1.0 - 1e-7) * still.as_f64().unwrap();
    let stop = format!("{MODEL}stop = {{ energy = \"{mark} J\" }}\n");
    let ran = ran_with(&stop, "simulate model.toml --times 10000 --json");
    assert_eq!((ran.code, &ran.json()["status"]), (Some(0), &"event".into()), "{}", ran.stderr);
}

#[test]
fn the_rigid_body_has_no_coordinates() {
    for flag in ["--coordinates", "--displacements"] {
        let ran = ran_with(MODEL, &format!("simulate model.toml {flag} --system rigid"));
        let refusal = one_line(ran.refusal());
        assert!(refusal.contains(&format!("{flag}: the rigid body has no internal")), "{refusal}");
        assert!(refusal.contains("take --system reduced"), "{refusal}");
    }
}

#[test]
fn verify_refuses_what_means_nothing() {
    for (options, message) in [
        ("--orders 11", "choose orders from 0 to 10"),
        ("--revolutions 0", "more than 0 rotations"),
        ("--halvings 0", "1 to 12 halvings"),
    ] {
        let ran = ran(&format!("verify examples/three-masses/model.toml {options}"));
        assert!(ran.refusal().contains(message), "{}", ran.stderr);
    }
}

#[test]
fn a_run_proves_itself_where_the_model_asks() {
    let folder = folder_with(&format!("{MODEL}verify = {{ rotations = 2, orders = [1, 3] }}\n"));
    let ran = ran_in(folder.path(), "run model.toml -o spin");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stdout.contains("Every order is reached."), "{}", ran.stdout);
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    let verification = record.verification.unwrap();
    let found: Vec<_> = verification.orders.iter().map(|row| (&*row.form, row.p, row.reached)).collect();
    let rows = [("momentum", 1, true), ("momentum", 3, true), ("paper", 1, true), ("paper", 3, true)];
    assert_eq!((verification.reached, &found[..]), (true, &rows[..]));
    let page = std::fs::read_to_string(folder.path().join("spin/report.html")).unwrap();
    assert!(page.contains("Verification against the full system"));
}

#[test]
fn a_run_that_is_not_proved_fails_and_says_so() {
    let fast = fast() + "verify = { rotations = 60, orders = [1], halvings = 1 }\n";
    let ran = ran_with(&fast, "run model.toml -o spin --duration 1");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stdout.contains("NOT EVERY ORDER IS REACHED"), "{}", ran.stdout);
}

#[test]
fn a_tolerance_that_cannot_be_met_is_refused_before_the_work() {
    let ran = ran_with(MODEL, "simulate model.toml --system full --tolerance 1e-17");
    assert!(ran.refusal().contains("choose one from 1e-15 to 1e-2"), "{}", ran.stderr);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_a_full_run_with_a_clear_error() {
    let ran = ran_with(MODEL, "simulate model.toml --system full --out /dev/full");
    assert!(ran.refusal().contains("No space left on device"), "{}", ran.stderr);
}
