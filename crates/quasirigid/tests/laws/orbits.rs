//! Orbits against their equation, `R̈ = −μ₀ R/r³`, and its integrals. (F10)

use nalgebra::Vector3;
use proptest::prelude::*;
use quasirigid::model::force::{Oblateness, Orbit, OrbitPoint};
use quasirigid_math::scalar::Smooth;
use quasirigid_math::taylor::Taylor;

use super::forced::orbit;
use crate::support::cases;

type V = Vector3<f64>;

fn at(orbit: &Orbit, t: f64) -> (V, V) {
    let OrbitPoint { place, velocity, .. } = orbit.at(t);
    (place.into(), velocity.into())
}

/// Orbits of every size and eccentricity, with the largest first power of rounding that they suffer: the equation for
/// the anomaly loses digits where the orbit is nearly a line.
fn orbits() -> impl Strategy<Value = (Orbit, f64)> {
    (orbit(), 0.0..6.0, -9.0..9.0, -9.0..9.0).prop_map(
        |(orbit, narrow, length, time): (Orbit, f64, f64, f64)| {
            let flatness = 10f64.powf(-narrow);
            let (length, time) = (10f64.powf(length), 10f64.powf(time));
            let orbit = Orbit {
                eccentricity: 1.0 - flatness,
                semi_major_axis: orbit.semi_major_axis * length,
                mu: orbit.mu * length.powi(3) / time.powi(2),
                ..orbit
            };
            (orbit, 1e-14 / flatness)
        },
    )
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn energy_momentum_and_shape_are_constant_along_an_orbit(
        (orbit, rounding) in orbits(), phase in -20.0..20.0
    ) {
        let Orbit { mu, semi_major_axis: a, eccentricity: e, .. } = orbit;
        let (R, velocity) = at(&orbit, phase * orbit.period());
        let r = R.norm();
        let radius: f64 = orbit.at(phase * orbit.period()).radius;
        prop_assert!((radius / r - 1.0).abs() < rounding);
        let energy = 0.5 * velocity.norm_squared() - mu / r;
        prop_assert!((energy + 0.5 * mu / a).abs() < rounding * (mu / r), "{energy:e}");
        let angular_momentum = R.cross(&velocity);
        let (si, ci) = orbit.inclination.sin_cos();
        let (sn, cn) = orbit.raan.sin_cos();
        let normal = V::new(si * sn, -si * cn, ci);
        let size = (mu * a * (1.0 - e) * (1.0 + e)).sqrt();
        prop_assert!((angular_momentum / size - normal).norm() < rounding, "{angular_momentum:?}");
        // Laplace's vector points to the periapsis, which is the angle from the node.
        let laplace = velocity.cross(&angular_momentum) / mu - R / r;
        let node = V::new(cn, sn, 0.0);
        let (sp, cp) = orbit.argument_of_periapsis.sin_cos();
        prop_assert!((laplace - e * (cp * node + sp * normal.cross(&node))).norm() < rounding);
    }

    /// A precessing orbit is the orbit itself, turned about the pole and in its plane, and its velocity the derivative of its place.
    #[test]
    fn a_precessing_orbit_is_the_orbit_turned(orbit in orbit(), node in -0.3..0.3, periapsis in -0.3..0.3, phase in -3.0..3.0) {
        let n = orbit.mean_motion();
        let precessing = Orbit { node_rate: node * n, periapsis_rate: periapsis * n, ..orbit };
        let t = phase / n;
        let there = precessing.precessed(t);
        let still = Orbit { node_rate: 0.0, periapsis_rate: 0.0, ..there };
        let (R, velocity) = at(&precessing, t);
        let (turned, within) = at(&still, t);
        prop_assert!((R - turned).norm() < 1e-13 * R.norm());
        let normal = turned.cross(&within).normalize();
        let turning: V = node * n * V::z() + periapsis * n * normal;
        let extra = turning.cross(&R);
        prop_assert!((velocity - within - extra).norm() < 1e-12 * velocity.norm());
        // a thousandth of the time of passage at the periapsis: differences of fourth order, and few digits lost
        let apart = 1e-3 * (1.0 - orbit.eccentricity).powf(1.5) / n;
        let place = |steps: f64| at(&precessing, t + steps * apart).0;
        let slope = (8.0 * (place(1.0) - place(-1.0)) - (place(2.0) - place(-2.0))) / (12.0 * apart);
        prop_assert!((velocity - slope).norm() < 1e-9 * velocity.norm());
    }

    #[test]
    fn the_body_returns_after_a_period_and_starts_at_its_mean_anomaly((orbit, _) in orbits(), phase in -2.0..2.0) {
        let orbit = Orbit { eccentricity: 0.9 * orbit.eccentricity, ..orbit };
        let t = phase * orbit.period();
        let (R, velocity) = at(&orbit, t);
        let (later, faster) = at(&orbit, t + orbit.period());
        prop_assert!((later - R).norm() < 1e-12 * R.norm());
        prop_assert!((faster - velocity).norm() < 1e-12 * velocity.norm());
        // Halfway between two passages of the periapsis the body is at the apoapsis.
        let half = (std::f64::consts::PI - orbit.mean_anomaly) / orbit.mean_motion();
        let apoapsis = orbit.semi_major_axis * (1.0 + orbit.eccentricity);
        prop_assert!((at(&orbit, half).0.norm() / apoapsis - 1.0).abs() < 1e-12);
    }
}

