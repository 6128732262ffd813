//! Energy form: the reduced equations it is derived from, and its two laws at every angular momentum. (R16)–(R19)

use nalgebra::Matrix3;
use proptest::prelude::*;
use quasirigid::dynamics::{Options, Outcome, Sample, Start, propagate, steady_spins};
use quasirigid::elements::Assembly;
use quasirigid::model::EnergyMotion;
use quasirigid::reduction::{Vibrations, reduce};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::sym3;
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use super::compare::directions;
use super::ray::{Ray, along};
use crate::support::{bodies, cases, vector};

/// Rounding of compositions, relative to the largest value of a degree of the angular velocity.
const COMPOSED: f64 = 1e-9;
/// Rounding of some hundred operations.
const ROUNDING: f64 = 1e-12;

/// Symmetric tensor by its components xx, yy, zz, yz, zx, xy, times a vector.
fn times(T: &[Ray], [x, y, z]: [Ray; 3]) -> [Ray; 3] {
    [T[0] * x + T[5] * y + T[4] * z, T[5] * x + T[1] * y + T[3] * z, T[4] * x + T[3] * y + T[2] * z]
}

proptest! {
    #![proptest_config(cases(24))]

    /// `Ω = ∇E − K̇ × c + T K̇` along `K̇ = K × Ω`, degree by degree: the energy form has the angular velocity that the series has. (R17)
    #[test]
    fn angular_velocity_is_that_of_the_series(assembly in bodies(), p in 1..7usize) {
        let body = reduce(&assembly.body().unwrap(), p).unwrap();
        let gradient = body.energy_of_momentum.gradient();
        let mut gaps = vec![(0.0_f64, 0.0_f64); p + 2];
        for u in directions() {
            let K = along(u);
            let Omega = body.Omega.vector(K);
            let rate = cross(K, Omega);
            let braked = times(&body.T.value(K), rate);
            let found = add(gradient.vector(K), add(cross(body.c.vector(K), rate), braked));
            for axis in 0..3 {
                for (degree, (gap, size)) in gaps.iter_mut().enumerate() {
                    *gap = gap.max((found[axis].0[degree] - Omega[axis].0[degree]).abs());
                    *size = size.max(Omega[axis].0[degree].abs()).max(gradient.vector(K)[axis].0[degree].abs());
                }
            }
        }
        for (degree, (gap, size)) in gaps.iter().enumerate() {
            prop_assert!(*gap <= COMPOSED * size, "p = {p}, degree {degree}: {gap:e} of {size:e}");
        }
    }

    /// `K·K̇ = 0`, `∇E·K̇ = −P ≤ 0` and `K̇ = K × ω` at every angular momentum, also where the series does not hold. (R16)
    #[test]
    fn both_laws_hold_everywhere(assembly in bodies(), p in 0..7usize, u in vector(), decades in -3.0..1.0) {
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, p).unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let K = reduced.K.truncated(1).vector(u.map(|x| 10f64.powf(decades) * frequency * x));
        let EnergyMotion { omega, rate, power } = reduced.motion(K);
        let gradient = reduced.energy_of_momentum.gradient().vector(K);
        let size = norm(rate) + norm(cross(K, gradient));
        prop_assert!(dot(K, rate).abs() <= ROUNDING * norm(K) * size);
        prop_assert!(power >= -ROUNDING * size * norm(gradient), "{power:e}");
        prop_assert!((dot(gradient, rate) + power).abs() <= ROUNDING * norm(gradient) * size);
        prop_assert!(norm(add(cross(K, omega), scale(-1.0, rate))) <= ROUNDING * norm(K) * norm(omega));
    }

    /// About a steady spin of least energy small nutations decay, about one of greatest energy they grow, at every order and spin. (P5)
    #[test]
    fn nutation_decays_at_the_least_energy(assembly in bodies(), p in 3..7usize, decades in -2.0..-0.5) {
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, p).unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let G = norm(reduced.K.truncated(1).vector([0.0, 0.0, 10f64.powf(decades) * frequency]));
        let [least, _, greatest] = steady_spins(&reduced, G);
        for (spin, sign) in [(least, 1.0), (greatest, -1.0)] {
            if let Some(spin) = spin {
                prop_assert!(sign * spin.growth >= 0.0, "{spin:?}");
            }
        }
    }

    /// Along a run `|K|` and `E + ∫P dt` are constants to rounding, whatever the tolerance. (P6)
    #[test]
    fn drifts_are_rounding_whatever_the_step(assembly in bodies(), exponent in 5..12i32, u in vector()) {
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, 3).unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let omega = scale(0.1 * frequency / norm(u), u);
        let options = Options { tolerance: 10f64.powi(-exponent), ..Options::default() };
        let mut samples: Vec<Sample> = Vec::new();
        let times = [0.0, 50.0 / (0.1 * frequency), 100.0 / (0.1 * frequency)];
        let run = propagate(&reduced, Start::new(omega, ALIGNED), &times, &options, &mut samples).unwrap();
        prop_assert_eq!(run.outcome, Outcome::Finished);
        for sample in &samples {
            prop_assert!(sample.energy_drift.abs() <= 1e-13 * sample.energy, "{sample:?}");
            let K = norm(sample.angular_momentum) / norm(samples[0].angular_momentum) - 1.0;
            prop_assert!(K.abs() <= 1e-13, "{K:e}");
        }
        let fall = samples[0].energy - samples[2].energy;
        prop_assert!((fall - samples[2].dissipated).abs() <= 1e-13 * samples[0].energy);
    }
}

/// The body of the runs with its carrier changed so that so many moments are equal.
fn with_equal_moments(equal: usize) -> Assembly {
    let mut assembly = super::wobbler::assembly();
    let J = Matrix3::from(sym3::rows(assembly.body().unwrap().invariants().J));
    let mut change = J.symmetric_eigen();
    let mean = change.eigenvalues.rows(0, equal).mean();
    for i in 0..3 {
        change.eigenvalues[i] = if i < equal { mean - change.eigenvalues[i] } else { 0.0 };
    }
    let carrier = assembly.carrier.as_mut().unwrap();
    carrier.inertia = (Matrix3::from(carrier.inertia) + change.recompose()).into();
    assembly
}

/// Springs that do not share the symmetry of two or three equal moments: nothing is divided by the difference of the moments.
#[test]
fn equal_moments_are_no_exception() {
    for equal in [1, 2, 3] {
        let reduced = reduce(&with_equal_moments(equal).body().unwrap(), 4).unwrap();
        let gap = |step: f64| {
            let K = scale(step, [0.3, -0.2, 0.25]);
            let series = reduced.Omega.vector(K);
            norm(add(reduced.angular_velocity(K), scale(-1.0, series))) / norm(series)
        };
        let order = (gap(4.0) / gap(2.0)).log2();
        println!("{equal} equal: {:e} {:e} order {order}", gap(4.0), gap(2.0));
        assert!(order > 4.7, "{equal} equal: order {order}");
    }
}
