//! A solid with a neck: every answer tells the error of its shape.

use std::fmt::Write;
use std::fs;

use quasirigid_study::Study;
use quasirigid_study::evolution;
use quasirigid_study::settings::PartialRun;

use crate::support::{evolved, one_line};

const MODEL: &str = r#"
[body]
name = "contact binary"
[material.ice]
density = "0.533 g/cm^3"
shear = "10 MPa"
poisson = 0.25
rheology = { kind = "quality-factor", Q = 100, range = [10, 1000] }
[[surface]]
name = "nucleus"
file = "shape.obj"
unit = "km"
material = "ice"
DEGREE
[initial]
wobble = { angle = "30 deg", rate = "2 rev/d", mode = "short-axis" }
[run]
duration = "1 d"
samples = 11
evolve = { until = "5 deg" }
"#;

/// Rings of ten vertices about the x axis, of two flattened balls that meet at a neck.
fn shape() -> String {
    let mut text = String::from("v -2 0 0\n");
    let stations = [
        (-1.9, 0.45),
        (-1.5, 0.85),
        (-1.0, 1.0),
        (-0.5, 0.85),
        (-0.1, 0.42),
        (0.1, 0.42),
        (0.5, 0.8),
        (0.9, 0.9),
        (1.4, 0.75),
        (1.7, 0.4),
    ];
    for (x, r) in stations {
        for step in 0..10 {
            let angle = std::f64::consts::TAU * f64::from(step) / 10.0;
            writeln!(text, "v {x} {} {}", r * angle.cos(), 0.9 * r * angle.sin()).unwrap();
        }
    }
    text.push_str("v 1.8 0 0\n");
    let at = |ring: usize, step: usize| 2 + 10 * ring + step % 10;
    for step in 0..10 {
        writeln!(text, "f 1 {} {}", at(0, step + 1), at(0, step)).unwrap();
        for ring in 0..stations.len() - 1 {
            let [a, b] = [at(ring, step), at(ring, step + 1)];
            let [c, d] = [at(ring + 1, step), at(ring + 1, step + 1)];
            writeln!(text, "f {a} {b} {d}\nf {a} {d} {c}").unwrap();
        }
        writeln!(text, "f {} {} {}", at(9, step), at(9, step + 1), 2 + 10 * stations.len()).unwrap();
    }
    text
}

fn necked(line: &str) -> Study {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("shape.obj"), shape()).unwrap();
    let file = folder.path().join("model.toml");
    fs::write(&file, MODEL.replace("DEGREE", line)).unwrap();
    Study::open(file, None).unwrap()
}

#[test]
fn every_answer_says_how_well_the_shape_is_resolved() {
    let study = necked("cells = 1200");
    let expected = "finite elements in";
    let resolution = study.resolution.as_ref().unwrap();
    let error = resolution.error;
    assert!(error > 0.0 && error < 0.5, "{resolution:?}");
    let checked = study.check().unwrap();
    assert!(one_line(&checked.text()).contains(expected), "{}", checked.text());
    assert!(checked.json()["resolution"]["cells"].is_u64());
    let record = evolved(&study, |_| {}).record;
    let time_error = record.time_error.unwrap();
    assert!(time_error >= error, "{time_error} {error}");
    // One number stands for the time, and includes the error of the shape.
    let text = one_line(&evolution::text("contact binary", study.model.kind, &record));
    let words: Vec<&str> = text.split("the time is good to ").collect();
    assert!(words.len() == 2 && !text.contains("known to"), "{text}");
    let told = words[1].split(' ').next().unwrap();
    assert!((told.parse::<f64>().unwrap() / (100.0 * time_error) - 1.0).abs() < 0.06, "{told} {time_error}");
    let run = study.run(&PartialRun::default(), &mut ()).unwrap();
    assert!(run.holds);
    assert_eq!(run.record.body.resolution.as_ref().unwrap().error, Some(error));
    assert_eq!(run.record.notes.iter().any(|note| note.contains("hard to resolve")), error > 0.05);
    let files = run.files();
    let (_, page) = files.iter().find(|(name, _)| *name == "report.html").unwrap();
    assert!(page.contains(expected) && page.contains(&format!("the time is good to {told} %.")));
}

/// Polynomials of low degree are off by more than half: their answer does not hold, and begins with that.
#[test]
fn polynomials_that_do_not_follow_the_shape_do_not_hold() {
    let study = necked("degree = 2");
    let found = evolved(&study, |_| {});
    let text = one_line(&evolution::text(&study.model.name, study.model.kind, &found.record));
    assert!(!found.holds() && text.starts_with("contact binary: THE SHAPE IS NOT RESOLVED."), "{text}");
    let notes = study.model.notes.join(" ");
    assert!(notes.contains("The shape of \"nucleus\" is hard to resolve"), "{notes}");
}
