//! Angular velocity and angular momentum, energy and power: the series fit each other degree by degree. (R9)–(R11)

use proptest::prelude::*;
use quasirigid::model::ReducedBody;
use quasirigid::reduction::reduce;
use quasirigid_math::polynomial::{Homogeneous, Series};

use super::compare::{directions, size};
use super::ray::{Ray, along};
use crate::support::transform::stiffened;
use crate::support::{bodies, cases, vector};

/// Rounding of some hundred operations per coefficient, grown by the condition of `C` and `J`.
const ROUNDING: f64 = 1e-11;
/// Rounding of a composition, relative to the sum of the sizes of its terms.
const COMPOSED: f64 = 1e-12;
/// Size relative to its parts above which a value is not zero.
const SOMETHING: f64 = 1e-8;

/// The map with the sizes of its coefficients.
fn absolute(map: &Series) -> Series {
    let mut sizes = map.clone();
    for degree in 0..=map.degree() {
        let mut part = map.part(degree).clone();
        part.coefficients_mut().flatten().for_each(|c| *c = c.abs());
        sizes.set(part);
    }
    sizes
}

/// Degree `d` of vectors along rays, and the largest of its parts.
fn largest(rows: &[Vec<Ray>], degree: usize) -> f64 {
    rows.iter().flatten().fold(0.0, |size, row| size.max(row.0[degree].abs()))
}

/// Balance `∇E·F + P` at one degree: the sum, and the largest that a part of it could be.
fn balance(energy: &Series, field: &Series, power: &Homogeneous, degree: usize) -> (f64, f64) {
    let mut sum = energy.rate(field, degree);
    sum.add_scaled(1.0, power);
    let pairs = (1..=energy.degree().min(degree)).map(|a| (a, degree + 1 - a));
    let parts = pairs
        .filter(|(_, b)| *b <= field.degree())
        .map(|(a, b)| a as f64 * size(energy.part(a)) * size(field.part(b)));
    (size(&sum), parts.fold(size(power), f64::max))
}

fn part(series: &Series, degree: usize) -> Homogeneous {
    if degree <= series.degree() {
        series.part(degree).clone()
    } else {
        Homogeneous::zero(degree, series.rows())
    }
}

/// `K × Ω(K)`.
fn momentum_rate(body: &ReducedBody) -> Series {
    let mut rate = Series::zero(body.Omega.degree() + 1, 3);
    for degree in 1..=body.Omega.degree() {
        rate.set(Homogeneous::identity().cross(body.Omega.part(degree)));
    }
    rate
}

