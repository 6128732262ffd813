//! Conics of any eccentricity against their equation, `R̈ = −μ₀ R/r³`, its integrals, and closed forms. (F23), (F24)

use nalgebra::Vector3;
use proptest::array::uniform7;
use proptest::prelude::*;
use quasirigid::model::force::{Conic, Orbit, OrbitPoint};
use quasirigid_math::scalar::Smooth;
use quasirigid_math::taylor::Taylor;

use crate::support::cases;

type V = Vector3<f64>;

fn at(conic: &Conic, t: f64) -> (V, V) {
    let OrbitPoint { place, velocity, .. } = conic.at(t);
    (place.into(), velocity.into())
}

/// Eccentricities from circles to nearly straight lines, on both sides of the parabola as near as digits tell.
fn eccentricities() -> impl Strategy<Value = f64> {
    prop_oneof![
        0.0..0.95,
        1.0..8.0,
        (0.0..15.0, any::<bool>())
            .prop_map(|(x, above): (f64, bool)| 1.0 + 10f64.powf(-x) * if above { 1.0 } else { -0.5 }),
        (0.0..6.0).prop_map(|x: f64| 10f64.powf(x)),
        Just(1.0),
    ]
}

/// Conics of every eccentricity in any units, and times in passing times from the periapsis, ahead and behind, near and far.
fn conics() -> impl Strategy<Value = (Conic, f64)> {
    let time = (-3.0..4.0, any::<bool>())
        .prop_map(|(x, sign): (f64, bool)| 10f64.powf(x) * if sign { 1.0 } else { -1.0 });
    (eccentricities(), uniform7(0.2..3.0), time, -9.0..9.0, -9.0..9.0).prop_map(
        |(eccentricity, x, passed, length, time): (f64, [f64; 7], f64, f64, f64)| {
            let (length, time) = (10f64.powf(length), 10f64.powf(time));
            let conic = Conic {
                mu: x[0] * length.powi(3) / time.powi(2),
                periapsis_distance: x[1] * length,
                eccentricity,
                inclination: x[2],
                raan: 2.0 * x[3],
                argument_of_periapsis: 2.0 * x[4],
                time_of_periapsis: 0.0,
            };
            // a shifted origin of time costs the digits of the shift
            let unit = conic.passing_time();
            (
                Conic { time_of_periapsis: 0.1 * x[5] * passed * unit, ..conic },
                passed * unit * (1.0 + 0.1 * x[5]),
            )
        },
    )
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn energy_momentum_and_shape_are_constant_along_a_conic((conic, t) in conics()) {
        let Conic { mu, periapsis_distance: q, eccentricity: e, .. } = conic;
        let (R, velocity) = at(&conic, t);
        let r = R.norm();
        let radius: f64 = conic.at(t).radius;
        prop_assert!((radius / r - 1.0).abs() < 1e-13, "{}", radius / r - 1.0);
        let energy = 0.5 * velocity.norm_squared() - mu / r;
        let greatest = 0.5 * velocity.norm_squared() + mu / r;
        prop_assert!((energy + 0.5 * mu * (1.0 - e) / q).abs() < 1e-13 * greatest, "{energy:e}");
        let (si, ci) = conic.inclination.sin_cos();
        let (sn, cn) = conic.raan.sin_cos();
        let normal = V::new(si * sn, -si * cn, ci);
        let momentum = R.cross(&velocity);
        let size = (mu * q * (1.0 + e)).sqrt();
        // The product loses the digits of the angle between place and velocity.
        let lost = r * velocity.norm() / size;
        prop_assert!((momentum / size - normal).norm() < 1e-13 * lost, "{momentum:?}");
        let laplace = velocity.cross(&momentum) / mu - R / r;
        let node = V::new(cn, sn, 0.0);
        let (sp, cp) = conic.argument_of_periapsis.sin_cos();
        let known = e * (cp * node + sp * normal.cross(&node));
        prop_assert!((laplace - known).norm() < 1e-13 * lost * (1.0 + r * velocity.norm_squared() / mu), "{laplace}");
    }

    /// The time from the periapsis by the true anomaly, in the closed forms of the ellipse and the hyperbola.
    #[test]
    fn the_time_of_a_place_is_that_of_the_closed_form((conic, t) in conics()) {
        let Conic { mu, periapsis_distance: q, eccentricity: e, time_of_periapsis, .. } = conic;
        prop_assume!((e - 1.0).abs() > 1e-3 && e < 1e3);
        let (R, velocity) = at(&conic, t);
        let a = q / (1.0 - e).abs();
        let n = (mu / a).sqrt() / a;
        // e sin E, or e sinh F
        let leaning = R.dot(&velocity) / (mu * a).sqrt();
        let passed = t - time_of_periapsis;
        let (found, size) = if e < 1.0 {
            let E = (leaning).atan2(1.0 - R.norm() / a);
            let M = E - leaning;
            let turns = ((n * passed - M) / std::f64::consts::TAU).round();
            (M + std::f64::consts::TAU * turns, E.abs() + leaning.abs() + (n * passed).abs())
        } else {
            let F = (leaning / e).asinh();
            (leaning - F, leaning.abs() + F.abs())
        };
        prop_assert!((found - n * passed).abs() < 1e-12 * size.max((n * passed).abs()), "{found} {}", n * passed);
    }

    #[test]
    fn every_taylor_coefficient_of_a_conic_obeys_the_law_of_attraction((conic, t) in conics()) {
        obeys_the_law::<3>(conic, t)?;
        obeys_the_law::<8>(conic, t)?;
        obeys_the_law::<17>(conic, t)?;
    }

    /// Ellipses by their semi-major axis, the other road to the same places.
    #[test]
    fn ellipses_are_those_of_the_semi_major_axis((conic, t) in conics(), e in 0.0..0.9) {
        let conic = Conic { eccentricity: e, ..conic };
        let a = conic.periapsis_distance / (1.0 - e);
        let n = (conic.mu / a).sqrt() / a;
        let orbit = Orbit {
            mu: conic.mu,
            semi_major_axis: a,
            eccentricity: e,
            inclination: conic.inclination,
            raan: conic.raan,
            argument_of_periapsis: conic.argument_of_periapsis,
            mean_anomaly: -n * conic.time_of_periapsis,
            node_rate: 0.0,
            periapsis_rate: 0.0,
        };
        let OrbitPoint { place, velocity, .. } = orbit.at(t);
        let (R, v) = at(&conic, t);
        let lost = 1e-13 * (1.0 + n * t.abs()) / (1.0 - e).powi(2);
        prop_assert!((R - V::from(place)).norm() < lost * R.norm());
        prop_assert!((v - V::from(velocity)).norm() < lost * v.norm());
    }

    /// Across the parabola: the places on both sides tend to it, linearly in the distance of the eccentricity, and it is Barker's closed form.
    #[test]
    fn both_sides_of_the_parabola_meet_in_barkers_solution((conic, t) in conics()) {
        let Conic { mu, periapsis_distance: q, time_of_periapsis, .. } = conic;
        let of = |e: f64| at(&Conic { eccentricity: e, inclination: 0.0, raan: 0.0, argument_of_periapsis: 0.0, ..conic }, t).0;
        let parabola = of(1.0);
        // tan(ν/2) = x: x + x³/3 = √(μ/2q³) t
        let B = 1.5 * (0.5 * mu / q).sqrt() / q * (t - time_of_periapsis);
        let root = (B.abs() + B.hypot(1.0)).cbrt();
        let x = (2.0 * B.abs() / (root * root + 1.0 + 1.0 / (root * root))).copysign(B);
        let barker = q * V::new(1.0 - x * x, 2.0 * x, 0.0);
        prop_assert!((parabola - barker).norm() < 1e-13 * barker.norm(), "{parabola} {barker}");
        let far = (1.0 + x * x).powi(2);
        for delta in [1e-8, 1e-12] {
            let (below, above) = (of(1.0 - delta), of(1.0 + delta));
            let apart = (above - below).norm() / parabola.norm();
            prop_assume!(far * delta < 1e-3);
            prop_assert!(apart < 4.0 * far * delta + 1e-13, "{apart:e} at {delta:e}");
            let curved = (0.5 * (above + below) - parabola).norm() / parabola.norm();
            prop_assert!(curved < 10.0 * (far * delta).powi(2) + 1e-13, "{curved:e} at {delta:e}");
        }
    }
}

