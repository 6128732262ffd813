//! Tanks that are partly full: what is read, and refusals of mistakes.

use insta::assert_snapshot;
use quasirigid::elements::{Settling, Tank, TankContents, TankDamping, TankShape};

use super::{CARRIER, read, refusal_of, verdict};

const SPHERE: &str = "shape = \"sphere\"\nradius = \"40 cm\"\n";
const LIQUID: &str = "fill = 0.4\ndensity = 1000\nkinematic_viscosity = \"1 cSt\"\n";
const DOWN: &str = "settled_by = { acceleration = [0, 0, \"-0.5 m/s^2\"] }\n";

fn text(lines: &str) -> String {
    format!("[[tank]]\nname = \"fuel\"\n{lines}")
}

fn tank(lines: &str) -> Tank {
    read(&format!("{CARRIER}{}", text(lines))).assembly.tanks.remove(0)
}

fn refused(lines: &str) -> String {
    refusal_of(&text(lines))
}

#[test]
fn tanks_are_read_with_their_defaults() {
    let own = tank(&format!("{SPHERE}{LIQUID}{DOWN}"));
    let known = Tank {
        name: "fuel".into(),
        shape: TankShape::Ellipsoid { semi_axes: [0.4; 3] },
        center: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        contents: TankContents::Fill(0.4),
        density: 1000.0,
        damping: TankDamping::WallLayer(1e-6),
        surface_tension: None,
        baffles: Vec::new(),
        wave_amplitude: None,
        measured: Vec::new(),
        settled_by: Settling::Acceleration([0.0, 0.0, -0.5]),
        modes: 2,
    };
    assert_eq!(own, known);
}

#[test]
fn tanks_of_revolution_have_six_shapes() {
    let shape = |lines: &str| tank(&format!("{lines}{LIQUID}{DOWN}")).shape;
    let ellipsoid = shape("shape = \"ellipsoid\"\nsemi_axes = [0.4, 0.4, \"20 cm\"]\n");
    assert_eq!(ellipsoid, TankShape::Ellipsoid { semi_axes: [0.4, 0.4, 0.2] });
    let cylinder = shape("shape = \"cylinder\"\nradius = 0.3\nheight = \"80 cm\"\n");
    assert_eq!(cylinder, TankShape::Cylinder { radius: 0.3, height: 0.8 });
    let capsule = shape("shape = \"capsule\"\nradius = 0.3\nheight = 0.8\n");
    assert_eq!(capsule, TankShape::Capsule { radius: 0.3, height: 0.8 });
    let cone = shape("shape = \"cone\"\nradii = [0, \"30 cm\"]\nheight = 0.8\n");
    assert_eq!(cone, TankShape::Cone { radii: [0.0, 0.3], height: 0.8 });
    let profile = shape("shape = \"profile\"\nprofile = [[0, -1], [0.5, \"20 cm\"], [0, 1]]\n");
    assert_eq!(profile, TankShape::Profile { points: vec![[0.0, -1.0], [0.5, 0.2], [0.0, 1.0]] });
}

#[test]
fn the_rest_of_the_keys() {
    let own = tank(&format!(
        "{SPHERE}center = [0, 1, 2]\naxis = [0, 2, 0]\nliquid_mass = \"2 lb\"\ndensity = \"0.8 g/cm^3\"\ndamping_ratio = 0.02\n\
         surface_tension = \"30 mN/m\"\nsettled_by = {{ acceleration = [0, 1, 0] }}\nmodes = 3\n"
    ));
    assert_eq!((own.center, own.axis, own.density, own.modes), ([0.0, 1.0, 2.0], [0.0, 2.0, 0.0], 800.0, 3));
    assert_eq!((own.contents, own.damping), (TankContents::Mass(0.907_184_74), TankDamping::Ratio(0.02)));
    assert_eq!(own.surface_tension, Some(0.03));
}

