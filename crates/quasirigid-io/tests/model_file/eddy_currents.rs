//! Eddy currents: tensors, shapes and fields that are read, and refusals of mistakes.

use std::f64::consts::PI;

use insta::assert_snapshot;
use quasirigid::model::force::{ForceLaw, MagneticField};

use super::{CARRIER, POINT, read, refusal_of, verdict};

const FIELD: &str = "field = [0, 0, \"30 uT\"]\n";

fn text(lines: &str) -> String {
    format!("[[force]]\nkind = \"eddy-current\"\n{lines}")
}

/// Tensor, time of the decay and field of the only force.
fn currents(lines: &str) -> ([[f64; 3]; 3], f64, MagneticField) {
    let forces = read(&format!("{CARRIER}{POINT}{}", text(lines))).assembly.forces;
    match forces[0].law {
        ForceLaw::EddyCurrent { tensor, decay_time, field } => (tensor, decay_time, field),
        _ => panic!("eddy currents"),
    }
}

/// Refusal of a force; the lines start in line 11.
fn refused(lines: &str) -> String {
    refusal_of(&text(lines))
}

fn isotropic(value: f64) -> [[f64; 3]; 3] {
    [[value, 0.0, 0.0], [0.0, value, 0.0], [0.0, 0.0, value]]
}

#[test]
fn tensors_are_given_or_follow_from_a_shape() {
    let uniform = MagneticField::Uniform([0.0, 0.0, 3e-5]);
    let given = currents(&format!("tensor = \"2 kS m^4\"\n{FIELD}"));
    assert_eq!(given, (isotropic(2000.0), 0.0, uniform));
    let rows = currents(&format!("tensor = [[3, 1, 0], [1, 2, 0], [0, 0, \"5 S m^4\"]]\n{FIELD}"));
    assert_eq!(rows.0, [[3.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 5.0]]);
    let sphere = format!("conductivity = \"58 MS/m\"\nshape = \"sphere\"\nradius = \"10 cm\"\n{FIELD}");
    let (tensor, decay_time, _) = currents(&sphere);
    let close = |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-12, "{found:e} {known:e}");
    close(tensor[0][0], 2.0 * PI / 15.0 * 58e6 * 1e-5);
    assert_eq!(tensor, isotropic(tensor[0][0]));
    close(decay_time, 1.256_637_062_12e-6 * 58e6 * 0.01 / 105f64.sqrt());
    let shell = "conductivity = 1e7\nshape = \"shell\"\nradius = 0.3\nthickness = \"15 mm\"\n";
    let (tensor, decay_time, _) = currents(&format!("{shell}{FIELD}"));
    close(tensor[2][2], 2.0 * PI / 15.0 * 1e7 * (0.3f64.powi(5) - 0.285f64.powi(5)));
    close(decay_time, 1.256_637_062_12e-6 * 1e7 * 0.3 * 0.015 / 3.0);
}

#[test]
fn dipoles_may_turn() {
    let dipole = "dipole = [1e15, 0, -7.8e15]\norbit = { body = \"Earth\", semi_major_axis = \"7000 km\" }\n";
    let field = |lines: &str| currents(&format!("tensor = 1\n{dipole}{lines}")).2;
    assert!(matches!(field(""), MagneticField::Dipole { rate: 0.0, .. }));
    assert!(matches!(field("dipole_rate = 0\n"), MagneticField::Dipole { rate: 0.0, .. }));
    let MagneticField::Dipole { strength, rate, .. } = field("dipole_rate = \"15 deg/h\"\n") else {
        panic!("a dipole that turns")
    };
    assert_eq!(strength, [1e15, 0.0, -7.8e15]);
    assert!((rate / 7.272_205_216_643_04e-5 - 1.0).abs() < 1e-12);
}

#[test]
fn currents_that_cannot_be_are_refused() {
    let unphysical =
        |rows: &str| verdict(&format!("{CARRIER}{POINT}{}", text(&format!("tensor = {rows}\n{FIELD}"))));
    assert_snapshot!(unphysical("[[1, 2, 0], [2, 1, 0], [0, 0, 1]]"), @r#"
    model.toml:11:10: `tensor` of force "force 1": the smallest eigenvalue is -1e0 S m^4; eddy currents must not give energy
      check the signs; the eigenvalues of the magnetic tensor must be zero or positive
    "#);
    assert_snapshot!(unphysical("[[1, 2, 0], [3, 9, 0], [0, 0, 1]]"), @r#"
    model.toml:11:10: `tensor` of force "force 1": the matrix is not symmetric: entries [0][1] = 2 and [1][0] = 3 differ
      write the same value at [i][j] and [j][i], or only the three values of the axes
    "#);
    assert_snapshot!(refused(&format!("tensor = -1\n{FIELD}")), @"
    model.toml:11:10: `tensor` is -1 S m^4, but must be zero or positive
      write zero or a positive value
    ");
    assert_snapshot!(refused(&format!("tensor = \"3 S/m\"\n{FIELD}")), @r#"
    model.toml:11:10: `tensor`: "3 S/m" is a conductivity, but a magnetic tensor is needed
      write for example "5662 S m^4", or a plain number in S m^4
    "#);
    assert_snapshot!(refused(&format!("tensor = 1\nconductivity = 1e7\n{FIELD}")), @"
    model.toml:12:16: `conductivity` says what the `tensor` is already
      leave out one of the two
    ");
}

#[test]
fn shapes_that_cannot_be_are_refused() {
    assert_snapshot!(refused(&format!("conductivity = 1e7\n{FIELD}")), @r#"
    model.toml:9:1: [[force]] of kind "eddy-current" has no `shape`
      add a line such as: shape = "sphere", or shape = "shell"
    model.toml:9:1: [[force]] of kind "eddy-current" has no `radius`
      add a line such as: radius = "30 cm"
    "#);
    assert_snapshot!(refused(&format!("conductivity = 0\nshape = \"cube\"\nradius = \"3 kg\"\n{FIELD}")), @r#"
    model.toml:11:16: `conductivity` is 0 S/m, but must be positive
      write a number in S/m, or a text with its unit such as "25 MS/m"
    model.toml:12:9: `shape` cannot be "cube"
      write "sphere" or "shell"
    model.toml:13:10: `radius`: "3 kg" is a mass, but a length is needed
      write for example "22 in", or a plain number in m
    "#);
    assert_snapshot!(refused(&format!("conductivity = 1e7\nshape = \"shell\"\nradius = 0.1\nthickness = 0.2\n{FIELD}")), @r#"
    model.toml:14:13: `thickness` is 0.2 m, and the outer radius is 0.1 m
      write less than the radius, or shape = "sphere"
    "#);
    assert_snapshot!(refused(&format!("conductivity = 1e7\nshape = \"sphere\"\nradius = 0.1\nthickness = 0.01\n{FIELD}")), @r#"
    model.toml:14:13: `thickness` is that of a shell, and this sphere is solid
      leave it out, or write shape = "shell"
    "#);
    assert_snapshot!(refused("tensor = 1\nfield = [0, 0, 1]\ndipole_rate = 7e-5\n"), @"
    model.toml:13:15: `dipole_rate` goes with `dipole`, and this `field` is the same everywhere
      leave out one of the two
    ");
}
