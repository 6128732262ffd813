//! Rotors, momentum wheels and liquids.

use insta::assert_snapshot;
use quasirigid::elements::{CavityShape, Regime, RotorKind, WheelSpeed};
use quasirigid_math::rotation::to_inertial;

use super::{CARRIER, read, verdict, written};

fn model(text: &str) -> String {
    format!("{CARRIER}{text}")
}

#[test]
fn rotors_are_read_with_their_units() {
    let flywheel = "[[rotor]]\naxis = [0, 2, 0]\ninertia = \"200 g m^2\"\nfriction = \"0.05 N m s/rad\"\nspeed = \"60 rpm\"\n";
    let ball = "[[rotor]]\nname = \"ball\"\nshape = \"sphere\"\ninertia = 0.1\nfriction = 0.4\n";
    let rotors = read(&model(&format!("{flywheel}{ball}"))).assembly.rotors;
    assert_eq!((rotors[0].name.as_str(), rotors[1].name.as_str()), ("rotor 1", "ball"));
    assert_eq!(rotors[0].kind, RotorKind::Flywheel { axis: [0.0, 2.0, 0.0] });
    assert!((rotors[0].inertia - 0.2).abs() < 1e-16 && rotors[0].friction == 0.05);
    assert!((rotors[0].speed.as_ref().unwrap()[0] / (2.0 * std::f64::consts::PI) - 1.0).abs() < 1e-15);
    assert_eq!((rotors[1].kind, &rotors[1].speed), (RotorKind::Sphere, &None));
}

#[test]
fn wheels_are_read_by_momentum_or_by_speed() {
    let wheel = |keys: &str| {
        let model = read(&model(&format!("[[wheel]]\naxis = [1, 0, 0]\n{keys}\n")));
        model.assembly.wheels[0].speed.clone()
    };
    assert_eq!(wheel("momentum = \"12 N m s\""), WheelSpeed::Constant { angular_momentum: 12.0 });
    assert_eq!(wheel("inertia = 0.5\nspeed = -3"), WheelSpeed::Constant { angular_momentum: -1.5 });
    let WheelSpeed::Prescribed { inertia, speed } = wheel("inertia = 0.5\nspeed = { formula = \"2*t + 1\" }")
    else {
        panic!("a formula")
    };
    assert_eq!((inertia, speed.value(&[3.0])), (0.5, 7.0));
}

const LIQUID: &str = "density = 1000\ndynamic_viscosity = \"1 mPa s\"\n";

#[test]
fn cavities_of_every_shape_are_read() {
    let cavity = |keys: &str| {
        let model = read(&model(&format!("[[cavity]]\n{keys}\n{LIQUID}")));
        model.assembly.cavities[0].clone()
    };
    let sphere = cavity("shape = \"sphere\"\nradius = \"30 cm\"");
    assert_eq!(sphere.shape, CavityShape::Ellipsoid { semi_axes: [0.3; 3] });
    assert!((sphere.viscosity - 1e-6).abs() < 1e-21);
    let across = cavity("shape = \"cylinder\"\nradius = 0.2\nheight = 0.5\naxis = [3, 0, 0]");
    assert_eq!(across.shape, CavityShape::Cylinder { radius: 0.2, height: 0.5 });
    let turned = to_inertial(across.attitude, [0.0, 0.0, 1.0]);
    assert!((turned[0] - 1.0).abs() < 1e-15 && turned[1].abs() < 1e-15);
    let over = cavity("shape = \"ring\"\nradius = 0.3\ntube_radius = \"5 mm\"\naxis = [0, 0, -1]");
    assert_eq!(over.shape, CavityShape::Ring { radius: 0.3, tube_radius: 0.005 });
    assert!((to_inertial(over.attitude, [0.0, 0.0, 1.0])[2] + 1.0).abs() < 1e-15);
    let annulus = cavity("shape = \"annulus\"\nradii = [0.1, 0.2]\nheight = 0.1\nresolution = 4\nmodes = 2");
    assert_eq!(annulus.shape, CavityShape::Annulus { radii: [0.1, 0.2], height: 0.1 });
    assert_eq!((annulus.resolution, annulus.modes, annulus.regime), (4, 2, Regime::Viscous));
    let tank = cavity("shape = \"box\"\nsides = [1, 2, 3]\nflow = \"boundary-layer\"");
    assert_eq!(tank.regime, Regime::BoundaryLayer);
    let cuboid = cavity("shape = \"box\"\nsides = [0.1, 0.2, 0.3]\ncenter = [1, 2, 3]");
    assert_eq!(cuboid.shape, CavityShape::Cuboid { sides: [0.1, 0.2, 0.3] });
    assert_eq!(cuboid.center, [1.0, 2.0, 3.0]);
    let shell = cavity("shape = \"shell\"\nsemi_axes = [1, 2, 3]\ninner_semi_axes = [0.5, 1.5, 2.5]");
    assert_eq!(shell.shape, CavityShape::Shell { outer: [1.0, 2.0, 3.0], inner: [0.5, 1.5, 2.5] });
}

