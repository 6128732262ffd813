//! Keys: unknown, missing, misspelt, of the wrong kind of table, or in single brackets for double.
//! One mistake gives one message with the nearest known key; snapshots fix place, message and advice.

use insta::assert_snapshot;

use super::{CARRIER, read, refusal, refusal_of, refusal_of_spring};

#[test]
fn an_unknown_key_is_refused_with_the_nearest_known_one() {
    assert_snapshot!(refusal_of_spring("stifness = 600.0\n"), @r#"
    model.toml:12:1: unknown key "stifness" in [[spring]]
      did you mean `stiffness`? the keys are name, from, to, stiffness, damping, rheology, axial, anchor, tension, natural_length
    "#);
    assert_snapshot!(refusal_of("[[points]]\nmass = 1\n"), @r#"
model.toml:9:3: unknown key "points" in the file
  did you mean `point`? the keys are body, carrier, material, section, reduction, support, magnetic_field, initial, run, uncertainty, ellipsoid, surface, beam, panel, solid, deck, matrices, modes, connection, point, hinged, boom, appendage, spring, bushing, network, rotor, wheel, cavity, tank, force, controller, rod
"#);
    assert_snapshot!(refusal_of("[run]\ntemperature = 300\n"), @r#"
    model.toml:10:1: unknown key "temperature" in [run]
      the keys are order, duration, tolerance, samples, form, systems, integrator, stop, verify, evolve, spin_manifold
    "#);
}

#[test]
fn a_missing_key_is_refused_at_its_table() {
    assert_snapshot!(refusal("[body]\nname = \"x\"\n"), @"
    model.toml:1:1: the file has no [carrier] and no part that is elastic throughout
      add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]
    ");
    assert_snapshot!(refusal("[carrier]\n"), @r#"
    model.toml:1:1: [carrier] has no `mass`
      add a line such as: mass = 40.0
    model.toml:1:1: [carrier] has no `center_of_mass`
      add a line such as: center_of_mass = [0.0, 0.0, 0.0]
    model.toml:1:1: [carrier] has no `inertia`
      add a line such as: inertia = [9.0, 13.0, 16.0]
    "#);
    assert_snapshot!(refusal_of("[[point]]\n[[spring]]\n"), @r#"
    model.toml:9:1: [[point]] has no `mass`
      add a line such as: mass = 1.0
    model.toml:9:1: [[point]] has no `position`
      add a line such as: position = [0.8, 0.3, 0.5]
    model.toml:10:1: [[spring]] has no `from`
      add a line such as: from = "tip"
    model.toml:10:1: [[spring]] has no `to`
      add a line such as: to = "carrier"
    model.toml:10:1: [[spring]] has no `stiffness`
      add a line such as: stiffness = 600.0
    "#);
    assert_snapshot!(refusal_of("[support]\nkind = \"fixed-point\"\n[[hinged]]\n"), @r#"
    model.toml:9:1: [support] of kind "fixed-point" has no `point`
      add a line such as: point = [0.0, 0.0, 0.0]
    model.toml:11:1: [[hinged]] has no `mass`
      add a line such as: mass = 1.0
    model.toml:11:1: [[hinged]] has no `center_of_mass`
      add a line such as: center_of_mass = [1.5, 0.0, 0.0]
    model.toml:11:1: [[hinged]] has no `inertia`
      add a line such as: inertia = [0.0, 0.3, 0.3]
    model.toml:11:1: [[hinged]] has no `hinge`
      add a line such as: hinge = [1.0, 0.0, 0.0]
    model.toml:11:1: [[hinged]] has no `axes`
      add a line such as: axes = [[0, 0, 1]]
    model.toml:11:1: [[hinged]] has no `stiffness`
      add a line such as: stiffness = "0.565 N m/rad"
    "#);
}

#[test]
fn a_table_of_several_kinds_says_which_there_are() {
    assert_snapshot!(refusal_of("[[cavity]]\nlength = 3\n[[rotor]]\naxis = [0, 0, 1]\n"), @r#"
model.toml:9:1: [[cavity]] has no `shape`
  add a line such as: shape = "sphere", "ellipsoid", "cylinder", "annulus", "ring", "box", "shell", "mesh" or "surface"
model.toml:10:1: unknown key "length" in [[cavity]]
  the keys are shape, name, radius, semi_axes, axis, height, radii, tube_radius, sides, inner_semi_axes, file, unit, strict, center, attitude, density, kinematic_viscosity, dynamic_viscosity, flow, resolution, modes
model.toml:11:1: [[rotor]] has no `inertia`
  add a line such as: inertia = 0.2
model.toml:11:1: [[rotor]] has no `friction`
  add a line such as: friction = 0.05
"#);
}

#[test]
fn single_and_double_brackets_are_told_apart() {
    assert_snapshot!(refusal(&CARRIER.replace("[carrier]", "[[carrier]]")), @r#"
    model.toml:1:1: there is one [carrier], not a list of them
      write [carrier] once, with single brackets
    "#);
    assert_snapshot!(refusal(&format!("{CARRIER}[point]\nmass = 1\n")), @r#"
    model.toml:5:1: `point` is a list of tables, but a table stands here
      write [[point]], with double brackets, once for each
    "#);
    assert_snapshot!(refusal("carrier = 40.0\npoint = [1]\n"), @"
    model.toml:1:11: `carrier`: found a decimal number, expected a table
      write [carrier] with its keys
    model.toml:2:10: `point`: found an integer, expected a table
      write [[point]] with its keys
    ");
}

#[test]
fn every_mistake_is_reported_in_the_order_of_the_file() {
    assert_snapshot!(refusal("[run]\norder = 13\n[carrier]\nmass = 0\ninertia = 3\ncentre_of_mass = [0, 0, 0]\n"), @r#"
    model.toml:2:9: `order` is 13, but must be an integer from 0 to 12
      write an integer from 0 to 12
    model.toml:4:8: `mass` is 0 kg, but must be positive
      write a number in kg, or a text with its unit such as "12 lb"
    model.toml:5:11: `inertia`: found an integer, expected 3 principal values or a 3x3 matrix
      write [Jx, Jy, Jz] in kg m^2, or three rows of a symmetric matrix
    model.toml:6:1: unknown key "centre_of_mass" in [carrier]
      did you mean `center_of_mass`? the keys are mass, center_of_mass, inertia
    "#);
}

#[test]
fn a_mistake_made_many_times_is_cut_short() {
    let many = "[[spring]]\nfrom = \"tip\"\nto = \"top\"\nstiffnes = 1\n".repeat(10_000);
    let report = refusal_of(&many);
    let locations = report.lines().filter(|line| line.starts_with("model.toml:")).count();
    assert_eq!(locations, 101);
    assert_snapshot!(report.lines().last().unwrap_or_default(), @"model.toml:408:1: there are more problems like these");
}

/// An integer that is too large is a number to the reader, and no TOML to what changes the text for studies.
#[test]
fn an_uncertain_model_that_no_study_can_change_is_refused() {
    let uncertain = "[uncertainty]\n\"carrier.mass\" = { uniform = [30.0, 50.0] }\n";
    let large = "[run]\nduration = 9223372036854775808\n";
    read(&format!("{CARRIER}{large}"));
    assert_snapshot!(refusal(&format!("{CARRIER}{large}{uncertain}")), @"
    model.toml:7:1: the model is not valid TOML: integer number overflowed
      studies change the text of the model, so all of it must be plain TOML; write a number beyond 9.2e18 as 1e19
    ");
}
