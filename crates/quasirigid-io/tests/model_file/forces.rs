//! External forces and the driven pole: values that are read, and refusals of mistakes.

use std::f64::consts::{PI, TAU};

use insta::assert_snapshot;
use quasirigid::elements::{ApplicationPoint, End, PlaceRef, Prestress};
use quasirigid::model::Support;
use quasirigid::model::force::{Axes, Force, ForceLaw, MagneticField, Orbit, Trajectory, Wave};
use quasirigid_math::expression::Expression;

use super::{CARRIER, HINGED, POINT, read, refusal, refusal_of};

const ORBIT: &str = "orbit = { body = \"Earth\", semi_major_axis = \"6778 km\" }\n";

/// The forces of a body with a point and these further lines, which start in line 9.
fn forces(lines: &str) -> Vec<Force<ApplicationPoint>> {
    read(&format!("{CARRIER}{POINT}{lines}")).assembly.forces
}

/// The only force, of this kind and with these further lines.
fn law(kind: &str, lines: &str) -> ForceLaw<ApplicationPoint> {
    let [force] = forces(&text(kind, lines)).try_into().expect("one force");
    force.law
}

fn text(kind: &str, lines: &str) -> String {
    format!("[[force]]\nkind = \"{kind}\"\n{lines}")
}

/// Refusal of a force; its kind is in line 10, the lines start in line 11.
fn refused(kind: &str, lines: &str) -> String {
    refusal_of(&text(kind, lines))
}

fn orbit(a: f64) -> Orbit {
    Orbit {
        mu: 3.986_004_418e14,
        semi_major_axis: a,
        eccentricity: 0.0,
        inclination: 0.0,
        raan: 0.0,
        argument_of_periapsis: 0.0,
        mean_anomaly: 0.0,
        node_rate: 0.0,
        periapsis_rate: 0.0,
    }
}

/// A thrust may turn with its place; a torque, which acts on the carrier, and a formula, in inertial axes, do not.
#[test]
fn axes_of_a_place_are_those_of_a_thrust() {
    let at = "on = \"tip\"\naxes = \"place\"\n";
    let axes = |lines: &str| match law("thrust", &format!("{at}{lines}")) {
        ForceLaw::Thrust { axes, .. } => axes,
        other => panic!("{other:?}"),
    };
    assert_eq!(axes("force = [0, 0, 1]\n"), Axes::Place);
    for refusal in [
        refused("torque", "torque = [0, 0, 1]\naxes = \"place\"\n"),
        refused("expression", "torque = [\"0\", \"0\", \"1\"]\naxes = \"place\"\n"),
        refused("expression", &format!("{at}force = [\"0\", \"0\", \"1\"]\n")),
    ] {
        assert!(refusal.contains("axes"), "{refusal}");
    }
}

#[test]
fn forces_without_places_are_read() {
    let gravity = law("uniform-gravity", "acceleration = [0, \"1 m/s^2\", -9.81]\n");
    assert_eq!(gravity, ForceLaw::UniformGravity { acceleration: [0.0, 1.0, -9.81] });
    let drag = law("spin-drag", "coefficient = \"2 mN m s/rad\"\n");
    assert_eq!(drag, ForceLaw::SpinDrag { coefficient: 2e-3 });
    let torque = law("torque", "torque = [0, 1, \"0.05 N m\"]\n");
    let wave = Wave { frequency: 0.0, phase: 0.0 };
    assert_eq!(torque, ForceLaw::Torque { torque: [0.0, 1.0, 0.05], axes: Axes::Body, wave });
    let pulse = law("torque", "torque = [0, 1, 0]\naxes = \"inertial\"\nfrequency = 3\nphase = \"30 deg\"\n");
    let wave = Wave { frequency: 3.0, phase: 30.0 * PI / 180.0 };
    assert_eq!(pulse, ForceLaw::Torque { torque: [0.0, 1.0, 0.0], axes: Axes::Inertial, wave });
}

