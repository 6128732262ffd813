//! Sunlight: places of the Sun and surfaces that are read, and refusals of mistakes.

use std::fs;

use insta::assert_snapshot;
use quasirigid::model::force::{ForceLaw, SunPath, SunlightLoads, Trajectory};
use quasirigid_io::model::Model;

use super::{CARRIER, read, refusal_of};

const ROCK: &str = "[material.rock]\ndensity = 2500\nshear = 1e9\npoisson = 0.25\n";
const FIXED: &str = "direction = [0, 3, 4]\ndistance = \"1 au\"\n";

fn text(lines: &str) -> String {
    format!("[[force]]\nname = \"light\"\nkind = \"sunlight\"\n{lines}")
}

fn ellipsoid(lines: &str) -> String {
    format!("{ROCK}[[ellipsoid]]\nmaterial = \"rock\"\nsemi_axes = [200, 150, 120]\n{}", text(lines))
}

fn light(model: &Model) -> (&SunlightLoads, &SunPath) {
    match &model.assembly.forces[0].law {
        ForceLaw::Sunlight { loads, sun } => (loads, sun),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_sun_stands_in_a_direction_or_at_the_centre_of_an_orbit() {
    let model = read(&ellipsoid(FIXED));
    let (loads, sun) = light(&model);
    assert_eq!(*sun, SunPath::Fixed { direction: [0.0, 3.0, 4.0], distance: 149_597_870_700.0 });
    assert_eq!((loads.center(), loads.degree()), ([0.0; 3], 8));
    let note = model.notes.iter().find(|note| note.contains("sunlight")).unwrap();
    assert!(note.starts_with("\"light\": the torque of sunlight on 20480 facets is a sum"), "{note}");
    let model =
        read(&ellipsoid("orbit = { body = \"Sun\", semi_major_axis = \"1.2 au\" }\ntolerance = 1e-4\n"));
    let (loads, sun) = light(&model);
    assert!(matches!(sun, SunPath::Orbit(Trajectory::Orbit(_))) && loads.degree() > 8, "{sun:?}");
}

/// A file of its own lights a body of points, in its unit; the loads are about its centroid.
#[test]
fn light_falls_on_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let shape = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    fs::write(folder.path().join("shape.obj"), shape).unwrap();
    let lines = format!("file = \"shape.obj\"\nunit = \"cm\"\nshadows = false\n{FIXED}");
    let model =
        Model::parse(&folder.path().join("model.toml"), &format!("{CARRIER}{}", text(&lines))).unwrap();
    let (loads, _) = light(&model);
    assert!(loads.center().iter().all(|x| (x - 0.01).abs() < 1e-15), "{:?}", loads.center());
    // Along its normal one face is lit, an equilateral triangle with the side 4√2 cm.
    let along = 3f64.sqrt().recip();
    let [force, _] = loads.at([along; 3]);
    let known = 5.0 / 3.0 * 8e-4 * 3f64.sqrt() * along;
    assert!(force.into_iter().all(|found| (found / -known - 1.0).abs() < 0.01), "{force:?} {known}");
}

#[test]
fn mistakes_are_refused() {
    assert_snapshot!(refused(""), @r#"
    model.toml:8:1: [[force]] of kind "sunlight" has no `orbit`
      add a line such as: orbit = { body = "Sun", semi_major_axis = "1.2 au" }, or direction = [1, 0, 0] and distance = "1 au"
    "#);
    assert_snapshot!(refused("distance = \"1 au\"\n"), @r#"
    model.toml:11:12: `distance` is that of the Sun in a `direction`
      add direction = [1, 0, 0], towards the Sun, or give an `orbit` about it alone
    "#);
    assert_snapshot!(refused("direction = [0, 0, 1]\ndistance = 1\n"), @r#"
    model.toml:12:12: `distance` is 1 m, and the radius of the Sun is 695700000 m
      distances are in metres without a unit; write "1 au"
    "#);
    assert_snapshot!(refused("direction = [0, 0, 0]\ndistance = \"1 au\"\n"), @r#"
    model.toml:11:13: `direction` of force "light": a direction of zero length
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
    assert_snapshot!(refused(&format!("{FIXED}orbit = {{ body = \"Sun\", semi_major_axis = \"1 au\" }}\n")), @r#"
    model.toml:13:9: the Sun is the centre of the `orbit`, which says where it stands
      leave out the `orbit`, or `direction` and `distance`
    "#);
    assert_snapshot!(refused("orbit = { body = \"Earth\", semi_major_axis = \"42000 km\" }\n"), @r#"
    model.toml:8:1: `gravitational_parameter` of force "light": the Sun is the centre of the orbit of a body in its light, and this orbit is about a centre of 398600441800000 m^3/s^2
      write body = "Sun" in the orbit, or give a `direction` and a `distance` of the Sun
    "#);
    assert_snapshot!(refused(&format!("{FIXED}tolerance = 1\n")), @r#"
    model.toml:13:13: `tolerance` is 1; the torque is computed to between 0.0001 and 0.1 of its root mean square
      leave it out for 0.01
    "#);
    assert_snapshot!(refusal_of(&text(FIXED)), @r#"
    model.toml:9:1: [[force]] of kind "sunlight" has no `file`
      add a line such as: file = "shape.obj": light falls on a closed surface, and the body is not one [[surface]] or one [[ellipsoid]]
    "#);
}

fn refused(lines: &str) -> String {
    super::verdict(&ellipsoid(lines))
}
