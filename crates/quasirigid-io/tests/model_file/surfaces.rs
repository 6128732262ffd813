//! Solids inside closed surfaces, read from files beside the model.

use std::fs;

use insta::assert_snapshot;
use quasirigid_io::model::{Model, ModelError};
use tempfile::TempDir;

use super::ROCK;

/// A tetrahedron in an OBJ file.
const TETRAHEDRON: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// Reads a model with a surface of these lines, beside an OBJ file with this text.
fn read(shape: &str, lines: &str) -> Result<Model, ModelError> {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("shape.obj"), shape).expect("a file");
    let text = format!("[material.rock]\n{ROCK}[[surface]]\nmaterial = \"rock\"\n{lines}");
    fs::write(folder.path().join("model.toml"), text).expect("a file");
    Model::read(&folder.path().join("model.toml"))
}

/// Refusal of such a model, with the folder's name left out; the lines start in line 7.
fn refused(shape: &str, lines: &str) -> String {
    let message = read(shape, lines).expect_err("a refusal").to_string();
    let folder = |line: &str| {
        line.split_whitespace()
            .map(|word| word.rsplit('/').next().unwrap_or(word))
            .collect::<Vec<_>>()
            .join(" ")
    };
    message.lines().map(folder).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_surface_is_read_in_its_unit() {
    let model = read(TETRAHEDRON, "file = \"shape.obj\"\nunit = \"km\"\ndegree = 4\n").expect("a model");
    let [surface] = &model.assembly.surfaces[..] else { panic!("one surface") };
    assert_eq!((surface.name.as_str(), surface.degree), ("surface 1", Some(4)));
    assert!((surface.surface.volume() / (8e9 / 6.0) - 1.0).abs() < 1e-12);
    assert_eq!(model.assembly.carrier, None);
    assert_eq!(model.assembly.check(), []);
    let cells = read(TETRAHEDRON, "file = \"shape.obj\"\ncells = 700\n").expect("a model");
    assert_eq!(cells.assembly.surfaces[0].cells, Some(700));
    let odd = read(TETRAHEDRON, "file = \"shape.obj\"\nunit = \"2.5 cm\"\n").expect("a model");
    assert!((odd.assembly.surfaces[0].surface.volume() / (0.05_f64.powi(3) / 6.0) - 1.0).abs() < 1e-12);
    assert!(odd.notes.is_empty());
    assert_eq!(
        cells.notes,
        ["\"surface 1\" has no `unit`, so that its file is taken in metres: 2.000 by 2.000 by 2.000 m"]
    );
}

#[test]
fn what_is_no_surface_is_refused_at_its_file() {
    assert_snapshot!(refused(TETRAHEDRON, "file = \"none.obj\"\n"), @r#"
    model.toml:7:8: `file`: none.obj: entity not found; is the name right, and is the file readable?
    it is looked for beside the model; OBJ, STL, PLY, OFF, VRML, glTF, VTK and plate tables are read
    "#);
    let open = TETRAHEDRON.replace("f 1 4 3\n", "");
    assert_snapshot!(refused(&open, "file = \"shape.obj\"\n"), @r#"
    model.toml:7:8: `file`: 3 triangles enclose nothing; a closed surface has at least 4
    the surface must close around one body; corners closer than 1e-5 of its size are merged, facets turned and copies left out already
    "#);
    assert_snapshot!(refused("v 0 0 x\n", "file = \"shape.obj\"\n"), @r#"
    model.toml:7:8: `file`: shape.obj:1: "x" is not a number; a vertex is written v x y z
    it is looked for beside the model; OBJ, STL, PLY, OFF, VRML, glTF, VTK and plate tables are read
    "#);
    assert_snapshot!(refused(TETRAHEDRON, "file = \"shape.obj\"\nunit = \"kg\"\ndegree = 13\n"), @r#"
    model.toml:8:8: `unit`: "kg" is not a decimal number with a unit
    write for example "22 in", or a plain number in m
    model.toml:9:10: `degree` is 13, but must be an integer from 1 to 12
    write an integer from 1 to 12
    "#);
    assert_snapshot!(refused(TETRAHEDRON, "file = 3\n"), @r#"
    model.toml:7:8: `file`: found an integer, expected a text
    write the file in quotes
    "#);
}

#[test]
fn repairs_are_told_and_strict_refuses_them() {
    let reversed = TETRAHEDRON.replace("f 2 3 4", "f 4 3 2");
    let model = read(&reversed, "file = \"shape.obj\"\nunit = \"m\"\n").expect("a model");
    assert_eq!(model.notes, ["\"surface 1\": \"shape.obj\" was repaired: 1 facets turned around"]);
    assert_eq!(model.shapes[0].repairs[0].count, 1);
    assert_snapshot!(refused(&reversed, "file = \"shape.obj\"\nstrict = true\n"), @r#"
    model.toml:7:8: `file`: it needs repair: 1 facets turned around
    leave `strict` out to have this done, or mend the file
    "#);
}

#[test]
fn separate_bodies_are_a_question_with_their_sizes() {
    let second = "v 8 0 0\nv 9 0 0\nv 8 1 0\nv 8 0 1\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
    let both = format!("{TETRAHEDRON}{second}");
    let question = refused(&both, "file = \"shape.obj\"\n");
    assert!(
        question.contains("2 bodies that nothing joins: 2.0000 by 2.0000 by 2.0000 m near"),
        "{question}"
    );
    let model = read(&both, "file = \"shape.obj\"\nparts = \"largest\"\n").expect("a model");
    assert!((model.assembly.surfaces[0].surface.volume() * 6.0 / 8.0 - 1.0).abs() < 1e-12);
    assert!(
        model.notes[1].contains("largest of 2 bodies; the others have 12.50 % of its volume"),
        "{:?}",
        model.notes
    );
}

/// A pyramid on a grid without one square of it is refused, and closed where the model says so, in words.
#[test]
fn small_holes_are_closed_on_request() {
    let n = 12;
    let index = |i: usize, j: usize| j * (n + 1) + i + 1;
    let mut text = String::new();
    for (i, j) in (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))) {
        text += &format!("v {} {} 0\n", i as f64 / n as f64, j as f64 / n as f64);
    }
    text += "v 0.3 0.4 0.9\n";
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).filter(|at| *at != (4, 7)) {
        text +=
            &format!("f {} {} {} {}\n", index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j));
    }
    for k in 0..n {
        for [a, b, c, d] in
            [[k, 0, k + 1, 0], [n, k, n, k + 1], [n - k, n, n - k - 1, n], [0, n - k, 0, n - k - 1]]
        {
            text += &format!("f {} {} {}\n", index(a, b), index(c, d), (n + 1) * (n + 1) + 1);
        }
    }
    let error = read(&text, "file = \"shape.obj\"\nunit = \"m\"\n").expect_err("a hole").to_string();
    assert!(error.contains("1 hole: 4 edges") && error.contains("close_holes = true"), "{error}");
    let lines = "file = \"shape.obj\"\nunit = \"m\"\nclose_holes = true\n";
    let model = read(&text, lines).unwrap_or_else(|error| panic!("{error}"));
    assert!((model.assembly.surfaces[0].surface.volume() / 0.3 - 1.0).abs() < 1e-12);
    let told = "1 holes closed by caps (3.333e-1 m around, 6.944e-3 m²,";
    assert!(model.notes.iter().any(|note| note.contains(told)), "{:?}", model.notes);
}