#[test]
fn forces_act_at_points_and_at_places_of_the_carrier() {
    let tip = ApplicationPoint { on: End::Point(0), at: None };
    let place = ApplicationPoint { on: End::Carrier, at: Some([0.1, 0.25, 0.0]) };
    assert_eq!(
        law("drag", "on = \"tip\"\ncoefficient = 0.3\n"),
        ForceLaw::Drag { at: tip, coefficient: 0.3 }
    );
    let drag = law("drag", "on = \"carrier\"\nat = [\"10 cm\", 0.25, 0]\ncoefficient = \"1 lbf s/ft\"\n");
    let ForceLaw::Drag { at, coefficient } = drag else { panic!("a drag") };
    assert_eq!(at, place);
    assert!((coefficient - 14.593_902_937_206_364).abs() < 1e-14 * coefficient); // NIST SP 811, lbf/ft
    let thrust =
        law("thrust", "on = \"tip\"\nforce = [\"5 mN\", 0, 1]\nperiod = \"10 s\"\naxes = \"body\"\n");
    let wave = Wave { frequency: TAU / 10.0, phase: 0.0 };
    assert_eq!(thrust, ForceLaw::Thrust { at: tip, force: [5e-3, 0.0, 1.0], axes: Axes::Body, wave });
    let formulas = law(
        "expression",
        "on = \"carrier\"\nat = [0.1, 0.25, 0]\nforce = [\"-0.1*vx\", -2.5e-7, 'sin(2*t)']\n",
    );
    let ForceLaw::Expression { at, force } = formulas else { panic!("an expression") };
    assert_eq!(at, place);
    assert_eq!(force.each_ref().map(Expression::text), ["-0.1*vx", "-2.5e-7", "sin(2*t)"]);
    let numbers: [f64; 14] = std::array::from_fn(|i| 1.0 + i as f64);
    assert_eq!(force[0].value(&numbers), -0.4);
    assert_eq!(force[1].value(&[0.0; 14]), -2.5e-7);
    let mut time = [0.0; 14];
    time[6] = PI / 4.0;
    assert_eq!(force[2].value(&time), 1.0);
    let torque = law("expression", "torque = [\"-wx*qw\", 0, \"vz + wz*qz\"]\naxes = \"inertial\"\n");
    let ForceLaw::TorqueExpression { torque, axes } = torque else { panic!("a torque") };
    assert_eq!(axes, Axes::Inertial);
    assert_eq!([torque[0].value(&numbers), torque[2].value(&numbers)], [-88.0, 6.0 + 10.0 * 14.0]);
}