proptest! {
    #![proptest_config(cases(32))]

    /// `Ω(K(ω)) = ω` up to degree `p + 1`, and no further. (R11)
    #[test]
    fn the_spin_of_the_momentum_of_a_spin_is_the_spin(assembly in bodies(), p in 1..7usize) {
        let body = reduce(&assembly.body().unwrap(), p).unwrap();
        let composed = |u: [f64; 3]| body.Omega.vector(body.K.vector(along(u))).to_vec();
        let (Omega, K) = (absolute(&body.Omega), absolute(&body.K));
        let terms = |u: [f64; 3]| Omega.vector(K.vector(along(u.map(f64::abs)))).to_vec();
        let [spins, terms]: [Vec<Vec<Ray>>; 2] =
            [directions().map(composed).collect(), directions().map(terms).collect()];
        for degree in 1..=p + 1 {
            let scale = largest(&terms, degree);
            for (u, spin) in directions().zip(&spins) {
                for axis in 0..3 {
                    let expected = if degree == 1 { u[axis] } else { 0.0 };
                    let gap = (spin[axis].0[degree] - expected).abs();
                    prop_assert!(gap <= COMPOSED * scale, "p = {p}, degree {degree}: {gap:e} of {scale:e}");
                }
            }
        }
        // A rigid body is exact; at p = 2 nothing is odd, so the first error is a degree later.
        let first = if p == 2 { 5 } else { p + 2 };
        let (error, scale) = (largest(&spins, first), largest(&terms, first));
        prop_assert!(if p == 1 { error == 0.0 } else { error > SOMETHING * scale }, "p = {p}: {error:e}");
    }

    /// Energy is the same number in either variable up to degree `p + 2`. (R10), (R11)
    #[test]
    fn energy_of_the_momentum_is_energy_of_the_spin(assembly in bodies(), p in 1..7usize) {
        let body = reduce(&assembly.body().unwrap(), p).unwrap();
        let (energy, K) = (absolute(&body.energy_of_momentum), absolute(&body.K));
        let terms = |u: [f64; 3]| vec![energy.scalar(K.vector(along(u.map(f64::abs))))];
        let terms: Vec<Vec<Ray>> = directions().map(terms).collect();
        let both = |u| [body.energy_of_momentum.scalar(body.K.vector(along(u))), body.energy.scalar(along(u))];
        let energies: Vec<[Ray; 2]> = directions().map(both).collect();
        for degree in 2..=p + 2 {
            let scale = largest(&terms, degree);
            for [composed, own] in &energies {
                let gap = (composed.0[degree] - own.0[degree]).abs();
                prop_assert!(gap <= COMPOSED * scale, "p = {p}, degree {degree}: {gap:e} of {scale:e}");
            }
        }
    }

    /// `Ė + P` starts at degree `p + 4`. (R10)
    #[test]
    fn energy_falls_by_the_power_of_the_dashpots(assembly in bodies(), p in 1..7usize) {
        let body = reduce(&assembly.body().unwrap(), p).unwrap();
        for degree in 3..=p + 3 {
            let (sum, parts) = balance(&body.energy, &body.f, &part(&body.power, degree), degree);
            prop_assert!(sum <= ROUNDING * parts, "p = {p}, degree {degree}: {sum:e} of {parts:e}");
        }
        // Up to p = 2 there is neither a power nor an odd degree.
        if p > 2 {
            let (sum, parts) = balance(&body.energy, &body.f, &part(&body.power, p + 4), p + 4);
            prop_assert!(sum > SOMETHING * parts, "p = {p}: {sum:e} of {parts:e}");
        }
    }

    /// Energy balance in the angular-momentum form. (P1), (P4)
    #[test]
    fn energy_of_the_momentum_falls_by_the_power_of_the_dashpots(assembly in bodies(), p in 1..7usize) {
        let body = reduce(&assembly.body().unwrap(), p).unwrap();
        let rate = momentum_rate(&body);
        let powers: Vec<Ray> = directions().map(|u| body.power.scalar(body.Omega.vector(along(u)))).collect();
        for degree in 3..=p + 3 {
            let nothing = Homogeneous::zero(degree, 1);
            let (_, parts) = balance(&body.energy_of_momentum, &rate, &nothing, degree);
            let along_field = body.energy_of_momentum.rate(&rate, degree);
            for (u, power) in directions().zip(&powers) {
                let power = power.0[degree];
                let gap = (super::compare::value(&along_field, u)[0] + power).abs();
                prop_assert!(gap <= ROUNDING * parts.max(power.abs()), "p = {p}, degree {degree}: {gap:e} of {parts:e}");
            }
        }
    }

    /// Without dashpots nothing is lost. (R9), (R10)
    #[test]
    fn energy_is_kept_without_dashpots(assembly in bodies(), p in 2..6usize) {
        let body = reduce(&stiffened(&assembly, 1.0, 0.0).body().unwrap(), p).unwrap();
        for degree in 3..=p + 3 {
            let nothing = Homogeneous::zero(degree, 1);
            let (sum, parts) = balance(&body.energy, &body.f, &nothing, degree);
            prop_assert!(sum <= ROUNDING * parts, "p = {p}, degree {degree}: {sum:e} of {parts:e}");
        }
        prop_assert!((0..=body.power.degree()).all(|degree| body.power.part(degree).amax() == 0.0));
    }

    /// Power is a sum of squares, also far beyond the spins at which the series means anything. (R9)
    #[test]
    fn dashpots_never_give_energy(assembly in bodies(), p in 3..9usize, u in vector(), decades in -3.0..3.0) {
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, p).unwrap();
        let frequency = quasirigid::reduction::Vibrations::compute(&body).unwrap().frequencies[0];
        let omega = u.map(|x| 10f64.powf(decades) * frequency * x);
        let length = omega.iter().map(|x| x.abs()).sum::<f64>();
        let parts = (6..=2 * p).map(|d| reduced.power.part(d).amax() * length.powi(d as i32)).fold(0.0, f64::max);
        let power = reduced.dissipated_power(omega);
        // Where the power vanishes only the rounding of its terms is left.
        prop_assert!(power >= -1e-13 * parts, "{power:e} of {parts:e}");
        prop_assert!(size(reduced.power.part(6)) > 0.0);
    }
}

/// Near a principal axis the squares are small and their expansion cancels; the sign must hold there as well.
#[test]
fn dashpots_take_no_power_in_a_steady_spin_about_a_symmetry_axis() {
    let body =
        quasirigid::problems::AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.3 };
    let reduced = reduce(&body.assembly().body().unwrap(), 5).unwrap();
    assert_eq!(reduced.dissipated_power([0.0, 0.0, 1.3]), 0.0);
    assert!(reduced.dissipated_power([1e-3, 0.0, 1.3]) > 0.0);
}
