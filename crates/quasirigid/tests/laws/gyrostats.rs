//! Steady spins of bodies with momentum wheels, their nutation and the wobble about them, against closed forms of the rigid gyrostat.

use quasirigid::elements::{Assembly, Wheel, WheelSpeed};
use quasirigid::model::FlexibleBody;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes, frozen_spins};
use quasirigid::secular::{GyrostatSpins, GyrostatWobble};
use quasirigid_math::random::Random;
use quasirigid_math::sphere::StationaryKind;
use quasirigid_math::vec3::{add, cross, dot, norm, scale, unit};

use crate::support::parts;
use crate::support::rotors::flywheel;
use crate::support::sprung_body;

const MOMENTS: [f64; 3] = [10.0, 14.0, 18.0];

/// Carrier of these moments with a wheel of an axis and an angular momentum (N·m·s), and a damper wheel that is next to nothing.
fn gyrostat(axis: [f64; 3], angular_momentum: f64) -> FlexibleBody {
    let [a, b, c] = MOMENTS;
    let inertia = parts::diag([a, b, c]);
    let carrier = parts::carrier(100.0, [0.0; 3], inertia);
    let speed = WheelSpeed::Constant { angular_momentum };
    let wheels = vec![Wheel { name: "wheel".into(), axis, speed }];
    let rotors = vec![flywheel([1.0, 1.0, 1.0], 1e-6, 1e-6)];
    Assembly { wheels, rotors, ..sprung_body(carrier, &[]) }.body().unwrap()
}

/// Every spin turns about its angular momentum, and extrema outnumber saddles by two, whatever the wheel.
#[test]
fn steady_spins_of_a_gyrostat_are_all_found() {
    for (axis, wheel) in
        [([1.0, 0.3, 0.5], 1.0), ([1.0, 0.3, 0.5], 20.0), ([-0.2, 2.0, 0.7], 5.0), ([0.3, -0.4, 1.0], 50.0)]
    {
        let found = GyrostatSpins::compute(&gyrostat(axis, wheel), 15.0);
        let all: Vec<_> = [&found.minima, &found.saddles, &found.maxima].into_iter().flatten().collect();
        for spin in &all {
            let sine = norm(cross(spin.angular_momentum, spin.omega)) / (15.0 * norm(spin.omega));
            assert!(sine < 1e-9 && (norm(spin.angular_momentum) / 15.0 - 1.0).abs() < 1e-9, "{spin:?}");
        }
        assert_eq!(found.minima.len() + found.maxima.len(), 2 + found.saddles.len(), "{wheel}");
        let least = all.iter().map(|spin| spin.energy).fold(f64::INFINITY, f64::min);
        assert!(found.minima.iter().any(|spin| spin.energy <= least));
    }
}

/// A wheel along the axis of middle inertia makes that spin the one of least energy: the nutation has the frequency
/// `|K| [(1/I₁ − ω/K)(1/I₃ − ω/K)]^½`, and a small wobble the energy of the second variation.
#[test]
fn nutation_of_a_gyrostat_has_its_closed_form() {
    let (G, wheel) = (25.0, 20.0);
    let body = gyrostat([0.0, 1.0, 0.0], wheel);
    let found = GyrostatSpins::compute(&body, G);
    let spin = found.attracting([0.0, 1.0, 0.0]).unwrap().clone();
    let rate = (G - wheel) / MOMENTS[1];
    assert!((spin.omega[1] - rate).abs() < 1e-6 * rate, "{:?}", spin.omega);
    let across = |moment: f64| moment.recip() - rate / G;
    let expected = G * (across(MOMENTS[0]) * across(MOMENTS[2])).sqrt();
    let modes = SpinModes::about(&body, spin.clone()).unwrap();
    let nutation = modes.nutation().unwrap();
    assert!((nutation.frequency / expected - 1.0).abs() < 1e-5, "{} {expected}", nutation.frequency);
    assert!(modes.stable() && nutation.decay_rate > 0.0);
    let wobble = GyrostatWobble::about(&body, &spin);
    let angle = 1e-3;
    let above = wobble.energy_of(angle) - spin.energy;
    let second = 0.5 * (G * angle).powi(2) * across(MOMENTS[2]);
    assert!((above / second - 1.0).abs() < 1e-4, "{above:e} {second:e}");
    let [least, greatest] = wobble.nutation(spin.energy + above);
    assert!((greatest / angle - 1.0).abs() < 1e-6, "{greatest}");
    let ratio = (across(MOMENTS[2]) / across(MOMENTS[0])).sqrt();
    assert!((least / greatest / ratio - 1.0).abs() < 1e-4, "{least}");
    let unstable = scale(-1.0, spin.omega);
    assert!(found.maxima.iter().chain(&found.saddles).any(|spin| norm(cross(spin.omega, unstable)) < 1e-9));
}

/// At a rate and at an angular momentum every steady spin of the rigid gyrostat is found, each with its sense: those at the rate are steady at
/// the angular momentum that they have, and the one beside a direction is the nearest of all. (M27)
#[test]
fn the_steady_spin_beside_a_direction_is_the_nearest_of_all() {
    let mut random = Random::new(7);
    for _ in 0..40 {
        let axis = [0; 3].map(|_| random.unit() - 0.5);
        let body = gyrostat(axis, 40.0 * random.unit());
        let given = SpinMagnitude::Rate(1.0 + random.unit());
        let spins = frozen_spins(&body, given);
        let saddles = spins.iter().filter(|spin| spin.kind == StationaryKind::Saddle).count();
        assert_eq!(spins.len(), 2 + 2 * saddles);
        for spin in &spins {
            let G = norm(spin.angular_momentum);
            let same = frozen_spins(&body, SpinMagnitude::AngularMomentum(G));
            let apart = |other: &[f64; 3]| norm(add(*other, scale(-1.0, spin.omega)));
            assert!(same.iter().any(|other| apart(&other.omega) < 1e-9 * norm(spin.omega)), "{spin:?}");
        }
        let direction = [0; 3].map(|_| random.unit() - 0.5);
        let along = |omega: [f64; 3]| dot(unit(omega), unit(direction));
        let nearest = spins.iter().map(|spin| along(spin.omega)).fold(-1.0, f64::max);
        let found = RelativeEquilibrium::beside(&body, direction, given).unwrap();
        assert!((along(found.omega) - nearest).abs() < 1e-9, "{axis:?} {direction:?}");
    }
}