#[test]
fn a_formula_is_that_of_a_force_or_of_a_torque() {
    assert_snapshot!(refused("expression", "torque = [0, 0, 1]\nforce = [0, 0, 1]\n"), @"
    model.toml:12:9: `force` goes with a `force`, and this is a `torque` on the carrier
      leave it out, or write one [[force]] for each
    ");
    assert_snapshot!(refused("expression", "on = \"tip\"\nforce = [0, 0, 1]\naxes = \"body\"\n"), @"
    model.toml:13:8: `axes` are those of a `torque`; the formulas of a force are in inertial axes
      turn the force with qw qx qy qz, or give a torque
    ");
}

#[test]
fn forces_and_springs_act_at_places_on_appendages() {
    let boom = format!(
        "{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\nplaces = {{ root = [0.5, 0, 0], tip = [\"150 cm\", 0.25, 0] }}\n"
    );
    let spring = |node: &str| {
        format!("[[spring]]\nfrom = {{ part = \"boom\", node = \"{node}\" }}\nto = \"tip\"\nstiffness = 1\n")
    };
    let drag = text("drag", "on = { part = \"boom\", node = \"root\" }\ncoefficient = 1\n");
    let model = read(&format!("{CARRIER}{POINT}{boom}{}{drag}", spring("tip")));
    let on = |place| End::Hinged(PlaceRef { hinged: 0, place });
    assert_eq!(model.assembly.hinged[0].places[1], ("tip".to_owned(), [1.5, 0.25, 0.0]));
    assert_eq!(model.assembly.springs[0].from, on(1));
    assert_eq!(model.assembly.forces[0].law.place().unwrap().on, on(0));
    assert_snapshot!(refusal_of(&format!("{boom}{}", spring("tap"))), @r#"
    model.toml:19:32: there is no place "tap" on "boom"
      did you mean "tip"? there are root, tip
    "#);
    let bare = format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n");
    assert_snapshot!(refusal_of(&format!("{bare}{}", spring("tip"))), @r#"
    model.toml:18:32: there is no place "tip" on "boom"
      add places = { tip = [...] } to its [[hinged]]
    "#);
}

#[test]
fn springs_pull_at_rest_as_they_say() {
    let axial = |line: &str| {
        format!(
            "{CARRIER}{POINT}[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 40\naxial = true\nanchor = [0, 0, 0]\n{line}\n"
        )
    };
    let prestress = |line: &str| match read(&axial(line)).assembly.springs[0].law {
        quasirigid::elements::SpringLaw::Axial { prestress, .. } => prestress,
        _ => panic!("an axial spring"),
    };
    assert_eq!(prestress(""), Prestress::Relaxed);
    assert_eq!(prestress("tension = \"-2 kN\""), Prestress::Tension(-2000.0));
    assert_eq!(prestress("natural_length = \"90 cm\""), Prestress::NaturalLength(0.9));
    assert_snapshot!(refusal(&axial("tension = 3\nnatural_length = 1")), @"
    model.toml:16:18: the `natural_length` follows from the `tension`
      leave out one of the two
    ");
}

#[test]
fn a_frequency_is_in_radians_unless_it_is_in_hertz() {
    let frequency = |lines: &str| match law("torque", &format!("torque = [0, 1, 0]\n{lines}\n")) {
        ForceLaw::Torque { wave, .. } => wave.frequency,
        _ => panic!("a torque"),
    };
    assert_eq!(frequency("frequency = 2"), 2.0);
    assert_eq!(frequency("frequency = \"2 rad/s\""), 2.0);
    assert_eq!(frequency("frequency = \"2 Hz\""), 2.0 * TAU);
    assert_eq!(frequency("frequency = \"2 mHz\""), 2e-3 * TAU);
    assert_eq!(frequency("period = 0.5"), 2.0 * TAU);
    assert_eq!(frequency("frequency = \"60 rpm\""), TAU);
}

#[test]
fn orbits_are_read() {
    let simple = law("central-gravity", ORBIT);
    assert_eq!(simple, ForceLaw::CentralGravity { orbit: orbit(6.778e6).into() });
    let full = "[force.orbit]\ngravitational_parameter = \"398600.4418 km^3/s^2\"\nsemi_major_axis = 7e6\neccentricity = 0.1\ninclination = \"180 deg\"\nnode = 1\nperiapsis = 2\nmean_anomaly = 3\n";
    let expected = Orbit {
        eccentricity: 0.1,
        inclination: PI,
        raan: 1.0,
        argument_of_periapsis: 2.0,
        mean_anomaly: 3.0,
        ..orbit(7e6)
    };
    assert_eq!(law("central-gravity", full), ForceLaw::CentralGravity { orbit: expected.into() });
}

/// Rates of (F20): by the oblateness of the centre, or as given; one without a known oblateness is refused.
#[test]
fn orbits_precess_where_it_is_asked() {
    let of = |keys: &str| {
        let orbit = format!("orbit = {{ {keys}, semi_major_axis = 7.2e6, inclination = \"50 deg\" }}\n");
        match law("central-gravity", &orbit) {
            ForceLaw::CentralGravity { orbit: Trajectory::Orbit(orbit) } => {
                [orbit.node_rate, orbit.periapsis_rate]
            }
            _ => panic!("gravity"),
        }
    };
    let unit = 1.5
        * (3.986_004_418e14 / 7.2e6_f64.powi(3)).sqrt()
        * 1.082_635_5e-3
        * (6_378_136.3 / 7.2e6_f64).powi(2);
    let cosine = 50f64.to_radians().cos();
    let [node, periapsis] = of("body = \"Earth\", precession = \"J2\"");
    assert!((node / (-unit * cosine) - 1.0).abs() < 1e-14, "{node}");
    assert!((periapsis / (unit * (2.5 * cosine * cosine - 0.5)) - 1.0).abs() < 1e-14, "{periapsis}");
    assert_eq!(of("body = \"Earth\""), [0.0; 2]);
    let given = of("gravitational_parameter = 4e14, precession = { node = \"-5 deg/d\" }");
    assert!((given[0] * 86_400.0 * 180.0 / PI + 5.0).abs() < 1e-13 && given[1] == 0.0, "{given:?}");
    let refused =
        refused("central-gravity", "orbit = { body = \"Sun\", precession = \"J2\", semi_major_axis = 1 }\n");
    assert!(refused.contains("the oblateness of this centre is not known here"), "{refused}");
    let inside = self::refused(
        "central-gravity",
        "orbit = { body = \"Earth\", precession = \"J2\", semi_major_axis = \"7200 km\", eccentricity = 0.2 }\n",
    );
    assert!(inside.contains("comes to 5760 km from the centre, inside the body"), "{inside}");
}

/// The main field has the year and the sidereal time of its epoch; one out of its range, or beside another field, is refused.
#[test]
fn the_main_field_is_read() {
    let of = |igrf: &str| format!("moment = [0, 0, 1]\nigrf = {igrf}\n{ORBIT}");
    let ForceLaw::MagneticDipole { field: MagneticField::Earth { field, orbit: own }, .. } =
        law("magnetic-dipole", &of("{ epoch = \"2024-07-02T00:00:00\", degree = 4 }"))
    else {
        panic!("the main field")
    };
    assert_eq!((field.year, field.degree, own), (2024.5, 4, orbit(6.778e6)));
    // 8948.5 days after noon of 2000-01-01
    assert!((field.sidereal.to_degrees() - 280.526_076).abs() < 1e-5, "{}", field.sidereal.to_degrees());
    let refused = |igrf: &str| refused("magnetic-dipole", &of(igrf));
    assert!(refused("{ epoch = \"2031-01-01\" }").contains("known from 1900 to 2030, not in 2031.0"));
    assert!(refused("{ epoch = \"1899-12-31\" }").contains("not in 1900.0"));
    assert!(refused("{ epoch = \"yesterday\" }").contains("no epoch"));
    assert!(refused("{ epoch = \"2024-01-01\", degree = 14 }").contains("14"));
    assert!(refused("{ degree = 3 }").contains("has no `epoch`"));
    let twice = refused("{ epoch = \"2024-01-01\" }\nfield = [0, 0, 1]");
    assert!(twice.contains("given by `igrf` already"), "{twice}");
}

/// Against the system of astronomical constants of the IAU (2009): masses as ratios, the Gaussian constant for the Sun,
/// and the geostationary radius for the Earth.
#[test]
fn the_centres_known_by_name_have_their_gravitational_parameters() {
    let parameter = |body: &str| {
        let orbit = format!("orbit = {{ body = \"{body}\", semi_major_axis = 1e12 }}\n");
        match law("central-gravity", &orbit) {
            ForceLaw::CentralGravity { orbit } => orbit.mu(),
            _ => panic!("gravity"),
        }
    };
    let close = |body: &str, expected: f64, digits: i32| {
        let found = parameter(body);
        assert!((found / expected - 1.0).abs() < 10f64.powi(-digits), "{body}: {found:e} {expected:e}");
    };
    close("Earth", 7.292_115e-5_f64.powi(2) * 42_164_170.0_f64.powi(3), 6); // seven digits of the radius
    close("Moon", 0.012_300_037_1 * parameter("Earth"), 7);
    close("Sun", (0.017_202_098_95 / 86_400.0_f64).powi(2) * 149_597_870_700.0_f64.powi(3), 8);
    close("Mars", parameter("Sun") / 3_098_703.59, 6); // with its moons, which are 2e-8 of it
}

#[test]
fn magnetic_fields_are_read() {
    let uniform = law("magnetic-dipole", "moment = [0, \"200 mA m^2\", 1]\nfield = [0, 0, \"30 uT\"]\n");
    let moment = [0.0, 0.2, 1.0];
    let field = MagneticField::Uniform([0.0, 0.0, 3e-5]);
    assert_eq!(uniform, ForceLaw::MagneticDipole { moment, field });
    let dipole =
        law("magnetic-dipole", &format!("moment = [0, 0.2, 1]\ndipole = [0, \"1 T m^3\", -7.8e15]\n{ORBIT}"));
    let field = MagneticField::Dipole { strength: [0.0, 1.0, -7.8e15], rate: 0.0, orbit: orbit(6.778e6) };
    assert_eq!(dipole, ForceLaw::MagneticDipole { moment, field });
}

#[test]
fn forces_have_names_of_their_own() {
    let drag = "[[force]]\nkind = \"spin-drag\"\ncoefficient = 1\n";
    let names: Vec<String> =
        forces(&format!("{drag}{drag}name = \"tip\"\n")).into_iter().map(|force| force.name).collect();
    assert_eq!(names, ["force 1", "tip"]);
    assert_snapshot!(refusal_of(&format!("{drag}name = \"a\"\n{drag}name = \"a\"\n")), @r#"
    model.toml:16:8: the name "a" is used twice; it stands first in line 12
      give each element its own name
    "#);
    assert_snapshot!(refused("spin-drag", "coefficient = 1\nname = \"\"\n"), @"
    model.toml:12:8: `name` is empty
      write the name in quotes
    ");
}

#[test]
fn a_force_says_its_kind() {
    assert_snapshot!(refusal_of("[[force]]\ntorque = [0, 0, 1]\n[[force]]\nknd = \"drag\"\n"), @r#"
    model.toml:9:1: [[force]] has no `kind`
      add a line such as: kind = "uniform-gravity", "central-gravity", "drag", "spin-drag", "torque", "thrust", "magnetic-dipole", "eddy-current", "sunlight" or "expression"
    model.toml:12:1: unknown key "knd" in [[force]]
      did you mean `kind`? the keys are kind, name, on, at, coefficient, acceleration, orbit, torque, force, axes, frequency, period, phase, moment, field, dipole, dipole_rate, igrf, tensor, conductivity, shape, radius, thickness, direction, distance, file, unit, strict, shadows, tolerance, timetable, interpolation, during
    "#);
    assert_snapshot!(refused("drga", "anything = 1\n"), @r#"
    model.toml:10:8: `kind` cannot be "drga"
      did you mean "drag"? write "uniform-gravity", "central-gravity", "drag", "spin-drag", "torque", "thrust", "magnetic-dipole", "eddy-current", "sunlight" or "expression"
    "#);
    assert_snapshot!(refused("wind", ""), @r#"
    model.toml:10:8: `kind` cannot be "wind"
      write "uniform-gravity", "central-gravity", "drag", "spin-drag", "torque", "thrust", "magnetic-dipole", "eddy-current", "sunlight" or "expression"
    "#);
    assert_snapshot!(refusal_of("[[force]]\nkind = 3\n"), @"
    model.toml:10:8: `kind`: found an integer, expected a text
      write the kind in quotes
    ");
    assert_snapshot!(refusal_of("[force]\nkind = \"drag\"\n"), @"
    model.toml:9:1: `force` is a list of tables, but a table stands here
      write [[force]], with double brackets, once for each
    ");
    assert_snapshot!(refusal(&format!("force = [\"drag\"]\n{CARRIER}")), @"
    model.toml:1:10: `force`: found a text, expected a table
      write [[force]] with its keys
    ");
}

#[test]
fn a_key_of_another_kind_is_refused() {
    assert_snapshot!(refused("drag", "on = \"tip\"\ncoefficient = 1\nperiod = 3\ncoeficient = 1\n"), @r#"
    model.toml:13:1: `period` is not a key of [[force]] of kind "drag"
      it is for kind = "torque" or kind = "thrust"; the keys here are kind, name, on, at, coefficient, during
    model.toml:14:1: unknown key "coeficient" in [[force]] of kind "drag"
      did you mean `coefficient`? the keys are kind, name, on, at, coefficient, during
    "#);
    assert_snapshot!(refused("uniform-gravity", "acceleration = [0, 0, -9.81]\norbit = {}\n"), @r#"
    model.toml:12:1: `orbit` is not a key of [[force]] of kind "uniform-gravity"
      it is for kind = "central-gravity", kind = "magnetic-dipole", kind = "eddy-current" or kind = "sunlight"; the keys here are kind, name, acceleration, during
    "#);
}

#[test]
fn what_a_force_needs_is_asked_for() {
    let kinds = [
        "uniform-gravity",
        "central-gravity",
        "drag",
        "spin-drag",
        "torque",
        "thrust",
        "magnetic-dipole",
        "eddy-current",
        "expression",
    ];
    let all: String = kinds.iter().map(|kind| text(kind, "")).collect();
    assert_snapshot!(refusal_of(&all), @r#"
    model.toml:9:1: [[force]] of kind "uniform-gravity" has no `acceleration`
      add a line such as: acceleration = [0, 0, -9.81]
    model.toml:11:1: [[force]] of kind "central-gravity" has no `orbit`
      add a line such as: orbit = { body = "Earth", semi_major_axis = "6778 km", inclination = "51.6 deg" }
    model.toml:13:1: [[force]] of kind "drag" has no `on`
      add a line such as: on = "carrier"
    model.toml:13:1: [[force]] of kind "drag" has no `coefficient`
      add a line such as: coefficient = "0.2 N s/m"
    model.toml:15:1: [[force]] of kind "spin-drag" has no `coefficient`
      add a line such as: coefficient = "1e-4 N m s"
    model.toml:17:1: [[force]] of kind "torque" has no `torque`
      add a line such as: torque = [0, 0, "0.05 N m"]
    model.toml:19:1: [[force]] of kind "thrust" has no `on`
      add a line such as: on = "carrier"
    model.toml:19:1: [[force]] of kind "thrust" has no `force`
      add a line such as: force = [0, 0, "5 mN"]
    model.toml:21:1: [[force]] of kind "magnetic-dipole" has no `moment`
      add a line such as: moment = [0, 0, "0.2 A m^2"]
    model.toml:21:1: [[force]] of kind "magnetic-dipole" has no `field`
      add a line such as: field = [0, 0, "30 uT"], or dipole = [0, 0, 7.8e15] and an orbit, or igrf = { epoch = "2024-03-01" } and an orbit
    model.toml:23:1: [[force]] of kind "eddy-current" has no `tensor`
      add a line such as: tensor = "5662 S m^4", or conductivity = "25 MS/m" with shape, radius and thickness
    model.toml:23:1: [[force]] of kind "eddy-current" has no `field`
      add a line such as: field = [0, 0, "30 uT"], or dipole = [0, 0, 7.8e15] and an orbit, or igrf = { epoch = "2024-03-01" } and an orbit
    model.toml:25:1: [[force]] of kind "expression" has no `on`
      add a line such as: on = "carrier"
    model.toml:25:1: [[force]] of kind "expression" has no `force`
      add a line such as: force = ["-0.1*vx", "0", "sin(2*t)"]
    "#);
    assert_snapshot!(refused("central-gravity", "orbit = {}\n"), @r#"
    model.toml:11:9: `orbit` has no `gravitational_parameter`
      add a line such as: body = "Earth", or gravitational_parameter = 3.986e14
    model.toml:11:9: `orbit` has no `semi_major_axis`
      add a line such as: semi_major_axis = "6778 km"
    "#);
}

#[test]
fn a_force_in_the_wrong_unit_is_refused() {
    assert_snapshot!(refused("torque", "torque = [0, \"1 N\", 0]\nphase = \"3 s\"\nperiod = \"2 Hz\"\n"), @r#"
    model.toml:11:14: `torque`: "1 N" is a force, but a torque is needed
      write for example "3 lbf ft", or a plain number in N m
    model.toml:12:9: `phase`: "3 s" is a time, but an angle is needed
      write for example "30 deg", or a plain number in rad
    model.toml:13:10: `period`: "2 Hz" is a quantity in s^-1, but a time is needed
      write for example "2 h", or a plain number in s
    "#);
    assert_snapshot!(refused("uniform-gravity", "acceleration = [0, 0, \"-1 g\"]\n"), @r#"
    model.toml:11:23: `acceleration`: "-1 g" is a mass, but an acceleration is needed
      write for example "32 ft/s^2", or a plain number in m/s^2
    "#);
    assert_snapshot!(refused("drag", "on = \"tip\"\ncoefficient = \"-3 N s/m\"\n"), @"
    model.toml:12:15: `coefficient` is -3 N s/m, but must be zero or positive
      write zero or a positive value
    ");
    assert_snapshot!(refused("magnetic-dipole", "moment = [0, 0, \"1 A\"]\nfield = [0, \"3 uF\", nan]\n"), @r#"
    model.toml:11:17: `moment`: "1 A" is a quantity in A, but a magnetic moment is needed
      write for example "200 mA m^2", or a plain number in A m^2
    model.toml:12:13: `field`: there is no unit "uF"
      units are symbols, for example kg, lb, m, in, s, h, rad, deg, rpm, N, lbf
    model.toml:12:21: `field` is nan, which is not a finite number
      write a number in T, or a text with its unit such as "30 uT"
    "#);
}

#[test]
fn a_force_acts_on_a_point_or_the_carrier() {
    assert_snapshot!(refused("drag", "on = \"tpi\"\ncoefficient = 1\n"), @r#"
    model.toml:11:6: there is no point "tpi"
      did you mean "tip"? there are carrier, tip
    "#);
    let boom = format!("{HINGED}axes = [[0, 0, 1]]\nstiffness = 3\n");
    assert_snapshot!(refusal_of(&format!("{boom}{}", text("drag", "on = \"boom\"\ncoefficient = 1\n"))), @r#"
    model.toml:19:6: "boom" is a hinged appendage, but a force acts on a point, on a node of a part, on a place of an appendage or on the carrier
      give it places = { tip = [...] } and write { part = "boom", node = "tip" }
    "#);
}

#[test]
fn a_wave_has_a_frequency_or_a_period() {
    let wave = |lines: &str| refused("torque", &format!("torque = [0, 0, 1]\n{lines}"));
    assert_snapshot!(wave("frequency = 1\nperiod = 2\n"), @"
    model.toml:13:10: the `period` follows from the `frequency`
      leave out one of the two
    ");
    assert_snapshot!(wave("phase = 1\n"), @r#"
    model.toml:12:9: a `phase` without a `frequency` or a `period`
      add for example frequency = "2 Hz", or leave it out
    "#);
    assert_snapshot!(wave("period = 0\naxes = \"inertia\"\n"), @r#"
    model.toml:12:10: `period` is 0 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:13:8: `axes` cannot be "inertia"
      did you mean "inertial"? write "body" or "inertial"
    "#);
}

#[test]
fn an_orbit_has_one_centre() {
    let orbit =
        |keys: &str| refused("central-gravity", &format!("orbit = {{ semi_major_axis = 1, {keys} }}\n"));
    assert_snapshot!(orbit("body = \"Earth\", gravitational_parameter = 4e14"), @"
    model.toml:11:74: `gravitational_parameter` is that of the `body` already
      leave out one of the two
    ");
    assert_snapshot!(orbit("body = \"earth\""), @r#"
    model.toml:11:39: `body` cannot be "earth"
      did you mean "Earth"? write "Earth", "Moon", "Mars" or "Sun"
    "#);
    assert_snapshot!(orbit("body = \"Pluto\""), @r#"
    model.toml:11:39: `body` cannot be "Pluto"
      write "Earth", "Moon", "Mars" or "Sun"
    "#);
    assert_snapshot!(orbit("gravitational_parameter = -1, inclinaton = 3"), @r#"
    model.toml:11:58: `gravitational_parameter` is -1 m^3/s^2, but must be positive
      write a number in m^3/s^2, or a text with its unit such as "398600.4 km^3/s^2"
    model.toml:11:62: unknown key "inclinaton" in `orbit`
      did you mean `inclination`? the keys are body, gravitational_parameter, semi_major_axis, periapsis_distance, eccentricity, excess_speed, inclination, node, periapsis, mean_anomaly, time_of_periapsis, file, planet_radius, precession
    "#);
    assert_snapshot!(refused("central-gravity", "orbit = 400\n"), @"
    model.toml:11:9: `orbit`: found an integer, expected a table
      write `orbit` with its keys
    ");
}

#[test]
fn a_magnetic_field_is_given_once() {
    let magnet = |lines: &str| refused("magnetic-dipole", &format!("moment = [0, 0, 1]\n{lines}"));
    assert_snapshot!(magnet("field = [0, 0, 1]\ndipole = [0, 0, 1]\n"), @"
    model.toml:13:10: the magnetic field is given by `field` already
      leave out one of the two
    ");
    assert_snapshot!(magnet(&format!("field = [0, 0, 1]\n{ORBIT}")), @"
    model.toml:13:9: `orbit` goes with `dipole`, and this `field` is the same everywhere
      leave out one of the two
    ");
    assert_snapshot!(magnet("dipole = [0, 0, 1]\n"), @r#"
    model.toml:9:1: [[force]] of kind "magnetic-dipole" has no `orbit`
      add a line such as: orbit = { body = "Earth", semi_major_axis = "6778 km", inclination = "51.6 deg" }
    "#);
}

#[test]
fn a_mistake_in_a_formula_is_shown_where_it_stands() {
    let formulas = |force: &str| refused("expression", &format!("on = \"tip\"\nforce = {force}\n"));
    assert_snapshot!(formulas("[\"-0.1*vx\", \"2*foo + t\", 'sin(w*t)']"), @"
    model.toml:12:24: `force`: unknown name `foo`; known are `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `wx`, `wy`, `wz`, `qw`, `qx`, `qy`, `qz`, `pi`, `e`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    model.toml:12:39: `force`: unknown name `w`; known are `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `wx`, `wy`, `wz`, `qw`, `qx`, `qy`, `qz`, `pi`, `e`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    assert_snapshot!(formulas("[\"0\", \"\", \"t +\"]"), @"
    model.toml:12:16: `force`: the formula is empty; write `0` for nothing
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    model.toml:12:23: `force`: the formula is incomplete; a number, a name or `(` is missing after `+`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    assert_snapshot!(formulas("[\"2\\u002a\\u0066oo\", \"\"\"\nx +\n  ω\"\"\", \"3 N\"]"), @"
    model.toml:12:18: `force`: unknown name `foo`; known are `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `wx`, `wy`, `wz`, `qw`, `qx`, `qy`, `qz`, `pi`, `e`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    model.toml:14:3: `force`: unknown name `ω`; known are `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `wx`, `wy`, `wz`, `qw`, `qx`, `qy`, `qz`, `pi`, `e`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    model.toml:14:12: `force`: no sign between `3` and `N`; write `3*N` for a product
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    let force = text("expression", "on = \"carrier\"\nat = [0, 0, 0]\nforce = [0, \"foo\", 0]\n");
    assert_snapshot!(refusal(&format!("\u{feff}{CARRIER}{force}")), @"
    model.toml:9:14: `force`: unknown name `foo`; known are `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `wx`, `wy`, `wz`, `qw`, `qx`, `qy`, `qz`, `pi`, `e`
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    assert_snapshot!(formulas("[0, nan, true]"), @"
    model.toml:12:13: `force` is nan, which is not a finite number
      write a number
    model.toml:12:18: `force`: found true, expected a formula
      write a formula in x y z (m), vx vy vz (m/s), t (s), wx wy wz (rad/s) and qw qx qy qz that gives N, or a number
    ");
    assert_snapshot!(formulas("\"0\""), @"
    model.toml:12:9: `force`: found a text, expected an array of 3 formulas
      write 3 formulas in brackets, with commas between them
    ");
    assert_snapshot!(formulas("[\"t\", \"t\"]"), @"
    model.toml:12:9: `force`: found an array of 2 values, expected an array of 3 formulas
      write 3 formulas in brackets, with commas between them
    ");
}

#[test]
fn a_driven_point_is_read() {
    let support = |lines: &str| {
        read(&format!("{CARRIER}{POINT}[support]\nkind = \"prescribed\"\n{lines}")).assembly.support
    };
    let formula = |text: &str| Expression::parse(text, &["t"]).expect("a formula");
    let acceleration = [formula("0"), formula("9.81"), formula("0.3*cos(2*t)")];
    let driven = support(
        "point = [0, \"10 cm\", 1]\nacceleration = [\"0\", 9.81, \"0.3*cos(2*t)\"]\nvelocity = [0, 0, \"1 km/s\"]\nposition = [1, 2, 3]\n",
    );
    let expected = Support::Prescribed {
        point: [0.0, 0.1, 1.0],
        acceleration: acceleration.clone(),
        velocity: [0.0, 0.0, 1000.0],
        position: [1.0, 2.0, 3.0],
    };
    assert_eq!(driven, expected);
    let driven = support("point = [0, 0, 1]\nacceleration = [\"0\", 9.81, \"0.3*cos(2*t)\"]\n");
    let expected =
        Support::Prescribed { point: [0.0, 0.0, 1.0], acceleration, velocity: [0.0; 3], position: [0.0; 3] };
    assert_eq!(driven, expected);
}

#[test]
fn a_driven_point_says_where_it_is_and_how_it_moves() {
    let support = |lines: &str| refusal_of(&format!("[support]\nkind = \"prescribed\"\n{lines}"));
    assert_snapshot!(support(""), @r#"
    model.toml:9:1: [support] of kind "prescribed" has no `point`
      add a line such as: point = [0.0, 0.0, 0.0]
    model.toml:9:1: [support] of kind "prescribed" has no `acceleration`
      add a line such as: acceleration = ["0", "0", "0.3*cos(2*t)"]
    "#);
    assert_snapshot!(support("point = [0, 0, 1]\nacceleration = [\"0\", \"x\", \"9.81 m/s^2\"]\nvelocity = [0, 0, \"1 m\"]\n"), @r#"
    model.toml:12:23: `acceleration`: unknown name `x`; known are `t`, `pi`, `e`
      write a formula in t (s) that gives m/s^2, or a number
    model.toml:12:33: `acceleration`: no sign between `9.81` and `m`; write `9.81*m` for a product
      write a formula in t (s) that gives m/s^2, or a number
    model.toml:13:19: `velocity`: "1 m" is a length, but a velocity is needed
      write for example "3 km/s", or a plain number in m/s
    "#);
    assert_snapshot!(support("point = [0, 0, inf]\nacceleration = 3\nposition = 0\nmass = 3\n"), @r#"
    model.toml:11:16: `point` is inf, which is not a finite number
      write a number in m, or a text with its unit such as "22 in"
    model.toml:12:16: `acceleration`: found an integer, expected an array of 3 formulas
      write 3 formulas in brackets, with commas between them
    model.toml:13:12: `position`: found an integer, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:14:1: unknown key "mass" in [support] of kind "prescribed"
      the keys are kind, point, acceleration, velocity, position
    "#);
}

#[test]
fn a_body_that_is_not_driven_has_no_motion_of_its_support() {
    assert_snapshot!(refusal_of("[support]\nkind = \"free\"\npoint = [0, 0, 0]\n"), @r#"
    model.toml:11:1: `point` is not a key of [support] of kind "free"
      it is for kind = "fixed-point" or kind = "prescribed"; the keys here are kind
    "#);
    assert_snapshot!(refusal_of("[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\nacceleration = [0, 0, 0]\n"), @r#"
    model.toml:12:1: `acceleration` is not a key of [support] of kind "fixed-point"
      it is for kind = "prescribed"; the keys here are kind, point
    "#);
    assert_snapshot!(refusal_of("[support]\nkind = \"pinned\"\n"), @r#"
    model.toml:10:8: `kind` cannot be "pinned"
      write "free", "fixed-point" or "prescribed"
    "#);
    assert_snapshot!(refusal_of("[support]\npoint = [0, 0, 0]\n"), @r#"
    model.toml:9:1: [support] has no `kind`
      add a line such as: kind = "free", "fixed-point" or "prescribed"
    "#);
    assert_snapshot!(refusal_of("[[support]]\nkind = \"free\"\n"), @"
    model.toml:9:1: there is one [support], not a list of them
      write [support] once, with single brackets
    ");
}