/// The spin is that of the start, also in the bodies at the ends of ranges of materials.
#[test]
fn a_spin_that_settles_is_that_of_the_start() {
    let lines = text(&format!("{SPHERE}center = [2, 0, 0]\n{LIQUID}settled_by = \"spin\"\n"));
    let model = read(&format!("{CARRIER}{lines}[initial]\nangular_velocity = [0, 0, \"60 rpm\"]\n"));
    let Settling::Spin([0.0, 0.0, spin]) = model.assembly.tanks[0].settled_by else {
        panic!("a spin about z")
    };
    assert!((spin - std::f64::consts::TAU).abs() < 1e-12);
    assert_snapshot!(refusal_of(&lines), @r#"
    model.toml:17:14: `settled_by`: the spin that settles the liquid is the angular velocity of the start
      add angular_velocity = [0, 0, 1] to [initial], or write settled_by = { acceleration = [0, 0, -0.1] }
    "#);
    assert_snapshot!(refusal_of(&format!("{lines}[initial]\nwobble = {{ angle = 0.1, rate = 1, mode = \"short-axis\" }}\n")), @r#"
    model.toml:17:14: `settled_by`: the spin that settles the liquid is the angular velocity of the start
      add angular_velocity = [0, 0, 1] to [initial], or write settled_by = { acceleration = [0, 0, -0.1] }
    "#);
}

#[test]
fn mistakes_in_tanks_are_refused() {
    assert_snapshot!(refused(&format!("shape = \"ring\"\nradius = 1\n{LIQUID}{DOWN}")), @r#"
    model.toml:11:9: `shape` cannot be "ring"
      write "sphere", "ellipsoid", "cylinder", "capsule", "cone", "profile" or "tube"
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}density = 1000\nkinematic_viscosity = 1e-6\n{DOWN}")), @r#"
    model.toml:9:1: [[tank]] of shape "sphere" has no `fill`
      add a line such as: fill = 0.4, or liquid_mass = "20 kg"
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}{LIQUID}liquid_mass = 3\n{DOWN}")), @r#"
    model.toml:16:15: `liquid_mass` beside `fill`: each follows from the other
      leave one of them out
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}fill = 1.0\ndensity = 1000\nkinematic_viscosity = 1e-6\n{DOWN}")), @r#"
    model.toml:13:8: `fill` is 1, but must be more than 0 and less than 1
      write a number
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}fill = 0.5\ndensity = 1000\n{DOWN}")), @r#"
    model.toml:9:1: [[tank]] of shape "sphere" has no `kinematic_viscosity`
      add a line such as: kinematic_viscosity = "1 cSt", or damping_ratio = 0.01
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}{LIQUID}settled_by = \"thrust\"\n")), @r#"
    model.toml:16:14: `settled_by` cannot be "thrust"
      write { acceleration = [0, 0, -0.1] }, or "spin"
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}{LIQUID}")), @r#"
    model.toml:9:1: [[tank]] of shape "sphere" has no `settled_by`
      add a line such as: settled_by = { acceleration = [0, 0, -0.1] }, or settled_by = "spin"
    "#);
    assert_snapshot!(refused(&format!("{SPHERE}height = 1\n{LIQUID}{DOWN}")), @r#"
    model.toml:13:1: `height` is not a key of [[tank]] of shape "sphere"
      it is for shape = "cylinder", shape = "capsule" or shape = "cone"; the keys here are shape, name, radius, center, axis, fill, liquid_mass, density, kinematic_viscosity, damping_ratio, surface, baffles, wave_amplitude, measured, surface_tension, settled_by, modes
    "#);
}

#[test]
fn tanks_that_cannot_be_are_refused_at_their_key() {
    let told = |lines: &str| verdict(&format!("{CARRIER}{}", text(lines)));
    assert_snapshot!(told(&format!("shape = \"ellipsoid\"\nsemi_axes = [0.4, 0.3, 0.3]\n{LIQUID}{DOWN}")), @r#"
    model.toml:8:13: `semi_axes` of tank "fuel": semi-axes of 0.4 m and 0.3 m across the axis differ: the tank is not of revolution about it
      write semi_axes = [across, across, along] with the third along `axis`
    "#);
    assert_snapshot!(told(&format!("shape = \"capsule\"\nradius = 0.4\nheight = 0.8\n{LIQUID}{DOWN}")), @r#"
    model.toml:9:10: `height` of tank "fuel": a capsule of radius 0.4 m is longer than 0.8 m from end to end, not 0.8 m
      the height of a capsule is measured from end to end; a shorter one is a sphere or an ellipsoid
    "#);
    let profile = |points: &str| told(&format!("shape = \"profile\"\nprofile = {points}\n{LIQUID}{DOWN}"));
    assert_snapshot!(profile("[[0, 0], [1, 0], [1, 1]]"), @r#"
    model.toml:8:11: `profile` of tank "fuel": the profile is open: point 3 is 1 m from the axis, where it should close
      begin and end the profile on the axis, at r = 0
    "#);
    assert_snapshot!(profile("[[0, 0], [1, 0.6], [0.5, 0.3], [1, 1], [0, 1]]"), @r#"
    model.toml:8:11: `profile` of tank "fuel": the profile turns back or crosses itself at point 3: from end to end heights ascend, but for flat ends
      list the points from the lower pole to the upper one; a wall that a horizontal line meets twice is not known
    "#);
    assert_snapshot!(profile("[[0, 0], [1, 0.1], [0, 0.5], [1, 0.9], [0, 1]]"), @r#"
    model.toml:8:11: `profile` of tank "fuel": point 3 of the profile has the distance 0 m from the axis; between the ends it is positive
      cut the tank there into two
    "#);
    let cylinder = "shape = \"cylinder\"\nradius = 0.3\nheight = 0.8\n";
    assert_snapshot!(told(&format!("{cylinder}{LIQUID}settled_by = {{ acceleration = [0.1, 0, -1] }}\n")), @r#"
    model.toml:13:14: `settled_by` of tank "fuel": the liquid is pressed 5.711 degrees off the axis of the tank; slosh is known along the axis, within 1 degrees
      turn `axis`, or approximate the tank by a sphere, of which every direction is an axis
    "#);
    assert_snapshot!(told(&format!("{cylinder}liquid_mass = 300\ndensity = 1000\nkinematic_viscosity = 1e-6\n{DOWN}")), @r#"
    model.toml:10:15: `liquid_mass` of tank "fuel": 300 kg of liquid in a tank that holds 226.194671 kg
      check the units of the mass, of the shape and of the density; a full tank is a [[cavity]]
    "#);
}
