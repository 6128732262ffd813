//! Eddy currents of a model: `evolve` against `simulate`, spheres, and the limits of the average.

use std::f64::consts::TAU;

use quasirigid_io::model::System;
use quasirigid_math::rotation::angle;
use quasirigid_math::vec3::norm;
use quasirigid_study::Study;

use crate::support::{carrier, close, column, evolved, finished, spinning, study, try_evolve};

const ORBIT: &str = "orbit = { body = \"Earth\", semi_major_axis = \"7069 km\", inclination = \"98 deg\", node = \"40 deg\" }\n";

fn currents(lines: &str) -> String {
    format!("[[force]]\nname = \"currents\"\nkind = \"eddy-current\"\n{lines}")
}

/// A satellite with a magnetic tensor in the turning tilted dipole of the Earth.
fn satellite(inertia: [f64; 3], tensor: &str, omega: [f64; 3]) -> String {
    let field = format!("dipole = [1.2e15, 0.8e15, -7.6e15]\ndipole_rate = \"7.2921159e-5 rad/s\"\n{ORBIT}");
    carrier(20.0, inertia) + &spinning(omega) + &currents(&format!("tensor = {tensor}\n{field}"))
}

/// A thousand revolutions and more of a wobbling body with three different moments and a tensor of its own, by the reduced and the full system and by
/// the average: magnitude and direction of the angular momentum, and energy. The tensor is twenty times that of a shell of aluminium, so
/// that much happens in eight orbits.
#[test]
fn evolve_is_the_mean_of_simulate() {
    let tensor = "[[1500, 150, 0], [150, 1200, -350], [0, -350, 2000]]";
    let model = satellite([0.6, 0.8, 1.0], tensor, [0.03, 0.02, 0.2]);
    let study = study(&model);
    let period = TAU * (7.069e6f64.powi(3) / 3.986_004_418e14).sqrt();
    let duration = 8.0 * period;
    let found = evolved(&study, |asked| asked.duration = Some(duration));
    assert_eq!(found.record.status, "finished", "{}", found.record.message);
    let momentum = *column(&found.record.columns, "momentum").last().unwrap();
    let energy = *column(&found.record.columns, "energy").last().unwrap();
    let note = found.notes.iter().find(|note| note.contains("turn the angular momentum")).unwrap();
    for system in [System::Reduced, System::Full] {
        let run = finished(&study, system, &[0.0, duration]);
        let last = &run.run.last;
        println!(
            "{system:?}: {:.0} revolutions, |K| {:.5} from {:.5}, averaged {momentum:.5}; E {:.6}, averaged {energy:.6}; {note}",
            found.record.revolutions,
            norm(last.angular_momentum),
            found.record.angular_momentum,
            last.energy
        );
        close(norm(last.angular_momentum), momentum, 1e-3);
        close(last.energy, energy, 2e-3);
    }
}

/// A sphere in a uniform field across its spin slows by `e^{−MB²t/I}`, by `evolve` and by `simulate`; its energy is what the force took.
#[test]
fn a_sphere_slows_by_its_closed_law() {
    let shape =
        "conductivity = \"58 MS/m\"\nshape = \"sphere\"\nradius = \"10 cm\"\nfield = [\"1 mT\", 0, 0]\n";
    let sphere = study(&(carrier(37.5, [0.15; 3]) + &spinning([0.0, 0.0, 2.0]) + &currents(shape)));
    let tau = 0.15 / (242.949_831 * 1e-6);
    let found = evolved(&sphere, |asked| asked.duration = Some(1.5 * tau)).record;
    close(*column(&found.columns, "momentum").last().unwrap(), 0.3 * (-1.5f64).exp(), 1e-7);
    assert_eq!(*column(&found.columns, "nutation_max").last().unwrap(), 0.0);
    for system in [System::Reduced, System::Full, System::Rigid] {
        let history = finished(&sphere, system, &[0.0, 1.5 * tau]);
        let last = &history.run.last;
        close(last.angular_momentum[2], 0.3 * (-1.5f64).exp(), 1e-7);
        close(last.work, 0.5 * 0.15 * 4.0 * ((-3f64).exp() - 1.0), 1e-7);
    }
    let along = study(&(carrier(37.5, [0.15; 3]) + &spinning([2.0, 0.0, 0.0]) + &currents(shape)));
    let kept = evolved(&along, |asked| asked.duration = Some(1.5 * tau)).record;
    close(*column(&kept.columns, "momentum").last().unwrap(), 0.3, 1e-12);
    assert!(
        angle(finished(&along, System::Rigid, &[0.0, tau]).run.last.angular_momentum, [1.0, 0.0, 0.0]) < 1e-9
    );
}

