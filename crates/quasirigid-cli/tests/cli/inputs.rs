//! Answers say what went into them: files with length and checksum, values after units and defaults, the body that they give.

use std::fs;

use quasirigid_io::record::RunRecord;
use serde_json::Value;

use crate::support::{folder_with, one_line, ran_in};

const MODEL: &str = "\
[material.rock]
density = \"2 g/cm^3\"
mu_Q = \"5e11 Pa\"
poisson = 0.25
rheology = { kind = \"quality-factor\", Q = 100 }
[[surface]]
file = \"shape.obj\"
unit = \"km\"
material = \"rock\"
[initial]
wobble = { angle = \"30 deg\", rate = \"0.35 mrad/s\", mode = \"short-axis\" }
[run]
evolve = { until = \"5 deg\" }
duration = 1000
samples = 11
";

/// A box with these edges (km), as an OBJ file.
fn shape(edges: [f64; 3]) -> String {
    let mut text = String::new();
    for corner in 0..8 {
        let place = [0, 1, 2].map(|axis| edges[axis] * (f64::from((corner >> axis) & 1) - 0.5));
        text += &format!("v {} {} {}\n", place[0], place[1], place[2]);
    }
    text + "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n"
}

fn value<'a>(inputs: &'a Value, key: &str) -> &'a Value {
    let values = inputs["values"].as_array().unwrap();
    values.iter().find(|value| value["key"] == key).unwrap_or_else(|| panic!("{key}: {values:#?}"))
}

#[test]
fn answers_name_their_files_values_and_body() {
    let folder = folder_with(MODEL);
    fs::write(folder.path().join("shape.obj"), shape([2.0, 1.4, 1.1])).unwrap();
    for command in ["check", "modes", "evolve", "derive", "cite", "simulate"] {
        let ran = ran_in(folder.path(), &format!("{command} model.toml --json --quiet"));
        let inputs = &ran.json()["inputs"];
        let names: Vec<_> = inputs["files"].as_array().unwrap().iter().map(|file| &file["name"]).collect();
        assert_eq!(names, ["model.toml", "shape.obj"], "{command}");
        // after conversion; the density of the file is in g/cm^3
        assert_eq!(value(inputs, "material.rock.density")["value"], 2000.0);
        assert_eq!(value(inputs, "material.rock.density")["unit"], "kg/m^3");
        assert_eq!(value(inputs, "initial.wobble.rate")["value"], 0.35e-3);
        let order = value(inputs, "run.integrator");
        assert_eq!((&order["value"], &order["default"]), (&"automatic".into(), &true.into()));
        let body = &inputs["body"];
        // by hand: 2000 kg/m^3 · 2000 m · 1400 m · 1100 m
        assert!((body["mass"].as_f64().unwrap() / 6.16e12 - 1.0).abs() < 1e-12, "{body}");
        assert_eq!(body["size"], serde_json::json!([2000.0, 1400.0, 1100.0]));
        assert!((body["mu_Q"].as_f64().unwrap() / 5e11 - 1.0).abs() < 1e-12, "{body}");
        assert_eq!(body["quality_factor"], 100.0);
    }
    let files = &ran_in(folder.path(), "check model.toml --json -q").json()["inputs"]["files"];
    let model = fs::read(folder.path().join("model.toml")).unwrap();
    assert_eq!(files[0]["bytes"], model.len());
}

/// The record of a shape that was replaced had the checksum of the model alone.
#[test]
fn diff_names_the_shape_that_was_replaced() {
    let folder = folder_with(MODEL);
    for (name, edges) in [("one", [2.0, 1.4, 1.1]), ("two", [2.0, 1.4, 0.88]), ("again", [2.0, 1.4, 1.1])] {
        fs::write(folder.path().join("shape.obj"), shape(edges)).unwrap();
        let tables = if name == "two" { " --tables csv,parquet,npz" } else { "" };
        assert_eq!(ran_in(folder.path(), &format!("run model.toml -o {name} -q{tables}")).code, Some(0));
    }
    let same = ran_in(folder.path(), "diff one again");
    assert_eq!(
        (same.code, same.stdout.trim()),
        (Some(0), "The results are the same, and so are their inputs.")
    );
    let ran = ran_in(folder.path(), "diff one two");
    assert_eq!(ran.code, Some(1));
    let told = one_line(&ran.stdout);
    for part in
        ["file shape.obj: ", "body.size: 2000.0000, 1400.0000, 1100.0000, then", "evolution.sentence: "]
    {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(!told.contains("file model.toml"), "{told}");
    let json = ran_in(folder.path(), "diff one two --json").json();
    assert_eq!(json["same"], false);
    assert!(json["answers"].as_array().unwrap().iter().any(|each| each["what"] == "evolution.time"));

    let record = RunRecord::read(&folder.path().join("two")).unwrap();
    let text = serde_json::to_string(&record.inputs.unwrap()).unwrap();
    let parquet = fs::read(folder.path().join("two/history-reduced.parquet")).unwrap();
    assert!(parquet.windows(text.len()).any(|window| window == text.as_bytes()), "the metadata of Parquet");
    let utf32: Vec<u8> = text.chars().flat_map(|letter| u32::from(letter).to_le_bytes()).collect();
    let npz = fs::read(folder.path().join("two/history-reduced.npz")).unwrap();
    assert!(npz.windows(utf32.len()).any(|window| window == utf32), "an array of the archive");
    let page = fs::read_to_string(folder.path().join("two/report.html")).unwrap();
    assert!(page.contains("What went in") && page.contains("shape.obj"));
}

#[test]
fn diff_of_no_results_is_refused_in_words() {
    let folder = folder_with(MODEL);
    fs::write(folder.path().join("list.json"), "[1]").unwrap();
    for (other, said) in [
        (".", "no result is here; give the folder of a run"),
        ("list.json", "this is not a JSON object"),
        ("/dev/zero", "not a regular file"),
        ("nowhere", "No such file"),
    ] {
        let ran = ran_in(folder.path(), &format!("diff {other} {other}"));
        assert_eq!(ran.code, Some(2), "{other}");
        assert!(one_line(&ran.stderr).contains(said), "{other}: {}", ran.stderr);
    }
}

#[test]
fn tables_in_csv_have_their_inputs_beside_them() {
    let folder = folder_with(MODEL);
    fs::write(folder.path().join("shape.obj"), shape([2.0, 1.4, 1.1])).unwrap();
    for command in ["simulate model.toml --out table.csv", "evolve model.toml --out evolution.csv"] {
        assert_eq!(ran_in(folder.path(), &format!("{command} -q")).code, Some(0));
        let name = command.rsplit(' ').next().unwrap();
        let text = fs::read(folder.path().join(format!("{name}.inputs.json"))).unwrap();
        let inputs: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(inputs["files"][1]["name"], "shape.obj");
        // the table itself begins with its names, as readers expect
        assert!(fs::read_to_string(folder.path().join(name)).unwrap().starts_with('t'));
    }
}
