//! The state at time zero: displacements, place and velocity.

use std::f64::consts::PI;

use insta::assert_snapshot;
use quasirigid_io::model::{Displacements, Model};

use super::{CARRIER, HINGED, POINT, read, refusal, refusal_of};

/// A free point, one on a slanted line, one in a slanted plane, and a boom with two axes, in lines 5 to 30.
fn parts() -> String {
    let slider = POINT.replace("tip", "slider");
    let sheet = POINT.replace("tip", "sheet");
    let boom = format!("{HINGED}axes = [[0, 1, 0], [0, 0, 1]]\nstiffness = 3\n");
    let springs: String = ["tip", "slider", "sheet"]
        .iter()
        .map(|name| format!("[[spring]]\nfrom = \"{name}\"\nto = \"carrier\"\nstiffness = 600\n"))
        .collect();
    format!(
        "{POINT}{slider}motion = {{ line = [3, 4, 0] }}\n{sheet}motion = {{ plane = [1, 2, -2] }}\n{boom}{springs}"
    )
}

fn model(lines: &str) -> Model {
    read(&format!("{CARRIER}{}[initial]\n{lines}", parts()))
}

/// Coordinates and their rates at time zero.
fn start(lines: &str) -> (Vec<f64>, Vec<f64>) {
    match model(lines).initial.displacements {
        Displacements::Given { q, rate } => (q, rate),
        Displacements::SlowManifold => panic!("given displacements"),
    }
}

/// Refusal of these lines of `[initial]`, which start in line 46.
fn refused(lines: &str) -> String {
    refusal(&format!("{CARRIER}{}[initial]\n{lines}", parts()))
}

#[test]
fn displacements_are_those_of_the_spin_unless_the_file_gives_others() {
    assert_eq!(model("").initial.displacements, Displacements::SlowManifold);
    assert_eq!(
        model("displacements = \"slow-manifold\"\n").initial.displacements,
        Displacements::SlowManifold
    );
    let still = vec![0.0; 8];
    assert_eq!(start("displacements = \"rest\"\n"), (still.clone(), still.clone()));
    assert_eq!(start("displacements = {}\n"), (still.clone(), still));
}

/// The coordinates move the points of the body, wherever its directions lie, as the file says.
#[test]
fn displacements_are_along_the_axes_of_the_file() {
    let model = model(
        "displacements = { sheet = [0.02, 0, \"1 cm\"], tip = [0.01, -0.03, 0.05], slider = [0.06, 0.08, 0], boom = [0, \"2 deg\"] }\ndisplacement_rates = { slider = [\"-3 mm/s\", -0.004, 0], boom = [\"1 rpm\", 0] }\n",
    );
    let Displacements::Given { q, rate } = model.initial.displacements else { panic!("given displacements") };
    let body = model.assembly.body().expect("a body");
    let units: Vec<_> = body.coordinates().iter().map(|coordinate| coordinate.unit).collect();
    assert_eq!(units, ["m", "m", "m", "m", "m", "m", "rad", "rad"]);
    let moved = |amounts: &[f64], marker: usize| {
        let shapes = body.markers()[marker].shapes.iter();
        shapes.fold([0.0; 3], |sum: [f64; 3], (j, shape)| {
            std::array::from_fn(|axis| sum[axis] + amounts[*j] * shape[axis])
        })
    };
    let near = |found: [f64; 3], expected: [f64; 3]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-16), "{found:?} {expected:?}"); // rounding
    };
    near(moved(&q, 0), [0.01, -0.03, 0.05]);
    near(moved(&q, 1), [0.06, 0.08, 0.0]);
    near(moved(&q, 2), [0.02, 0.0, 0.01]);
    assert_eq!(q[6..], [0.0, 2.0 * PI / 180.0]);
    near(moved(&rate, 0), [0.0; 3]);
    near(moved(&rate, 1), [-0.003, -0.004, 0.0]);
    assert_eq!(rate[6..], [2.0 * PI / 60.0, 0.0]);
}