/// A cube as a closed surface, in centimetres, becomes a mesh of its volume.
#[test]
fn a_closed_surface_becomes_a_mesh() {
    let cube = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 10\nv 10 0 10\nv 10 10 10\nv 0 10 10\n\
                f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let text = model(&format!(
        "[[cavity]]\nshape = \"surface\"\nfile = \"cube.obj\"\nunit = \"cm\"\nresolution = 6\n{LIQUID}"
    ));
    let read = written(&[("cube.obj", cube.to_owned())], &text).unwrap();
    let built = read.assembly.build().unwrap();
    assert!((built.liquids[0].mass - 1.0).abs() < 1e-12, "{}", built.liquids[0].mass);
    let missing = written(&[], &text).unwrap_err().to_string();
    assert!(missing.contains("cube.obj"), "{missing}");
}

#[test]
fn what_is_no_rotor_wheel_or_liquid_is_refused() {
    assert_snapshot!(verdict(&model("[[rotor]]\naxis = [0, 0, 1]\ninertia = 0.2\nfriction = 0\n")), @r#"
    model.toml:8:12: `friction` is 0 N m s/rad, but must be positive
      write a number in N m s/rad, or a text with its unit such as "0.01 N m s/rad"
    "#);
    assert_snapshot!(verdict(&model("[[rotor]]\naxis = [0, 0, 1]\ninertia = 90\nfriction = 1\n")), @r"
    model.toml:4:11: the carrier: the rotors and liquids inside have more inertia than the whole body about some axis; the carrier's inertia counts rotors and wheels as locked
      add the inertia of the rotors and liquids inside to that of the carrier, or check the units of both
    ");
    assert_snapshot!(verdict(&model("[[rotor]]\nshape = \"sphere\"\naxis = [0, 0, 1]\ninertia = 0.2\nfriction = 1\n")), @r"
    model.toml:7:8: a sphere turns about any axis, so it has no `axis`
      leave it out
    ");
    assert_snapshot!(verdict(&model("[[wheel]]\naxis = [0, 0, 1]\nmomentum = 3\nspeed = 2\n")), @r"
    model.toml:8:9: `speed` beside `momentum`: the momentum determines it
      give either `momentum`, or `inertia` and `speed`
    ");
    assert_snapshot!(verdict(&model(&format!("[[cavity]]\nshape = \"sphere\"\nheight = 2\nradius = 1\n{LIQUID}"))), @r#"
    model.toml:7:1: `height` is not a key of [[cavity]] of shape "sphere"
      it is for shape = "cylinder" or shape = "annulus"; the keys here are shape, name, radius, center, attitude, density, kinematic_viscosity, dynamic_viscosity, flow, resolution, modes
    "#);
    assert_snapshot!(verdict(&model(&format!("[[cavity]]\nshape = \"annulus\"\nradii = [0.2, 0.1]\nheight = 0.1\n{LIQUID}"))), @r#"model.toml:6:9: `shape` of cavity "cavity 1": the inner length 2e-1 is not less than the outer 1e-1"#);
    assert_snapshot!(verdict(&model(&format!("[[cavity]]\nshape = \"sphere\"\nradius = 1\nkinematic_viscosity = 1\n{LIQUID}"))), @r"
    model.toml:10:21: `dynamic_viscosity` beside `kinematic_viscosity`: each follows from the other
      leave one of them out
    ");
    assert_snapshot!(verdict(&model(&format!("[[cavity]]\nshape = \"sphere\"\nradius = 1\nmodes = 7\n{LIQUID}"))), @r#"
    model.toml:8:9: `modes` of cavity "cavity 1": the responses to 7 rates of change are not offered; choose 0 to 6
      the slow motion needs none of them
    "#);
    assert_snapshot!(verdict(&model(&format!("[[cavity]]\nshape = \"cylinder\"\nradius = 1\nheight = 2\nresolution = 30\n{LIQUID}"))), @r#"
    model.toml:9:14: `resolution` of cavity "cavity 1": the flow in this shape has polynomials of degree 4 to 24, not 30
      8 is enough for six digits; leave `resolution` out
    "#);
    assert_snapshot!(verdict(&model(&format!("[[cavity]]\nshape = \"sphere\"\nradius = 1\nflow = \"ideal\"\n{LIQUID}"))), @r#"
    model.toml:8:8: `flow` cannot be "ideal"
      write "viscous" or "boundary-layer"
    "#);
    let afloat = "[[ellipsoid]]\nsemi_axes = [3, 2, 1]\nmaterial = \"rock\"\n[material.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.25\n\
                  [[rotor]]\naxis = [0, 0, 1]\ninertia = 0.2\nfriction = 1\n";
    assert_snapshot!(verdict(afloat), @r#"
    model.toml:9:8: rotor "rotor 1": this needs a carrier that holds it; the body has none
      add a [carrier]: rotors, wheels and liquids turn in a rigid body
    "#);
}
