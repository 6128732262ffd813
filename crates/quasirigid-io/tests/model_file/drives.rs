//! Parts that drives move: what is read, their place among the coordinates, and refusals of mistakes.

use insta::assert_snapshot;
use quasirigid::elements::{Boom, HingeCoefficient, PrescribedMotion};
use quasirigid_io::model::Displacements;

use super::{CARRIER, HINGED, POINT, read, refusal_of, verdict};

const BOOM: &str =
    "[[boom]]\nname = \"mast\"\nposition = [\"50 cm\", 0, 0]\ndirection = [0, 0, 2]\ntip_mass = \"800 g\"\n";
const START: &str = "[initial]\nangular_velocity = [0, 0, 3]\n";

fn formula(motion: &PrescribedMotion) -> &str {
    motion.law().map_or("", |law| law.text())
}

#[test]
fn booms_and_driven_hinges_are_read() {
    let model = read(&format!(
        "{CARRIER}{BOOM}length = {{ formula = \"1 + 0.1*t\" }}\n{HINGED}axes = [[0, 0, 1]]\nangle = {{ formula = \"0.2*t\" }}\n"
    ));
    let [mast] = &model.assembly.booms[..] else { panic!("one boom") };
    let length = mast.length.clone();
    assert_eq!(formula(&length), "1 + 0.1*t");
    let known = Boom {
        name: "mast".into(),
        position: [0.5, 0.0, 0.0],
        direction: [0.0, 0.0, 2.0],
        mass: 0.0,
        tip_mass: 0.8,
        length,
    };
    assert_eq!(*mast, known);
    let [boom] = &model.assembly.hinged[..] else { panic!("one hinge") };
    assert_eq!(formula(boom.angle.as_ref().unwrap()), "0.2*t");
    assert_eq!(boom.stiffness, HingeCoefficient::PerAxis(vec![0.0]));
    let locked = read(&format!(
        "{CARRIER}{BOOM}length = \"150 cm\"\n{HINGED}axes = [[0, 0, 1]]\nangle = \"90 deg\"\n"
    ));
    assert_eq!(locked.assembly.booms[0].length, PrescribedMotion::Constant(1.5));
    assert_eq!(
        locked.assembly.hinged[0].angle,
        Some(PrescribedMotion::Constant(std::f64::consts::FRAC_PI_2))
    );
}

/// A driven part has a coordinate between those of hinges and rings; a locked one has none.
#[test]
fn coordinates_of_driven_parts_are_numbered() {
    let spring = "[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 100\n";
    let at = |length: &str| {
        let start = format!("{START}displacements = {{ tip = [0.1, 0, 0] }}\n");
        let model = read(&format!("{CARRIER}{POINT}{spring}{BOOM}length = {length}\n{start}"));
        let Displacements::Given { q, .. } = model.initial.displacements else { panic!() };
        assert_eq!(q.len(), model.assembly.body().unwrap().coordinates().len());
        q
    };
    assert_eq!(at("{ formula = \"t\" }"), [0.1, 0.0, 0.0, 0.0]);
    assert_eq!(at("2"), [0.1, 0.0, 0.0]);
}

#[test]
fn mistakes_in_driven_parts_are_refused() {
    assert_snapshot!(refusal_of(&format!("{HINGED}axes = [[0, 0, 1]]\nangle = 0.2\ndamping = 3\n")), @r#"
    model.toml:17:11: `damping` beside `angle`: a drive holds the hinge at its angle
      give either `angle`, or the spring and the damper of the hinge
    "#);
    assert_snapshot!(refusal_of(&format!("{BOOM}length = {{ formula = \"x\" }}\n")), @r#"
    model.toml:14:23: `formula`: unknown name `x`; known are `t`, `pi`, `e`
      write a formula in t (s) that gives m, or a number
    "#);
    assert_snapshot!(refusal_of(&format!("{BOOM}length = 1\nmass = -2\n")), @r#"
    model.toml:15:8: `mass` is -2 kg, but must be zero or positive
      write zero or a positive value
    "#);
    assert_snapshot!(refusal_of(&format!("{BOOM}length = {{ formula = \"t\" }}\n{START}displacements = {{ mast = [1] }}\n")), @r#"
    model.toml:17:19: "mast" has the place that its `length` gives at t = 0
      leave it out, and change `length`
    "#);
    assert_snapshot!(refusal_of(&format!("{BOOM}length = 1\n[[spring]]\nfrom = \"mast\"\nto = \"carrier\"\nstiffness = 1\n")), @r#"
    model.toml:16:8: "mast" is a boom that is run out, but a spring joins points, nodes of parts, places on appendages and the carrier
      write "carrier", with the place of its root
    "#);
    let two = format!("{CARRIER}{HINGED}axes = [[0, 0, 1], [0, 1, 0]]\nangle = {{ formula = \"t\" }}\n");
    assert_snapshot!(verdict(&two), @r#"
    model.toml:12:9: `angle` of appendage "boom": a drive turns a hinge about one axis, not 2
      write one axis, for example axes = [[0, 0, 1]], or leave `angle` out
    "#);
    let empty = BOOM.replace("tip_mass = \"800 g\"\n", "");
    assert_snapshot!(verdict(&format!("{CARRIER}{empty}length = 1\n")), @r#"
    model.toml:5:1: `mass` of boom "mast": 0 kg is not a mass; it must be positive
      write a positive mass, or leave the element out
    "#);
    assert_snapshot!(verdict(&format!("{CARRIER}{BOOM}length = {{ formula = \"ln(t)\" }}\n")), @r#"
    model.toml:10:10: `length` of boom "mast": -inf is not a finite number
      write a finite number
    "#);
}
