//! Energy range at an angular momentum, and rates at its poles. (Q1)–(Q3)

use quasirigid::averaging::RotationState;
use quasirigid::elements::{Assembly, Carrier, Point, Spring};
use quasirigid::model::Mode;
use quasirigid::prelude::CARRIER;
use quasirigid::secular::{EnergyRange, Poles};

use crate::support::parts;
use crate::support::sprung_body;

/// The state of the full system near a rotation state has that rotation state once its vibrations have died out.
#[test]
fn a_state_without_vibrations_settles_where_it_is() {
    let carrier = Carrier::principal(40.0, [9.0, 13.0, 16.0]);
    let mass = parts::sprung(1.5, [0.8, 0.3, 0.5], [60.0, 90.0, 70.0], [3.0, 2.0, 4.0]);
    let body = sprung_body(carrier, &[mass]).body().unwrap();
    let range = EnergyRange::compute(&body, 8.0).unwrap();
    for (mode, xi) in [(Mode::ShortAxis, 3.0), (Mode::ShortAxis, 1.0), (Mode::LongAxis, 2.0)] {
        let state = range.state(&body, RotationState { mode, xi }).unwrap();
        let settled = range.settled(&body, state.angular_momentum(&body)).unwrap();
        assert_eq!(settled.mode, mode);
        assert!((settled.xi - xi).abs() < 1e-9, "{settled:?}, not {xi}");
    }
}

/// A mass in a slot along the axis of spin of a carrier a million times heavier is an oscillator of its own, and the carrier nutates as a
/// rigid body: `λ = −ζω₀ + iω₀√(1 − ζ²)`, and Euler's frequency.
#[test]
fn a_light_mass_follows_the_nutation_at_the_distance_of_its_eigenvalue() {
    let (mass, stiffness, ratio, spin) = (1.0_f64, 4.0_f64, 0.3, 0.1);
    let [A, B, C] = [10.0, 12.0, 16.0];
    let mut assembly =
        Assembly::default().with(Carrier::principal(1e6, [A, B, C].map(|moment| 1e6 * moment)));
    let damper = assembly.add(Point::new("damper", mass, [0.4, 0.0, 0.2]).along([0.0, 0.0, 1.0]));
    let damping = 2.0 * ratio * (mass * stiffness).sqrt();
    assembly.add(Spring::isotropic(stiffness, damping).between(damper, CARRIER));
    let body = assembly.body().unwrap();
    let range = EnergyRange::compute(&body, 1e6 * C * spin).unwrap();
    let poles = Poles::compute(&body, &range).unwrap();
    let natural = (stiffness / mass).sqrt();
    let nutation = spin * ((C - A) * (C - B) / (A * B)).sqrt();
    let expected = (ratio * natural).hypot(natural * (1.0 - ratio * ratio).sqrt() - nutation);
    let found = poles.short.as_ref().unwrap();
    assert!((found.following_rate() / expected - 1.0).abs() < 1e-4, "{} {expected}", found.following_rate());
    assert!((found.settling_rate() / (ratio * natural) - 1.0).abs() < 1e-4, "{}", found.settling_rate());
}