#[test]
fn rates_alone_start_from_the_equilibrium() {
    let (q, rate) = start("displacements = \"rest\"\ndisplacement_rates = { tip = [1, 2, 3] }\n");
    assert_eq!((q, rate), (vec![0.0; 8], vec![1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    assert_snapshot!(refused("displacement_rates = { tip = [1, 2, 3] }\n"), @r#"
    model.toml:40:22: `displacement_rates` without given `displacements`: the slow manifold has its own rates
      write displacements = "rest" or a table of them, too
    "#);
    assert_snapshot!(refused("displacements = \"slow-manifold\"\ndisplacement_rates = { tip = [1, 2] }\n"), @r#"
    model.toml:41:22: `displacement_rates` without given `displacements`: the slow manifold has its own rates
      write displacements = "rest" or a table of them, too
    model.toml:41:30: `tip`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
}

#[test]
fn a_displacement_that_the_constraints_bar_is_refused() {
    assert_snapshot!(refused("displacements = { slider = [0.06, 0.08, 0.001], sheet = [1, 0, 0] }\n"), @"
    model.toml:40:28: `slider`: its `motion` does not leave the point this way
      of this vector it leaves [0.06, 0.08, 0.0]
    model.toml:40:57: `sheet`: its `motion` does not leave the point this way
      of this vector it leaves [0.8889, -0.2222, 0.2222]
    ");
    // both sides of the line: a millionth of the displacement
    let slider = |across: &str| format!("displacements = {{ slider = [0.6, 0.8, {across}] }}\n");
    assert_eq!(start(&slider("0.7e-6")).0[3], 1.0);
    assert_snapshot!(refused(&slider("0.9e-6")), @"
    model.toml:40:28: `slider`: its `motion` does not leave the point this way
      of this vector it leaves [0.6, 0.8, 0.0]
    ");
    assert_snapshot!(refused("displacements = \"rest\"\ndisplacement_rates = { slider = [0, 0, 1e-300] }\n"), @"
    model.toml:41:33: `slider`: its `motion` does not leave the point this way
      of this vector it leaves [0.0, 0.0, 0.0]
    ");
}

#[test]
fn displacements_of_unknown_parts_are_refused() {
    assert_snapshot!(refused("displacements = { tpi = [0, 0, 1], carrier = [0, 0, 1], x = 1 }\n"), @r#"
    model.toml:40:19: there is no point or appendage "tpi"
      did you mean "tip"? there are tip, slider, sheet, boom
    model.toml:40:36: there is no point or appendage "carrier"
      the rest of the body is displaced from the carrier
    model.toml:40:57: there is no point or appendage "x"
      there are tip, slider, sheet, boom
    "#);
    assert_snapshot!(refusal(&format!("{CARRIER}[initial]\ndisplacements = {{ tip = [0, 0, 1] }}\n")), @r#"
    model.toml:6:19: there is no point or appendage "tip"
      the file has no [[point]] and no [[hinged]]
    "#);
}

#[test]
fn displacements_of_another_form_are_refused() {
    assert_snapshot!(refused("displacements = { tip = [0, 0], boom = [1], slider = 0.1, sheet = [0, 0, \"1 s\"] }\n"), @r#"
    model.toml:40:25: `tip`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:40:40: `boom` has 1 value, but the hinge has 2 axes
      write one value for each axis, in their order
    model.toml:40:54: `slider`: found a decimal number, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:40:74: `sheet`: "1 s" is a time, but a length is needed
      write for example "22 in", or a plain number in m
    "#);
    assert_snapshot!(refused("displacements = { boom = 1 }\ndisplacement_rates = { boom = [1, 2, 3] }\n"), @"
    model.toml:40:26: `boom`: found an integer, expected an array with a value per axis
      write an array with a value per axis
    model.toml:41:31: `boom` has 3 values, but the hinge has 2 axes
      write one value for each axis, in their order
    ");
    assert_snapshot!(refused("displacements = { tip = [0, 0, nan] }\ndisplacement_rates = \"rest\"\n"), @r#"
    model.toml:40:32: `tip` is nan, which is not a finite number
      write a number in m, or a text with its unit such as "22 in"
    model.toml:41:22: `displacement_rates`: found a text, expected a table of names
      write for example { tip = [0.01, 0, 0] }
    "#);
    assert_snapshot!(refused("displacements = [[0, 0, 1]]\n"), @r#"
    model.toml:40:17: `displacements`: found an array of 1 value, expected "slow-manifold", "rest" or a table of names
      write "slow-manifold", "rest", or a table such as { tip = [0.01, 0, 0] }
    "#);
    assert_snapshot!(refused("displacements = \"slow manifold\"\n"), @r#"
    model.toml:40:17: `displacements` cannot be "slow manifold"
      did you mean "slow-manifold"? write "slow-manifold" or "rest"
    "#);
}

#[test]
fn mistakes_in_the_body_do_not_hide_those_in_its_displacements() {
    let text = format!(
        "{}{POINT}[initial]\ndisplacements = {{ tip = [0, \"1 kg\", 0], top = [0, 0, 0] }}\n",
        CARRIER.replace("40.0", "0")
    );
    assert_snapshot!(refusal(&text), @r#"
    model.toml:2:8: `mass` is 0 kg, but must be positive
      write a number in kg, or a text with its unit such as "12 lb"
    model.toml:10:29: `tip`: "1 kg" is a mass, but a length is needed
      write for example "22 in", or a plain number in m
    model.toml:10:41: there is no point or appendage "top"
      did you mean "tip"? there are tip
    "#);
}

/// A `motion` without a direction is refused by the laws of mechanics, at its place.
#[test]
fn a_motion_without_direction_is_not_the_fault_of_the_displacement() {
    let text = format!(
        "{CARRIER}{POINT}motion = {{ line = [0, 0, 0] }}\n[initial]\ndisplacements = {{ tip = [0, 0, 1] }}\n"
    );
    let model = read(&text);
    assert_snapshot!(model.diagnose_all(&model.assembly.check()), @r#"
    model.toml:9:10: `motion` of point "tip": a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
}

#[test]
fn a_free_body_has_a_place_and_a_velocity() {
    let still = model("").initial;
    assert_eq!((still.position, still.velocity), ([0.0; 3], [0.0; 3]));
    let moving = model("position = [1, \"2 km\", 3]\nvelocity = [0, 0, \"7.5 km/s\"]\n").initial;
    assert_eq!((moving.position, moving.velocity), ([1.0, 2000.0, 3.0], [0.0, 0.0, 7500.0]));
    assert_snapshot!(refusal_of("[initial]\nposition = [0, 0]\nvelocity = [\"1 m\", 0, 0]\n"), @r#"
    model.toml:10:12: `position`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:11:13: `velocity`: "1 m" is a length, but a velocity is needed
      write for example "3 km/s", or a plain number in m/s
    "#);
    assert_snapshot!(refusal_of("[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n[initial]\nposition = [0, 0, 0]\n"), @"
    model.toml:13:12: `position` is that of the centre of mass of a free body, and this body is held
      leave it out; the fixed point is the origin of the inertial axes
    ");
    let driven = "[support]\nkind = \"prescribed\"\npoint = [0, 0, 0]\nacceleration = [0, 0, 0]\n";
    assert_snapshot!(refusal_of(&format!("{driven}[initial]\nposition = [0, 0, 1]\nvelocity = [0, 0, 1]\n")), @"
    model.toml:14:12: `position` is that of the centre of mass of a free body, and this body is held
      write `position` in [support], for the driven point
    model.toml:15:12: `velocity` is that of the centre of mass of a free body, and this body is held
      write `velocity` in [support], for the driven point
    ");
}

/// Without a carrier points move with the shapes of the whole: they have no coordinates of their own.
#[test]
fn a_body_without_a_carrier_starts_on_the_slow_manifold_or_at_rest() {
    let mut text = String::new();
    for (name, place) in [("a", "[0, 0, 0]"), ("b", "[1, 0, 0]"), ("c", "[0, 2, 0]")] {
        text += &format!("[[point]]\nname = \"{name}\"\nmass = 1\nposition = {place}\n");
    }
    for (from, to) in [("a", "b"), ("b", "c"), ("c", "a")] {
        text += &format!("[[spring]]\nfrom = \"{from}\"\nto = \"{to}\"\nstiffness = 9\n");
    }
    let rest = read(&format!("{text}[initial]\ndisplacements = \"rest\"\n"));
    assert_eq!(rest.initial.displacements, Displacements::Given { q: Vec::new(), rate: Vec::new() });
    assert_snapshot!(refusal(&format!("{text}[initial]\ndisplacements = {{ b = [0.1, 0, 0] }}\n")), @r#"
    model.toml:26:19: "b" moves with the shapes of a body without a carrier
      write displacements = "slow-manifold" or "rest"
    "#);
}
