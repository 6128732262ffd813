//! Controllers in the orbital frame: a body that points down, against its planar equation; laws by channels and by formulas; what is refused.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::Path;

use quasirigid_io::model::System;
use quasirigid_study::Study;

use crate::support::{carrier, close, column, finished, point, study};

const MU: f64 = 3.986_004_418e14;
const A: f64 = 7e6;
const MOMENTS: [f64; 3] = [30.0, 40.0, 20.0];
const GAIN: f64 = 2e-4;
const BRAKE: f64 = 0.05;

fn orbit(eccentricity: f64) -> String {
    format!("orbit = {{ body = \"Earth\", semi_major_axis = {A}, eccentricity = {eccentricity} }}\n")
}

fn gravity(eccentricity: f64) -> String {
    format!("[[force]]\nkind = \"central-gravity\"\n{}", orbit(eccentricity))
}

fn start(attitude: [f64; 4], omega: [f64; 3]) -> String {
    format!("[initial]\nangular_velocity = {omega:?}\nattitude = {attitude:?}\n")
}

/// Attitude of a body aligned with the orbital frame at the periapsis, turned by an angle about its second axis, which it pitches about.
fn pitched(angle: f64) -> [f64; 4] {
    let (s, c) = (0.5 * angle).sin_cos();
    // the frame has x along the inertial y, y down the inertial z, z down the inertial x
    let [w, x, y, z] = [0.5, -0.5, -0.5, 0.5];
    [w * c - y * s, x * c - z * s, w * s + y * c, x * s + z * c]
}

fn pd(on: &str) -> String {
    format!(
        "[[controller]]\nname = \"down\"\nkind = \"pid\"\n{on}proportional = {GAIN}\nderivative = {BRAKE}\n"
    )
}

/// A rigid body pitches by its planar equation under gravity and the law, `J2 θ̈ = −(3/2) n² (J1 − J3) sin 2θ − kP θ − kD θ̇`.
#[test]
fn a_body_that_points_down_follows_its_planar_equation() {
    let n = (MU / A).sqrt() / A;
    let [from, duration] = [0.3, 2500.0];
    let model = carrier(50.0, MOMENTS)
        + &start(pitched(from), [0.0, -n, 0.0])
        + &gravity(0.0)
        + &pd("on = \"orbit\"\n");
    let rate = |[angle, rate]: [f64; 2]| {
        let gravity = -1.5 * n * n * (MOMENTS[0] - MOMENTS[2]) * (2.0 * angle).sin();
        [rate, (gravity - GAIN * angle - BRAKE * rate) / MOMENTS[1]]
    };
    let steps = 20_000;
    let h = duration / f64::from(steps);
    let mut y = [from, 0.0];
    for _ in 0..steps {
        let moved = |k: [f64; 2], share: f64| [y[0] + share * h * k[0], y[1] + share * h * k[1]];
        let a = rate(y);
        let b = rate(moved(a, 0.5));
        let c = rate(moved(b, 0.5));
        let d = rate(moved(c, 1.0));
        y = [0, 1].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    assert!(y[0].abs() > 1e-3 && (y[0] / from).abs() < 0.9, "{y:?}");
    for system in [System::Rigid, System::Full] {
        let history = finished(&study(&model), system, &[0.0, duration]);
        let last = history.run.last;
        let [w, x, q, z] = last.attitude;
        let ahead = [1.0 - 2.0 * (q * q + z * z), 2.0 * (x * q + w * z)];
        let pitch = (n * duration + FRAC_PI_2 - ahead[1].atan2(ahead[0])).rem_euclid(TAU);
        let pitch = if pitch > 3.0 { pitch - TAU } else { pitch };
        println!("{system:?}: {pitch} beside {}", y[0]);
        assert!((pitch - y[0]).abs() < 1e-9, "{pitch} {y:?}");
        assert!((last.omega[1] + n - y[1]).abs() < 1e-9 * n, "{:?} {y:?}", last.omega);
        assert!(last.omega[0].abs() + last.omega[2].abs() < 1e-12 * n);
        let torque = -GAIN * y[0] - BRAKE * y[1];
        close(*column(&history.columns, "down.torque.y").last().unwrap(), torque, 1e-8);
    }
}

/// On an ellipse, with a mass on a spring and three axes in motion: a law by formulas in the channels is the law on the orbit.
#[test]
fn formulas_in_the_channels_are_the_law_on_the_orbit() {
    let body = carrier(50.0, MOMENTS)
        + &point("tip", 0.5, [0.8, 0.3, 0.4], [3.0, 0.3])
        + &start(pitched(0.2), [2e-4, -1.3e-3, 1e-4])
        + &gravity(0.05);
    let term = |axis: &str| format!("\"-{GAIN}*a{axis} - {BRAKE}*r{axis}\"");
    let channels = ["x", "y", "z"]
        .map(|axis| format!("a{axis} = \"orbit.{axis}\", r{axis} = \"orbit_rate.{axis}\""))
        .join(", ");
    let formulas = format!(
        "[[controller]]\nkind = \"formula\"\ninputs = {{ {channels} }}\ntorque = [{}]\n",
        ["x", "y", "z"].map(term).join(", ")
    );
    let end = |law: &str| finished(&study(&(body.clone() + law)), System::Full, &[0.0, 3000.0]).run.last;
    let (law, written) = (end(&pd("on = \"orbit\"\n")), end(&formulas));
    for axis in 0..3 {
        close(law.omega[axis], written.omega[axis], 1e-9);
    }
    let free = end("").omega;
    assert!((free[0] / law.omega[0] - 1.0).abs() > 0.1, "{free:?} {:?}", law.omega);
}

/// Without an orbit, with two that differ, with a target of its own, about a linear model: words that say what to do.
#[test]
fn what_the_orbit_is_not_known_for_is_refused() {
    let body = carrier(50.0, MOMENTS) + &start(pitched(0.2), [0.0, -1e-3, 0.0]);
    let refused = |model: &str| {
        let read = Study::read_from(Path::new("model.toml"), model.as_bytes(), None);
        read.err().unwrap().to_string()
    };
    let none = refused(&(body.clone() + &pd("on = \"orbit\"\n")));
    assert!(none.contains("it measures relative to an orbit, and the model has none"), "{none}");
    let two = body.clone()
        + &gravity(0.0)
        + &gravity(0.05)
        + &pd("on = \"nadir.x\"\noutputs = [\"torque.y\"]\nfilter = \"1 s\"\n");
    assert!(refused(&two).contains("the model has 2 that differ"), "{}", refused(&two));
    let aimed = refused(&(body.clone() + &gravity(0.0) + &pd("on = \"orbit\"\ntarget = [1, 0, 0, 0]\n")));
    assert!(aimed.contains("the orbital frame is the target of this law"), "{aimed}");
    let sun = refused(&(body + &pd("on = \"sun.x\"\noutputs = [\"torque.y\"]\nfilter = \"1 s\"\n")));
    assert!(sun.contains("it senses the Sun, and the model has none"), "{sun}");
}
