//! Bodies so soft that their spin turns its own axis: steady spins with momentum wheels, and wobbles about the axis of the deformed body.
//! Equations (M1), (Q8), (Q15), docs/theory/15-modes.md and 16-methods.md.

use quasirigid_io::model::System;
use quasirigid_math::rotation::{Turn, to_inertial};
use quasirigid_math::vec3::{dot, norm, unit};
use quasirigid_study::modes::PrincipalAxis;

use crate::support::{column, evolve, finished, modes, modes_about, study};

/// Two soft points and a wheel with as much angular momentum as the body, which spins about its middle axis.
const GYROSTAT: &str = r#"
carrier = { mass = 73.939, center_of_mass = [-0.0146, -0.0043, -0.0144], inertia = [8.23439225, 7.61061461, 5.28556938] }
point = [
  { name = "soft", mass = 1.6511, position = [-0.6904, -0.6881, -0.4973] },
  { name = "softer", mass = 0.56795, position = [-0.5925, 0.554, 0.5421] },
]
spring = [
  { from = "soft", to = "carrier", stiffness = [2.1374, 2.621, 5.7743], damping = [0.26633, 0.1788, 0.11706] },
  { from = "softer", to = "carrier", stiffness = [15.208, 6.2226, 8.2142], damping = [0.14477, 0.15166, 0.42063] },
]
wheel = [{ name = "bias", axis = [0.3639, -0.0264, 0.9311], momentum = 10.198 }]
initial = { angular_velocity = [0.036958, 1.5166, 0.036958] }
"#;

/// A prolate carrier with rotors and a point, so soft that its wobble goes another way than that of the frozen body.
const TURNED_OVER: &str = r#"
carrier = { mass = 208.31, center_of_mass = [0.0014, -0.0184, 0.0124], inertia = [39.5271081, 13.3384815, 42.6803321] }
rotor = [
  { name = "rotor0", axis = [-0.6521, -0.1086, 0.7503], inertia = 0.86429, friction = 0.089368 },
  { name = "rotor1", axis = [0.7224, 0.5904, 0.36], inertia = 0.16887, friction = 0.015896 },
]
point = [{ name = "soft", mass = 1.1899, position = [-0.9486, 0.9692, -0.3793] }]
spring = [{ from = "soft", to = "carrier", stiffness = [1.8434, 2.72, 2.6747], damping = [0.22671, 0.10788, 0.69619] }]
wheel = [{ name = "bias", axis = [-0.8894, 0.1204, 0.4409], momentum = 1.0959 }]
initial = { wobble = { angle = "4.684 deg", rate = 0.92998, mode = "short-axis" } }
"#;

/// Angular velocity (rad/s) in which the full system ends.
fn end_of(model: &str, duration: f64) -> [f64; 3] {
    finished(&study(model), System::Full, &[0.0, duration]).run.last.omega
}

/// Relative difference of two vectors.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(std::array::from_fn(|i| a[i] - b[i])) / norm(b)
}

#[test]
fn the_steady_spin_of_a_soft_gyrostat_is_where_the_full_system_comes_to_rest() {
    let found = &modes(&study(GYROSTAT)).spins[0];
    let settled = end_of(GYROSTAT, 600.0);
    assert!(found.stable && apart(found.spin.unwrap(), settled) < 1e-6, "{:?} {settled:?}", found.spin);
    assert_eq!(evolve(GYROSTAT).status, "finished");
}

#[test]
fn a_wobble_that_soft_parts_lead_to_another_spin_ends_there() {
    let found = evolve(TURNED_OVER);
    assert_eq!(found.status, "finished", "{}", found.message);
    let settled = end_of(TURNED_OVER, 3000.0);
    let momentum = finished(&study(TURNED_OVER), System::Full, &[0.0, 1.0]).run.last.angular_momentum;
    assert!((found.angular_momentum / norm(momentum) - 1.0).abs() < 1e-9);
    assert!(found.sentence.contains("steady spin") && settled[2] < 0.0, "{} {settled:?}", found.sentence);
    let stays = finished(&study(TURNED_OVER), System::Full, &[0.0, found.time]).run.last;
    let close = dot(unit(stays.omega), unit(settled)).acos();
    assert!(close < 0.05, "{close} rad from the steady spin at the end");
}

/// A soft point off the principal axes, whose load tilts the axis of the steady spin by more than the wobble.
fn tilted(angle: f64) -> String {
    format!(
        r#"
carrier = {{ mass = 18.673, center_of_mass = [0.0088, -0.0043, -0.0072], inertia = [0.463167759, 0.709694015, 0.805759331] }}
point = [{{ name = "soft", mass = 0.12557, position = [-0.358, -0.1613, -0.2846] }}]
spring = [{{ from = "soft", to = "carrier", stiffness = [4.0, 5.8, 2.6], damping = [0.023, 0.0086, 0.09] }}]
initial = {{ wobble = {{ angle = {angle}, rate = 2.3549, mode = "short-axis" }} }}
"#
    )
}

#[test]
fn a_wobble_is_of_the_angle_given_about_the_axis_of_the_deformed_body() {
    for angle in [0.03_f64, 0.12] {
        let study = study(&tilted(angle));
        let spin = &modes_about(&study, PrincipalAxis::Greatest).spins[0];
        let nutation = spin.modes.iter().find(|mode| mode.name == "nutation").unwrap();
        let period = std::f64::consts::TAU / nutation.frequency;
        let times: Vec<f64> = (0..=200).map(|i| period * f64::from(i) / 200.0).collect();
        let history = finished(&study, System::Full, &times);
        let axis = unit(spin.angular_momentum.unwrap());
        let last = history.run.last;
        let fixed = to_inertial(last.attitude, unit(last.angular_momentum));
        let attitude = |row: usize| ["qw", "qx", "qy", "qz"].map(|name| column(&history.columns, name)[row]);
        let tilts =
            (0..times.len()).map(|row| dot(Turn::of(attitude(row)).to_body(fixed), axis).abs().acos());
        let greatest = tilts.fold(0.0, f64::max);
        assert!((greatest / angle - 1.0).abs() < 0.04, "{greatest} rad, {angle} given");
        let told = evolve(&tilted(angle)).start.unwrap().nutation_greatest;
        assert!((told / angle - 1.0).abs() < 0.06, "{told} rad told, {angle} given");
    }
}