/// A ball slows to the rate at which the field turns along its orbit, in `evolve` and in `simulate`, and not to rest: 1.8 times the orbital rate
/// on a polar orbit about an axial dipole, (A15).
#[test]
fn a_ball_comes_to_the_rate_of_the_turning_field() {
    let orbit = "orbit = { body = \"Earth\", semi_major_axis = \"7069 km\", inclination = \"90 deg\" }\n";
    let n = TAU / (TAU * (7.069e6f64.powi(3) / 3.986_004_418e14).sqrt());
    let ball = |tensor: &str, spin: [f64; 3]| {
        let force = currents(&format!("tensor = {tensor}\ndipole = [0, 0, -7.6e15]\n{orbit}"));
        study(&(carrier(20.0, [0.6; 3]) + &spinning(spin) + &force))
    };
    let (spin, tensor) = ([0.0, -6.0 * n, 2.0 * n], "3e4");
    let body = ball(tensor, spin);
    let slowest = 3e4 * (7.6e15 / 7.069e6f64.powi(3)).powi(2) * 1.375 / 0.6;
    let duration = 10.0 / slowest;
    let found = evolved(&body, |asked| asked.duration = Some(duration));
    assert_eq!(found.record.status, "finished", "{}", found.record.message);
    close(*column(&found.record.columns, "momentum").last().unwrap(), 0.6 * 1.8 * n, 1e-4);
    let last = finished(&body, System::Rigid, &[0.0, duration]).run.last;
    println!("{:?} beside {}", last.angular_momentum, 0.6 * 1.8 * n);
    // the torque changes the spin by a few hundredths in an orbit
    close(norm(last.angular_momentum), 0.6 * 1.8 * n, 0.03);
}

/// An orbit that keeps its node about the Earth is told so, unless it does precess: then the mean follows `simulate`, too.
#[test]
fn the_node_precesses_where_it_is_asked_to() {
    let model = satellite([0.6, 0.8, 1.0], "1", [0.0, 0.0, 1.0]);
    let notes = |model: &str, days: f64| {
        evolved(&study(model), |asked| asked.duration = Some(86_400.0 * days)).notes.join(" ")
    };
    let precessing = model.replace("node =", "precession = \"J2\", node =");
    let told = notes(&model, 100.0);
    // (F20): 3/2 n J2 (R/a)² cos i
    let n = (3.986_004_418e14 / 7.069e6f64.powi(3)).sqrt();
    let rate = 1.5 * n * 1.082_635_5e-3 * (6.378_136_3 / 7.069f64).powi(2) * -98f64.to_radians().cos();
    let daily =
        format!("would move the node of the orbit by {:.3} degrees a day", (86_400.0 * rate).to_degrees());
    assert!(told.contains(&daily), "{daily}: {told}");
    assert!(!notes(&model, 5.0).contains("the node of the orbit"));
    assert!(!notes(&precessing, 100.0).contains("the node of the orbit"));

    let tensor = "[[1500, 150, 0], [150, 1200, -350], [0, -350, 2000]]";
    let rates = "precession = { node = \"8 deg/h\", periapsis = \"-3 deg/h\" }, eccentricity = 0.02, node =";
    let model = satellite([0.6, 0.8, 1.0], tensor, [0.03, 0.02, 0.2]).replace("node =", rates);
    let study = study(&model);
    let duration = 8.0 * 5915.0;
    let found = evolved(&study, |asked| asked.duration = Some(duration));
    let momentum = *column(&found.record.columns, "momentum").last().unwrap();
    let last = finished(&study, System::Rigid, &[0.0, duration]).run.last;
    close(norm(last.angular_momentum), momentum, 2e-3);
}