/// Equation `(k + 1)(k + 2) R_{k+2} = −μ₀ [R/r³]_k` for every Taylor coefficient in time; the velocity is the derivative.
fn obeys_the_law<const N: usize>(orbit: Orbit, t: f64) -> Result<(), TestCaseError> {
    let OrbitPoint { place, velocity, radius } = orbit.at(Taylor::<N>::variable(t));
    // Coefficients grow by powers of the rate at which the body passes; the factor covers those that vanish by chance.
    let unit = 0.3 * radius.value() / V::from(velocity.map(|v| v.value())).norm();
    let pull = Taylor::from(-orbit.mu) / (radius * radius * radius);
    for axis in 0..3 {
        let (rate, attraction) = (place[axis].derivative(), pull * place[axis]);
        let acceleration = rate.derivative();
        let mut size = radius.value() / unit.powi(2);
        for k in 0..N - 2 {
            let (found, expected) = (acceleration.coefficient(k), attraction.coefficient(k));
            prop_assert!((found - expected).abs() < 1e-12 * size, "{N} terms, {k}: {found:e} {expected:e}");
            let (found, expected) = (rate.coefficient(k), velocity[axis].coefficient(k));
            prop_assert!(
                (found - expected).abs() < 1e-12 * size * unit,
                "{N} terms, {k}: {found:e} {expected:e}"
            );
            size /= unit;
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn every_taylor_coefficient_of_an_orbit_obeys_the_law_of_attraction((orbit, _) in orbits(), phase in -2.0..2.0) {
        let orbit = Orbit { eccentricity: 0.9 * orbit.eccentricity, ..orbit };
        let t = phase * orbit.period();
        obeys_the_law::<3>(orbit, t)?;
        obeys_the_law::<8>(orbit, t)?;
        obeys_the_law::<17>(orbit, t)?;
    }
}

/// Near the periapsis of a nearly straight orbit, where Newton's method from the mean anomaly goes astray.
#[test]
fn the_anomaly_is_found_however_narrow_the_orbit() {
    for e in [0.0, 0.5, 0.999, 1.0 - 1e-9, 1.0 - 1e-15] {
        for exponent in -60..1 {
            for sign in [1.0, -1.0] {
                let M = sign * 3.1 * 10f64.powf(f64::from(exponent) / 4.0);
                let orbit = Orbit {
                    mu: 1.0,
                    semi_major_axis: 1.0,
                    eccentricity: e,
                    inclination: 0.0,
                    raan: 0.0,
                    argument_of_periapsis: 0.0,
                    mean_anomaly: M,
                    node_rate: 0.0,
                    periapsis_rate: 0.0,
                };
                let ([x, y, _], radius) = (orbit.at(0.0).place, orbit.at(0.0).radius);
                let E = (y / ((1.0 - e) * (1.0 + e)).sqrt()).atan2(x + e);
                // Kepler's equation, to the rounding of its largest term.
                assert!(
                    (E - e * E.sin() - M).abs() < 1e-15 * E.abs().max(1e-15),
                    "e = {e}, M = {M:e}: {E:e}"
                );
                assert!(radius > 0.0, "e = {e}, M = {M:e}");
            }
        }
    }
}

/// Precession by the oblateness of the Earth: a node that keeps to the Sun at 800 km and 98.6 degrees, 360 degrees in a tropical year; a
/// periapsis that stays at the critical inclination, `sin² i = 4/5`.
#[test]
fn precession_by_oblateness_has_its_known_values() {
    let orbit = |altitude: f64, inclination: f64, eccentricity: f64| {
        Orbit {
            mu: Orbit::EARTH_PARAMETER,
            semi_major_axis: 6.378_137e6 + altitude,
            eccentricity,
            inclination,
            raan: 1.0,
            argument_of_periapsis: 2.0,
            mean_anomaly: 0.0,
            node_rate: 0.0,
            periapsis_rate: 0.0,
        }
        .about(Oblateness::EARTH)
    };
    let sun = std::f64::consts::TAU / (365.242_19 * 86_400.0);
    let synchronous = orbit(8e5, 98.603f64.to_radians(), 0.0);
    // The inclination is printed with three digits behind the point.
    assert!((synchronous.node_rate / sun - 1.0).abs() < 1e-3, "{}", synchronous.node_rate / sun);
    let molniya = orbit(2.02e7, 0.8f64.sqrt().asin(), 0.74);
    assert!(molniya.periapsis_rate.abs() < 1e-15 * molniya.mean_motion() && molniya.node_rate < 0.0);
}
