//! The folder of `run`: never half-written, never lost.

use std::fs;

use insta::assert_snapshot;
use quasirigid_io::record::RunRecord;

use crate::support::{folder_of, names, ran_in};

const SHORT: &str = "run model.toml --duration 5 --samples 6 -o spin";
/// Many seconds of work, which a refusal must not wait for; at its end the message would be another.
const LONG: &str = "run model.toml --duration 20h --samples 5";

#[test]
fn existing_record_is_kept_unless_overwriting_is_asked_for() {
    let folder = folder_of("axial-mass");
    let spin = folder.path().join("spin");
    assert_eq!(ran_in(folder.path(), SHORT).code, Some(0));
    let before = fs::read(spin.join("record.json")).unwrap();
    assert_snapshot!(ran_in(folder.path(), SHORT).refusal(), @"quasirigid: spin already exists; choose another with -o, or add --overwrite");
    assert_eq!(fs::read(spin.join("record.json")).unwrap(), before);
    let again = ran_in(folder.path(), &format!("{SHORT} --overwrite --order 5"));
    assert_eq!((again.code, &*again.stderr), (Some(0), ""));
    assert_eq!(RunRecord::read(&spin).unwrap().reduction.order, 5);
    assert_eq!(names(&folder), ["model.toml", "spin"], "nothing is left beside it");
}

#[test]
fn nothing_of_an_older_record_stays_in_a_newer_one() {
    let folder = folder_of("axial-mass");
    ran_in(folder.path(), SHORT);
    fs::copy(
        format!("{}/examples/explorer1/model.toml", crate::support::ROOT),
        folder.path().join("model.toml"),
    )
    .unwrap();
    assert_eq!(ran_in(folder.path(), &format!("{SHORT} --overwrite")).code, Some(1));
    assert!(!names(folder.path().join("spin")).contains(&"history-reduced.csv".to_owned()));
}

#[test]
fn older_record_survives_a_run_that_fails() {
    let folder = folder_of("axial-mass");
    ran_in(folder.path(), SHORT);
    for options in ["--tolerance 1", "--order 13", "--samples 1", "--duration 0"] {
        ran_in(folder.path(), &format!("run model.toml -o spin --overwrite {options}")).refusal();
        assert!(RunRecord::read(&folder.path().join("spin")).is_ok(), "{options}");
        assert_eq!(names(&folder), ["model.toml", "spin"], "{options}");
    }
}

/// A folder that is no record of ours, or has further files, belongs to somebody.
#[test]
fn folder_that_is_not_only_a_record_is_never_replaced() {
    let folder = folder_of("axial-mass");
    let spin = folder.path().join("spin");
    let assert_kept = |what: &str| {
        let before = names(&spin);
        for option in ["", " --overwrite"] {
            let refused = ran_in(folder.path(), &format!("{SHORT}{option}"));
            assert!(refused.refusal().contains("is not only a record of"), "{what}: {}", refused.stderr);
            assert_eq!(names(&spin), before, "{what}");
        }
    };
    fs::create_dir(&spin).unwrap();
    assert_kept("an empty folder");
    fs::write(spin.join("notes.txt"), "precious").unwrap();
    assert_kept("a folder with notes");
    fs::remove_dir_all(&spin).unwrap();
    fs::create_dir(&spin).unwrap();
    fs::write(spin.join("record.json"), "{\"artist\": \"Nina Simone\"}").unwrap();
    assert_kept("somebody's record");
    fs::remove_dir_all(&spin).unwrap();
    assert_eq!(ran_in(folder.path(), SHORT).code, Some(0));
    fs::write(spin.join("notes.txt"), "precious").unwrap();
    assert_kept("a record with notes");
    assert_eq!(fs::read_to_string(spin.join("notes.txt")).unwrap(), "precious");
}

#[test]
fn file_in_the_place_of_the_folder_is_never_replaced() {
    let folder = folder_of("axial-mass");
    fs::write(folder.path().join("spin"), "precious").unwrap();
    let refused = ran_in(folder.path(), &format!("{SHORT} --overwrite"));
    assert_snapshot!(refused.refusal(), @r"
    quasirigid: spin already exists and is not only a record of quasirigid, so it
    is never replaced; choose another folder with -o
    ");
    assert_eq!(fs::read_to_string(folder.path().join("spin")).unwrap(), "precious");
}

#[test]
fn place_that_takes_no_folder_is_refused_before_the_work() {
    let folder = folder_of("explorer1-stiff");
    let refused = |path: &str| ran_in(folder.path(), &format!("{LONG} -o {path}"));
    assert_snapshot!(refused("none/spin").refusal(), @"quasirigid: cannot write none/spin: there is no folder none; create it first");
    assert_snapshot!(refused("model.toml/spin").refusal(), @r"
    quasirigid: cannot write model.toml/spin: there is no folder model.toml; create
    it first
    ");
    #[cfg(target_os = "linux")]
    assert!(refused("/proc/spin").refusal().starts_with("quasirigid: cannot write /proc/spin: "));
    assert_eq!(names(&folder), ["model.toml"]);
}

#[test]
fn run_that_cannot_start_leaves_nothing() {
    let folder = folder_of("axial-mass");
    for options in ["--tolerance 1", "--order 13", "--samples 1", "--duration 0"] {
        ran_in(folder.path(), &format!("run model.toml -o spin {options}")).refusal();
        assert_eq!(names(&folder), ["model.toml"], "{options}");
    }
}

#[cfg(unix)]
#[test]
fn folder_and_files_have_the_access_that_is_usual() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder_of("axial-mass");
    ran_in(folder.path(), SHORT);
    fs::create_dir(folder.path().join("usual")).unwrap();
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
    assert_eq!(mode("spin"), mode("usual"));
    for name in names(folder.path().join("spin")) {
        assert_eq!(mode(&format!("spin/{name}")), mode("model.toml"), "{name}");
    }
}
