//! `audit`: exit codes, limits, badges, and arguments that are refused.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{MODEL, one_line, ran, ran_in};

const HISTORY: &str = "examples/invented-damping/euler.csv";

#[test]
fn the_example_is_answered_in_words_and_for_machines() {
    let found = ran(&format!("audit {HISTORY} --inertia 10,14,17"));
    assert_eq!((found.code, &*found.stderr), (Some(0), ""));
    let text = one_line(&found.stdout);
    assert!(
        text.starts_with(
            "euler.csv: The history INVENTS driving: the wobble about the axis of greatest inertia GROWS"
        ),
        "{text}"
    );
    let json = ran(&format!("audit {HISTORY} --inertia 10,14,17 --json")).json();
    let constant = json["invented_time_constant"].as_f64().unwrap();
    assert!((constant / -6850.0 - 1.0).abs() < 0.02, "{constant}"); // as tumble.py of the survey has it
    assert!((json["energy_drift"].as_f64().unwrap() / 4.2614e-3 - 1.0).abs() < 1e-3);
    assert!((json["momentum_drift"].as_f64().unwrap() / 1.6128e-3 - 1.0).abs() < 1e-3);
    assert_eq!(json["worst_interval"].as_array().unwrap().len(), 2);
    assert_eq!(json["inputs"]["files"][0]["name"], "euler.csv");
    assert_eq!(
        json["sentence"].as_str().unwrap(),
        one_line(&found.stdout.split_once("\n  note").unwrap().0["euler.csv: ".len()..])
    );
}

#[test]
fn limits_decide_the_exit_code() {
    for (limits, code) in [
        ("--limit 1e-2", 0),
        ("--limit 1e-6", 1),
        ("--min-time-constant 1h", 0),
        ("--min-time-constant 1yr", 1),
    ] {
        let found = ran(&format!("audit {HISTORY} --inertia 10,14,17 {limits}"));
        assert_eq!(found.code, Some(code), "{limits}");
        assert_eq!(one_line(&found.stdout).contains("NOT within"), code == 1, "{}", found.stdout);
    }
}

#[test]
fn a_badge_is_written_once() {
    let folder = TempDir::new().unwrap();
    let history = fs::read(format!("{}/{HISTORY}", crate::support::ROOT)).unwrap();
    fs::write(folder.path().join("spin.csv"), history).unwrap();
    let line = "audit spin.csv --inertia 10,14,17 --badge badge.json";
    assert!(ran_in(folder.path(), line).stderr.contains("wrote badge.json"));
    let badge: Value = serde_json::from_slice(&fs::read(folder.path().join("badge.json")).unwrap()).unwrap();
    assert_eq!(
        (&badge["schemaVersion"], &badge["label"], &badge["color"]),
        (&1.into(), &"invented damping".into(), &"red".into())
    );
    assert!(badge["message"].as_str().unwrap().starts_with("grows e-fold in 114"), "{badge}");
    assert!(ran_in(folder.path(), line).refusal().contains("already exists"));
    assert_eq!(ran_in(folder.path(), &format!("{line} --overwrite --quiet")).stderr, "");
}

#[test]
fn the_body_is_given_once() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("model.toml"), MODEL).unwrap();
    fs::write(folder.path().join("spin.csv"), "t,wx,wy,wz\n0,0,0,1\n1,0,0,1\n").unwrap();
    for (line, words) in [
        ("audit spin.csv", "the inertia of the body is not given"),
        ("audit spin.csv model.toml --inertia 1,2,3", "the inertia is given twice"),
        ("audit spin.csv model.toml model.toml", "are both models"),
        ("audit model.toml", "there is no history to audit"),
        ("audit spin.csv --inertia 1,2", "three moments XX,YY,ZZ or six entries"),
        ("audit spin.csv --inertia 1,2,4", "or exceed the sum of the other two"),
        ("audit spin.csv --inertia 1,2,3 --limit 0", "--limit is 0, but must be positive"),
        ("audit spin.csv --inertia 1,2,3 --min-time-constant 3m", "--min-time-constant 3m"),
        ("audit none.csv --inertia 1,2,3", "none.csv"),
        ("audit spin.csv --inertia 1,2,3 --steps 1", "1 steps for 1 histories"),
    ] {
        let refused = ran_in(folder.path(), line);
        assert!(one_line(refused.refusal()).contains(words), "{line}: {}", refused.stderr);
    }
    let found = ran_in(folder.path(), "audit spin.csv model.toml");
    assert!(
        found.code == Some(0) && one_line(&found.stdout).contains("keeps energy and angular momentum"),
        "{found:?}"
    );
}
