//! Partly full rings: what is read, the start of their liquid, and refusals of mistakes.

use insta::assert_snapshot;
use quasirigid::elements::{TankContents, Tube};
use quasirigid_io::model::Displacements;

use super::{CARRIER, read, refusal_of, verdict};

const RING: &str = "shape = \"tube\"\nradius = \"127 mm\"\ntube_radius = \"4.6 mm\"\n";
const MERCURY: &str =
    "liquid_mass = \"120 g\"\ndensity = \"13.53 g/cm^3\"\nkinematic_viscosity = \"0.113 cSt\"\n";

fn text(lines: &str) -> String {
    format!("[[tank]]\nname = \"damper\"\n{lines}")
}

#[test]
fn rings_are_read_with_their_defaults() {
    let model = read(&format!("{CARRIER}{}", text(&format!("{RING}{MERCURY}"))));
    let known = Tube {
        name: "damper".into(),
        radius: 0.127,
        tube_radius: 0.0046,
        center: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        towards: None,
        contents: TankContents::Mass(0.12),
        density: 13_530.0,
        viscosity: 1.13e-7,
        surface_tension: None,
        held: false,
    };
    assert_eq!(model.assembly.tubes, [known]);
    assert_eq!(model.assembly.tanks, []);
}

/// A ring between tanks of revolution: each spin that settles goes to its own tank, and mistakes are told at theirs.
#[test]
fn rings_stand_among_tanks() {
    let ball = |name: &str| {
        format!(
            "[[tank]]\nname = \"{name}\"\nshape = \"sphere\"\nradius = 0.1\ncenter = [2, 0, 0]\nfill = 0.4\ndensity = 1000\nkinematic_viscosity = 1e-6\n"
        )
    };
    let weighed = format!("{}settled_by = {{ acceleration = [0, 0, -1] }}\n", ball("one"));
    let spun = format!("{}settled_by = \"spin\"\n", ball("two"));
    let ring =
        |lines: &str| text(&format!("{RING}fill = 0.2\ndensity = 1000\nkinematic_viscosity = 1e-6\n{lines}"));
    let start = "[initial]\nangular_velocity = [0, 0, 3]\n";
    let model = read(&format!(
        "{CARRIER}{weighed}{}{spun}{start}",
        ring("center = [0, 0.1, 0]\naxis = [1, 0, 0]\ntowards = [0, 1, 1]\nsurface_tension = 0.02\n")
    ));
    assert_eq!(model.assembly.tanks.len(), 2);
    assert_eq!(format!("{:?}", model.assembly.tanks[1].settled_by), "Spin([0.0, 0.0, 3.0])");
    let [own] = &model.assembly.tubes[..] else { panic!("one ring") };
    assert_eq!(
        (own.center, own.axis, own.towards),
        ([0.0, 0.1, 0.0], [1.0, 0.0, 0.0], Some([0.0, 1.0, 1.0]))
    );
    assert_eq!((own.contents, own.surface_tension), (TankContents::Fill(0.2), Some(0.02)));
    assert_snapshot!(verdict(&format!("{CARRIER}{weighed}{}", ring("towards = [0, 0, 1]\n"))), @r#"
    model.toml:22:11: `towards` of tank "damper": the direction of the liquid is along the axis of the ring
      give a direction across `axis`, from the centre of the ring to the middle of the liquid
    "#);
}

/// The liquid starts where the file says, after points and appendages among the coordinates.
#[test]
fn a_liquid_starts_along_its_ring() {
    let point = "[[point]]\nname = \"tip\"\nmass = 1\nposition = [1, 0, 0]\n[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 100\n";
    let start = "[initial]\nangular_velocity = [0, 0, 3]\ndisplacements = { damper = [\"90 deg\"] }\ndisplacement_rates = { damper = [2] }\n";
    let ring = text(&format!("{RING}{MERCURY}"));
    let model = read(&format!("{CARRIER}{ring}{point}{start}"));
    let known = Displacements::Given {
        q: vec![0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2],
        rate: vec![0.0, 0.0, 0.0, 2.0],
    };
    assert_eq!(model.initial.displacements, known);
    let told = |lines: &str| refusal_of(&format!("{ring}[initial]\nangular_velocity = [0, 0, 3]\n{lines}"));
    assert_snapshot!(told("displacements = { damper = [1, 2] }\n"), @r#"
    model.toml:19:28: `damper` has 2 values, but the ring has 1 axis
      write one value for each axis, in their order
    "#);
    assert_snapshot!(told("displacements = { dumper = [1] }\n"), @r#"
    model.toml:19:19: there is no point or appendage "dumper"
      did you mean "damper"? there are tip, damper
    "#);
}

#[test]
fn mistakes_in_rings_are_refused() {
    assert_snapshot!(refusal_of(&text(&format!("shape = \"tube\"\nradius = 1\n{MERCURY}"))), @r#"
    model.toml:9:1: [[tank]] of shape "tube" has no `tube_radius`
      add a line such as: tube_radius = 0.005
    "#);
    assert_snapshot!(refusal_of(&text(&format!("{RING}{MERCURY}settled_by = \"spin\"\n"))), @r#"
    model.toml:17:1: `settled_by` is not a key of [[tank]] of shape "tube"
      it is for shape = "sphere", shape = "ellipsoid", shape = "cylinder", shape = "capsule", shape = "cone" or shape = "profile"; the keys here are shape, name, radius, tube_radius, center, axis, towards, fill, liquid_mass, density, kinematic_viscosity, surface_tension
    "#);
    assert_snapshot!(refusal_of(&text(&format!("{RING}{MERCURY}axis = [0, 0, 0]\n"))), @r#"
    model.toml:17:8: `axis` has no direction
      write a direction such as [0, 0, 1]; its length does not matter
    "#);
    assert_snapshot!(refusal_of(&format!("{}[[spring]]\nfrom = \"damper\"\nto = \"carrier\"\nstiffness = 1\n", text(&format!("{RING}{MERCURY}")))), @r#"
    model.toml:18:8: "damper" is a liquid that slides in the carrier, but a spring joins points, nodes of parts, places on appendages and the carrier
      write "carrier"
    "#);
    let told = |lines: &str| verdict(&format!("{CARRIER}{}", text(lines)));
    assert_snapshot!(told(&format!("shape = \"tube\"\nradius = 0.01\ntube_radius = 0.005\n{MERCURY}")), @r#"
    model.toml:9:15: `tube_radius` of tank "damper": the tube has 0.500 times the radius of the ring; the slug of a slender ring, up to 0.2, is known
      take the mean radius of the ring and the inner radius of the tube; a full ring is a [[cavity]] of shape "ring"
    "#);
    assert_snapshot!(told(&format!("{RING}liquid_mass = 1\ndensity = 1000\nkinematic_viscosity = 1e-6\n")), @r#"
    model.toml:10:15: `liquid_mass` of tank "damper": 1 kg of liquid in a tank that holds 0.053046 kg
      check the units of the mass, of the shape and of the density; a full tank is a [[cavity]]
    "#);
}
