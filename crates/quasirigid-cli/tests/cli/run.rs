//! `run`: the files of a record, its summary, its report, and its exit code.
//! Runs are short and have few rows; two runs must write equal bytes, since a record is compared years later.

use std::fs;

use insta::assert_snapshot;
use quasirigid_io::record::RunRecord;

use crate::support::{folder_of, names, ran_in};

const RECORD: [&str; 7] = [
    "history-reduced.csv",
    "history-rigid.csv",
    "record.json",
    "reduced.json",
    "report.html",
    "scene.json",
    "sphere.svg",
];
const SHORT: &str = "run model.toml --duration 30 --samples 40";

#[test]
fn run_writes_a_record_its_report_and_the_reduced_body() {
    let folder = folder_of("three-masses");
    let ran = ran_in(folder.path(), &format!("{SHORT} -o spin"));
    assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
    assert_eq!(names(&folder), ["model.toml", "spin"]);
    assert_eq!(names(folder.path().join("spin")), RECORD);
    assert!(
        ran.stdout.starts_with("three masses: The reduced equations hold at this spin.\n"),
        "{}",
        ran.stdout
    );
    assert!(ran.stdout.ends_with("\nRecord and report: spin/report.html\n"), "{}", ran.stdout);
}

#[test]
fn summary_gives_spin_nutation_dissipation_and_drift_of_both_bodies() {
    let folder = folder_of("three-masses");
    let ran = ran_in(folder.path(), SHORT);
    let drift_is_rounding = |line: &str| {
        if line.starts_with("  numerical drift") {
            "  numerical drift [rounding]".into()
        } else {
            line.to_owned()
        }
    };
    let text = ran.stdout.lines().map(drift_is_rounding).collect::<Vec<_>>().join("\n");
    assert_snapshot!(text, @"
    three masses: The reduced equations hold at this spin.
      Put into the full equations, order 3 leaves 0.0030 of the load.

    reduced body, 30.00 s (7.07891 revolutions; the run reached its end)
      spin at the start      0.723704      1.16382     0.561738 rad/s
      spin at the end         1.07911     0.772891     0.643289 rad/s
      nutation, greatest       62.174 to 62.124 degrees
      energy dissipated     0.0025340 J of 21.1636 J
      dissipation shares: spring p2-carrier 62.4 %, spring p1-p2 13.7 %, spring
          p0-p2 8.81 %, spring p0-carrier 6.65 %, spring p0-p1 5.02 %, spring
          p1-carrier 3.46 %
      numerical drift [rounding]

    rigid body, 30.00 s (7.07615 revolutions; the run reached its end)
      spin at the start      0.723704      1.16382     0.561738 rad/s
      spin at the end         1.06501     0.788765     0.647581 rad/s
      nutation, greatest       62.288 to 62.288 degrees
      energy dissipated             0 J of 21.0790 J
      numerical drift [rounding]

    Record and report: model-run/report.html
    ");
}

#[test]
fn record_reads_back_and_tells_what_was_run() {
    let folder = folder_of("three-masses");
    ran_in(folder.path(), &format!("{SHORT} -o spin --tolerance 1e-9"));
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    assert_eq!((&*record.model.name, &*record.model.file), ("three masses", "model.toml"));
    assert_eq!(record.version, env!("CARGO_PKG_VERSION"));
    assert!(record.validity.valid && record.notes.is_empty());
    let systems: Vec<_> = record.histories.iter().map(|history| &*history.system).collect();
    assert_eq!(systems, ["reduced", "rigid"]);
    for history in &record.histories {
        assert_eq!((&*history.status, history.tolerance), ("finished", 1e-9));
        assert!(history.columns.iter().all(|column| column.values.len() == 40));
        let column = |name: &str| &history.columns.iter().find(|column| column.name == name).unwrap().values;
        assert_eq!((column("t")[0], column("t")[39]), (0.0, 30.0));
        assert_eq!(column("qw")[0], 1.0);
    }
    assert!(record.histories[0].dissipated > 0.0 && record.histories[1].dissipated == 0.0);
    let shares = &record.histories[0].dissipation;
    assert!(shares.len() == 6 && (shares.values().sum::<f64>() - 1.0).abs() < 1e-12, "{shares:?}");
    assert_eq!(shares.keys().collect::<Vec<_>>(), record.reduction.dissipation.keys().collect::<Vec<_>>());
    assert!(record.histories[1].dissipation.is_empty());
}

#[test]
fn reduced_body_in_the_record_is_what_derive_prints() {
    let folder = folder_of("three-masses");
    ran_in(folder.path(), &format!("{SHORT} -o spin"));
    let written = fs::read_to_string(folder.path().join("spin/reduced.json")).unwrap();
    let mut printed = ran_in(folder.path(), "derive model.toml --json").json();
    assert!(printed.as_object_mut().unwrap().remove("inputs").is_some());
    assert_eq!(serde_json::from_str::<serde_json::Value>(&written).unwrap(), printed);
}

#[test]
fn report_starts_with_the_verdict() {
    for (example, words, sentence) in [
        ("three-masses", "Valid", "The reduced equations hold at this spin."),
        ("explorer1", "From the full system.", "The reduced equations DO NOT HOLD at this spin."),
    ] {
        let folder = folder_of(example);
        ran_in(folder.path(), &format!("{SHORT} -o spin"));
        let page = fs::read_to_string(folder.path().join("spin/report.html")).unwrap();
        let (_, body) = page.split_once("<body>").unwrap();
        let verdict = body.find("class=\"verdict").unwrap();
        assert!(body.find(sentence).unwrap() - verdict < 1000, "the sentence stands in the verdict");
        assert!(body[verdict..].contains(&format!("<strong>{words}</strong>")));
        assert!(verdict < body.find("<h2").unwrap(), "no section comes before the verdict");
    }
}

#[test]
fn theory_that_fails_exits_with_1_and_still_writes() {
    let folder = folder_of("explorer1");
    let ran = ran_in(folder.path(), &format!("{SHORT} -o spin"));
    assert_eq!((ran.code, &*ran.stderr), (Some(1), ""));
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    assert!(!record.validity.valid);
    let systems: Vec<&str> = record.histories.iter().map(|history| &*history.system).collect();
    assert_eq!(systems, ["full", "rigid"], "the full system in place of the reduced body");
    assert!(record.histories[0].dissipated > 1.0);
    assert!(
        record.notes[0].starts_with("The truncated series has no angular momentum for this angular velocity")
    );
    assert!(ran.stdout.contains("  Note: The truncated series has no angular momentum"), "{}", ran.stdout);
}

#[test]
fn folder_is_named_after_the_model_when_nothing_names_it() {
    let folder = folder_of("axial-mass");
    fs::rename(folder.path().join("model.toml"), folder.path().join("top.toml")).unwrap();
    let ran = ran_in(folder.path(), "run top.toml --duration 5");
    assert_eq!(ran.code, Some(0));
    assert_eq!(names(&folder), ["top-run", "top.toml"]);
}

#[test]
fn json_is_the_record() {
    let folder = folder_of("axial-mass");
    let ran = ran_in(folder.path(), &format!("{SHORT} -o spin --json"));
    let written = fs::read_to_string(folder.path().join("spin/record.json")).unwrap();
    assert_eq!(ran.json(), serde_json::from_str::<serde_json::Value>(&written).unwrap());
}

#[test]
fn same_input_writes_the_same_bytes() {
    let folder = folder_of("three-masses");
    for name in ["one", "two"] {
        ran_in(folder.path(), &format!("{SHORT} -o {name}"));
    }
    for file in RECORD {
        let bytes = |name: &str| fs::read(folder.path().join(name).join(file)).unwrap();
        assert_eq!(bytes("one"), bytes("two"), "{file}");
    }
}

#[test]
fn command_options_reach_the_record() {
    let folder = folder_of("axial-mass");
    ran_in(folder.path(), &format!("{SHORT} -o spin --form angular-velocity --order 4"));
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    assert_eq!(record.reduction.order, 4);
    assert!(record.histories[0].form.starts_with("spin"), "{}", record.histories[0].form);
}
