//! Refusals of elements: names, springs, motions of points, and hinges; snapshots fix place, message and advice.
//! Only what reading alone can tell is tested here; laws of mechanics are in `physics.rs`.

use insta::assert_snapshot;
use quasirigid::elements::HingeCoefficient;

use super::{CARRIER, HINGED, POINT, read, refusal, refusal_of, refusal_of_spring};

#[test]
fn an_unknown_name_is_refused_with_those_there_are() {
    assert_snapshot!(refusal_of("[[spring]]\nfrom = \"tpi\"\nto = \"ground\"\nstiffness = 1\n"), @r#"
    model.toml:10:8: there is no point "tpi"
      did you mean "tip"? there are carrier, tip
    model.toml:11:6: there is no point "ground"
      there are carrier, tip
    "#);
    assert_snapshot!(refusal(&format!("{CARRIER}[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 1\n")), @r#"
    model.toml:6:8: there is no point "tip"
      the file has no [[point]]; a spring joins points, nodes of parts, places on appendages and the carrier
    "#);
    let spring = "[[spring]]\nfrom = \"boom\"\nto = \"tip\"\nstiffness = 1\n";
    assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n{spring}")), @r#"
    model.toml:18:8: "boom" is a hinged appendage, but a spring joins points, nodes of parts, places on appendages and the carrier
      give it places = { tip = [...] } and write { part = "boom", node = "tip" }
    "#);
}

#[test]
fn a_long_list_of_names_is_cut_short() {
    let points: String = (0..5000)
        .map(|index| format!("[[point]]\nname = \"p{index}\"\nmass = 1\nposition = [0, 0, 1]\n"))
        .collect();
    let spring = "[[spring]]\nfrom = \"p4\"\nto = \"carier\"\nstiffness = 1\n";
    assert_snapshot!(refusal(&format!("{CARRIER}{points}{spring}")), @r#"
    model.toml:20007:6: there is no point "carier"
      did you mean "carrier"? there are carrier, p0, p1, p2, p3, p4, p5, p6, p7, p8, …
    "#);
}

#[test]
fn a_name_given_twice_is_refused_at_both_places() {
    assert_snapshot!(refusal_of(POINT), @r#"
    model.toml:10:8: the name "tip" is used twice; it stands first in line 6
      give each element its own name
    "#);
    assert_snapshot!(refusal_of(&POINT.replace("tip", "carrier")), @r#"
    model.toml:10:8: the name "carrier" is that of the carrier
      choose another name
    "#);
    let unnamed = POINT.replace("name = \"tip\"\n", "");
    assert_snapshot!(refusal(&format!("{CARRIER}{}{unnamed}", POINT.replace("tip", "point 2"))), @r#"
    model.toml:9:1: the name "point 2" is used twice; it stands first in line 6
      give each element its own name
    "#);
    let boom = HINGED.replace("boom", "tip");
    assert_snapshot!(refusal_of(&format!("{boom}axes = [[0, 0, 1]]\nstiffness = 3\n")), @r#"
    model.toml:10:8: the name "tip" is used twice; it stands first in line 6
      give each element its own name
    "#);
}

#[test]
fn a_spring_may_have_a_name() {
    let spring =
        "[[spring]]\nname = \"strut\"\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 9\ndamping = 1\n";
    let unnamed = spring.replace("name = \"strut\"\n", "");
    let model = read(&format!("{CARRIER}{POINT}{spring}{unnamed}"));
    let names: Vec<_> = model.assembly.springs.iter().map(|spring| spring.name.as_str()).collect();
    assert_eq!(names, ["strut", ""]);
    let body = model.assembly.body().unwrap();
    let names: Vec<_> = body.dissipators().iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["strut", "spring tip-carrier"]);
    assert_snapshot!(refusal_of(&format!("{spring}{spring}")), @r#"
    model.toml:16:8: the name "strut" is used twice; it stands first in line 10
      give each element its own name
    "#);
    assert_snapshot!(refusal_of(&spring.replace("strut", "tip")), @r#"
    model.toml:10:8: the name "tip" is used twice; it stands first in line 6
      give each element its own name
    "#);
    assert_snapshot!(refusal_of(&spring.replace("strut", "carrier")), @r#"
    model.toml:10:8: the name "carrier" is that of the carrier
      choose another name
    "#);
    let onto = format!("{spring}[[spring]]\nfrom = \"strut\"\nto = \"tip\"\nstiffness = 1\n");
    assert_snapshot!(refusal_of(&onto), @r#"
    model.toml:16:8: "strut" is a spring, but a spring joins points, nodes of parts, places on appendages and the carrier
      name what one of its ends is fixed to
    "#);
    let displaced = "[initial]\nangular_velocity = [0, 0, 1]\ndisplacements = { strut = [0, 0, 1] }\n";
    assert_snapshot!(refusal_of(&format!("{spring}{displaced}")), @r#"
    model.toml:17:19: "strut" is a spring, and has no coordinates of its own
      displace what its ends are fixed to
    "#);
}

#[test]
fn a_spring_from_an_end_to_itself_is_refused() {
    assert_snapshot!(refusal_of("[[spring]]\nfrom = \"tip\"\nto = \"tip\"\nstiffness = 1\n"), @r#"
    model.toml:11:6: both ends of the spring are the same
      a spring joins two points, or a point and the carrier
    "#);
    assert_snapshot!(refusal_of("[[spring]]\nfrom = \"carrier\"\nto = \"carrier\"\nstiffness = 1\n"), @r#"
    model.toml:11:6: both ends of the spring are the same
      a spring joins two points, or a point and the carrier
    "#);
}

#[test]
fn an_axial_spring_has_one_stiffness_and_alone_an_anchor() {
    assert_snapshot!(refusal_of_spring("axial = true\nstiffness = [1, 2, 3]\ndamping = [[1]]\n"), @r#"
    model.toml:13:13: `stiffness`: found an array of 3 values, expected one number, since the spring is axial
      write one number: an axial spring acts only along the line that joins its ends
    model.toml:14:11: `damping`: found an array of 1 value, expected one number, since the spring is axial
      write one number: an axial spring acts only along the line that joins its ends
    "#);
    assert_snapshot!(refusal_of_spring("stiffness = 1\nanchor = [0, 0, 1]\n"), @r#"
    model.toml:13:10: `anchor` is the carrier's end of an axial spring, and this spring is not axial
      add axial = true, or leave it out
    "#);
    let second = POINT.replace("tip", "top");
    let spring =
        "[[spring]]\nfrom = \"tip\"\nto = \"top\"\nstiffness = 1\naxial = true\nanchor = [0, 0, 1]\n";
    assert_snapshot!(refusal_of(&format!("{second}{spring}")), @r#"
    model.toml:18:10: `anchor` is the end of an axial spring on the carrier, and this spring joins two points
      leave it out, or write "carrier" for one end
    "#);
}

#[test]
fn a_negative_stiffness_or_damping_is_refused() {
    assert_snapshot!(refusal_of_spring("stiffness = -600\ndamping = [1, \"-2 N s/m\", 3]\n"), @r#"
    model.toml:12:13: `stiffness` is -600 N/m, but must be zero or positive
      write zero or a positive value
    model.toml:13:15: `damping` is -2 N s/m, but must be zero or positive
      write zero or a positive value
    "#);
    assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = -3\ndamping = [-1]\n")), @r#"
    model.toml:16:13: `stiffness` is -3 N m/rad, but must be zero or positive
      write zero or a positive value
    model.toml:17:12: `damping` is -1 N m s/rad, but must be zero or positive
      write zero or a positive value
    "#);
}

#[test]
fn a_stiffness_of_another_shape_is_refused() {
    assert_snapshot!(refusal_of_spring("stiffness = [1, 2]\ndamping = [[1, 0, 0], [0, 1, 0], [0, 0]]\n"), @r#"
    model.toml:12:13: `stiffness`: found an array of 2 values, expected a number, 3 numbers or a 3x3 matrix
      write k, [kx, ky, kz] or three rows of a symmetric matrix
    model.toml:13:34: `damping`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
    assert_snapshot!(refusal_of_spring("stiffness = { x = 1 }\n"), @r#"
    model.toml:12:13: `stiffness`: found a table, expected a stiffness
      write a number in N/m, or a text with its unit such as "12.5 lbf/in"
    "#);
}

#[test]
fn a_motion_is_free_or_along_one_line_or_in_one_plane() {
    assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = \"fixed\"\n"), @r#"
    model.toml:12:10: `motion`: found a text, expected "free", a line or a plane
      write "free", { line = [1, 0, 0] } or { plane = [0, 0, 1] }
    "#);
    assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = 3\n"), @r#"
    model.toml:12:10: `motion`: found an integer, expected "free", a line or a plane
      write "free", { line = [1, 0, 0] } or { plane = [0, 0, 1] }
    "#);
    assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = { lines = [0, 0, 1] }\n"), @r#"
    model.toml:12:10: `motion` needs either a line or a plane
      write "free", { line = [1, 0, 0] } or { plane = [0, 0, 1] }
    model.toml:12:12: unknown key "lines" in `motion`
      did you mean `line`? the keys are line, plane
    "#);
    assert_snapshot!(refusal_of("[[point]]\nmass = 1\nposition = [0, 0, 1]\nmotion = { line = [0, 0, \"1 m\"] }\n"), @r#"
    model.toml:12:26: `line`: "1 m" is a length, but a plain number is needed
      write a number without quotes
    "#);
}

#[test]
fn hinge_axes_are_a_list_of_directions() {
    assert_snapshot!(refusal_of(&format!("{HINGED}axes = [0, 0, 1]\nstiffness = 3\n")), @r#"
    model.toml:15:8: `axes`: found an array of 3 values, expected one to three axes, each an array of 3 numbers
      write for example [[0, 0, 1]] for one axis along z
    "#);
    assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0]]\nstiffness = \"3 N/m\"\n")), @r#"
    model.toml:15:9: `axes`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:16:13: `stiffness`: "3 N/m" is a stiffness, but a rotational stiffness is needed
      write for example "0.565 N m/rad", or a plain number in N m/rad
    "#);
}

#[test]
fn a_hinge_has_one_two_or_three_axes() {
    let axes = |count: usize| vec!["[0, 0, 1]"; count].join(", ");
    let hinge = |count| refusal_of(&format!("{HINGED}axes = [{}]\nstiffness = 3\n", axes(count)));
    assert_snapshot!(hinge(0), @r#"
    model.toml:15:8: `axes`: found an array of 0 values, expected one to three axes, each an array of 3 numbers
      write for example [[0, 0, 1]] for one axis along z
    "#);
    assert_snapshot!(hinge(4), @r#"
    model.toml:15:8: `axes`: found an array of 4 values, expected one to three axes, each an array of 3 numbers
      write for example [[0, 0, 1]] for one axis along z
    "#);
}

#[test]
fn a_hinge_can_have_a_stiffness_matrix() {
    let model = read(&format!(
        "{CARRIER}{HINGED}axes = [[0, 1, 0], [0, 0, 1]]\nstiffness = [[3, 1], [1, \"4 N m/rad\"]]\n"
    ));
    assert_eq!(
        model.assembly.hinged[0].stiffness,
        HingeCoefficient::Full(vec![vec![3.0, 1.0], vec![1.0, 4.0]])
    );
    assert_eq!(model.assembly.hinged[0].damping, HingeCoefficient::PerAxis(vec![0.0, 0.0]));
}