/// Equation `(k + 1)(k + 2) R_{k+2} = −μ₀ [R/r³]_k` for every Taylor coefficient in time; the velocity is the derivative.
fn obeys_the_law<const N: usize>(conic: Conic, t: f64) -> Result<(), TestCaseError> {
    let OrbitPoint { place, velocity, radius } = conic.at(Taylor::<N>::variable(t));
    // Coefficients grow by powers of the rate at which the body passes; the factor covers those that vanish by chance.
    let unit = 0.3 * radius.value() / V::from(velocity.map(|v| v.value())).norm();
    let pull = Taylor::from(-conic.mu) / (radius * radius * radius);
    for axis in 0..3 {
        let (rate, attraction) = (place[axis].derivative(), pull * place[axis]);
        let acceleration = rate.derivative();
        let mut size = radius.value() / unit.powi(2);
        for k in 0..N - 2 {
            let (found, expected) = (acceleration.coefficient(k), attraction.coefficient(k));
            prop_assert!(
                (found - expected).abs() < 1e-11 * size,
                "{N} terms, {k}: {found:e} {expected:e} of {size:e}"
            );
            let (found, expected) = (rate.coefficient(k), velocity[axis].coefficient(k));
            prop_assert!(
                (found - expected).abs() < 1e-11 * size * unit,
                "{N} terms, {k}: {found:e} {expected:e}"
            );
            size /= unit;
        }
    }
    Ok(())
}
