//! `-` in place of the model file.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use crate::support::{MODEL, ROOT, Ran, folder_with, names, one_line, program, ran_in};

/// Runs a command line in a folder with this text on its standard input.
fn fed(folder: &Path, line: &str, text: &[u8]) -> Ran {
    let mut child = program(folder)
        .args(line.split_whitespace())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let sent = child.stdin.take().unwrap().write_all(text);
    drop(sent); // a command that refuses its arguments reads nothing
    child.wait_with_output().unwrap().into()
}

const NAMED: &str = "[body]\nname = \"satellite\"\n";

#[test]
fn a_model_is_read_from_the_standard_input() {
    let model = format!("{NAMED}{MODEL}");
    let folder = folder_with(&model);
    for command in [
        "check",
        "modes",
        "derive --format latex",
        "simulate --samples 3",
        "evolve",
        "verify --orders 1 --halvings 2 --revolutions 1 --quiet",
    ] {
        let (verb, options) = command.split_once(' ').unwrap_or((command, ""));
        let [file, stream] = ["model.toml", "-"].map(|model| format!("{verb} {model} {options}"));
        let (file, stream) = (ran_in(folder.path(), &file), fed(folder.path(), &stream, model.as_bytes()));
        assert!(!file.stdout.is_empty() && file.code != Some(2), "{command}: {file:?}");
        assert_eq!(
            (stream.code, stream.stdout, stream.stderr),
            (file.code, file.stdout, file.stderr),
            "{command}"
        );
    }
}

/// Paths in such a model are relative to the current folder, not to that of the program or of any file.
#[test]
fn files_of_such_a_model_are_looked_for_in_the_current_folder() {
    let folder = folder_with("");
    fs::create_dir(folder.path().join("parts")).unwrap();
    fs::copy(format!("{ROOT}/docs/guide/data/brick.obj"), folder.path().join("parts/brick.obj")).unwrap();
    let model = "[material.rock]\ndensity = 2000\nyoung = \"1 MPa\"\npoisson = 0.25\n\
                 rheology = { kind = \"kelvin-voigt\", time = 1e-3 }\n\
                 [[surface]]\nfile = \"parts/brick.obj\"\nunit = \"cm\"\nmaterial = \"rock\"\ndegree = 2\n";
    let derived = fed(folder.path(), "derive - --json", model.as_bytes());
    assert_eq!(derived.code, Some(0), "{derived:?}");
    let mass = derived.json()["mass"].as_f64().unwrap();
    assert!((mass - 2000.0 * 0.30 * 0.24 * 0.15).abs() < 1e-9, "{mass}");
    let missing = fed(folder.path(), "derive -", model.replace("brick", "stone").as_bytes());
    assert!(missing.refusal().contains("stone.obj"), "{}", missing.stderr);
}

#[test]
fn messages_name_the_standard_input() {
    let folder = folder_with("");
    let mistaken = fed(folder.path(), "check -", MODEL.replace("mass = 40.0", "mas = 40.0").as_bytes());
    assert!(mistaken.refusal().contains("[ standard input:2:1 ]"), "{}", mistaken.stderr);
    let empty = fed(folder.path(), "check -", b"");
    assert!(empty.refusal().contains("the file is empty"), "{}", empty.stderr);
    let no_text = fed(folder.path(), "check -", b"[carrier]\nmass = \xff\n");
    assert!(no_text.refusal().contains("[ standard input:2:8 ]"), "{}", no_text.stderr);
    let (still, _) = MODEL.split_once("[initial]").unwrap();
    let resting = fed(folder.path(), "check -", still.as_bytes());
    assert!(
        resting.refusal().contains("standard input: the model has no initial spin"),
        "{}",
        resting.stderr
    );
    let nameless = fed(folder.path(), "check - --json", MODEL.as_bytes());
    assert_eq!(nameless.json()["name"], "standard input");
}

#[test]
fn a_run_needs_the_name_of_its_folder() {
    let folder = folder_with("");
    let nameless = fed(folder.path(), "run -", MODEL.as_bytes());
    let words = "quasirigid: a record is named after the file of its model, and standard input has no name; name its folder with -o DIR";
    assert_eq!(one_line(nameless.refusal()), words);
    assert_eq!(names(folder.path()), ["model.toml"]);
    let ran = fed(folder.path(), "run - -o spin --quiet --samples 3 --duration 5", MODEL.as_bytes());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let record = fs::read_to_string(folder.path().join("spin/record.json")).unwrap();
    assert!(record.contains("\"file\": \"standard input\""), "{record}");
}

#[test]
fn a_file_of_that_name_is_still_to_be_had() {
    let folder = folder_with("");
    fs::write(folder.path().join("-"), format!("{NAMED}{MODEL}")).unwrap();
    let checked = ran_in(folder.path(), "check ./-");
    assert!(checked.code == Some(0) && checked.stdout.starts_with("satellite: "), "{checked:?}");
}