/// The main field of the Earth: `evolve` is the mean of `simulate`, and not that of its dipole alone.
#[test]
fn evolve_is_the_mean_of_simulate_in_the_main_field() {
    let tensor = "[[1500, 150, 0], [150, 1200, -350], [0, -350, 2000]]";
    let with = |field: &str| {
        let orbit = ORBIT.replace("98 deg", "40 deg"); // where the dipole alone is furthest off
        let force = currents(&format!("tensor = {tensor}\n{field}\n{orbit}"));
        study(&(carrier(20.0, [0.6, 0.8, 1.0]) + &spinning([0.03, 0.02, 0.2]) + &force))
    };
    let duration = 8.0 * 5915.0;
    let averaged = |body: &Study| {
        let found = evolved(body, |asked| asked.duration = Some(duration));
        assert_eq!(found.record.status, "finished", "{}", found.record.message);
        *column(&found.record.columns, "momentum").last().unwrap()
    };
    let full = with("igrf = { epoch = \"2024-03-01T12:00:00\", degree = 4 }");
    let momentum = averaged(&full);
    let last = finished(&full, System::Rigid, &[0.0, duration]).run.last;
    let dipole = averaged(&with("igrf = { epoch = \"2024-03-01T12:00:00\", degree = 1 }"));
    println!("{} averaged {momentum}, of the dipole {dipole}", norm(last.angular_momentum));
    close(norm(last.angular_momentum), momentum, 2e-3);
    assert!((momentum / dipole - 1.0).abs() > 2e-3, "{momentum} {dipole}");
}

/// What the average does not hold for is refused in words, with numbers.
#[test]
fn averages_that_do_not_hold_are_refused() {
    let refused = |model: &str| try_evolve(&study(model), |asked| asked.duration = Some(1e6)).unwrap_err();
    let spin = [0.0, 0.0, 1.0];
    let strong = refused(&satellite([0.6, 0.8, 1.0], "1e7", spin));
    assert!(
        strong.contains("an average needs that to be a tenth of 7.29e-5 rad/s at most, the slowest rate"),
        "{strong}"
    );
    let resonant = satellite([0.6, 0.8, 1.0], "100", spin).replace("7069 km", "42164.17 km");
    assert!(refused(&resonant).contains("slow in a resonance"));
    let sphere = refused(&satellite([1.0; 3], "[[1, 0, 0], [0, 1, 0], [0, 0, 2]]", spin));
    assert!(sphere.contains("its spin has no axis of its own"), "{sphere}");
    let uniform = |tensor: &str| currents(&format!("tensor = {tensor}\nfield = [0, 1, 0]\n"));
    let body = carrier(20.0, [0.6, 0.8, 1.0]) + &spinning(spin);
    let sudden = refused(&(body.clone() + &uniform("10")));
    assert!(sudden.contains("the angular velocity of the body; `simulate`"), "{sudden}");
    let shape = "conductivity = 5e7\nshape = \"sphere\"\nradius = 0.5\nfield = [0, 0, 1e-5]\n";
    let skin = refused(&(carrier(20.0, [0.6, 0.8, 1.0]) + &spinning([0.0, 0.0, 9.0]) + &currents(shape)));
    assert!(skin.contains("the currents' own field lowers the torque by"), "{skin}");
}

/// Nothing where there is no field or no metal; an end in words where the body has become too slow.
#[test]
fn limits_of_eddy_currents_are_ends() {
    let status = |model: &str, duration: f64| {
        let found = evolved(&study(model), |asked| asked.duration = Some(duration)).record;
        (found.status.clone(), *column(&found.columns, "momentum").last().unwrap(), found.message)
    };
    let (slowed, momentum, message) = status(&satellite([0.6, 0.8, 1.0], "300", [0.0, 0.0, 0.1]), 1e10);
    assert_eq!(slowed, "slowed", "{message}");
    assert!(momentum > 0.0 && message.contains("`simulate` follows the rotation"), "{momentum} {message}");
    let (rest, momentum, _) = status(&satellite([0.6, 0.8, 1.0], "300", [0.0, 0.0, 1e-3]), 1e5);
    assert_eq!(rest, "slowed");
    close(momentum, 1e-3, 1e-12);
}
