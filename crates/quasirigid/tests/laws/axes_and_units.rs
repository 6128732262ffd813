//! Results depend neither on axes nor on units.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use quasirigid::elements::Assembly;
use quasirigid::model::FlexibleBody;
use quasirigid::reduction::{Validity, Vibrations, reduce};
use quasirigid_math::polynomial::Series;
use quasirigid_math::sym3;

use super::compare::{angles, difference, displacements, list_gap, scaled_gap, value};
use super::wobbler;
use crate::support::transform::{Units, rescaled, rotated};
use crate::support::{assemblies, bodies, cases, direction, rotation, units};

/// Rounding of some hundred operations per coefficient, grown by the condition of `C` and `J`.
const ROUNDING: f64 = 1e-11;
/// Damped eigenvalues near critical damping are as sensitive as a square root.
const DAMPED: f64 = 1e-7;

/// Vector field rotated with the body: `R f(Rᵀ u)`.
fn turned(field: &Series, R: &Matrix3<f64>) -> impl Fn(usize, [f64; 3]) -> Vec<f64> {
    let (field, R) = (field.clone(), *R);
    move |degree, u| {
        let before = value(field.part(degree), (R.transpose() * Vector3::from(u)).into());
        (R * Vector3::from_row_slice(&before)).as_slice().to_vec()
    }
}

fn vector_gap(found: &Series, before: &Series, R: &Matrix3<f64>) -> f64 {
    difference(0..=before.degree(), |d, u| value(found.part(d), u), turned(before, R))
}

fn scalar_gap(found: &Series, before: &Series, R: &Matrix3<f64>) -> f64 {
    let earlier = |d: usize, u: [f64; 3]| value(before.part(d), (R.transpose() * Vector3::from(u)).into());
    difference(0..=before.degree(), |d, u| value(found.part(d), u), earlier)
}

fn vibrations_gap(found: &FlexibleBody, expected: &FlexibleBody, time: f64) -> [f64; 4] {
    let (found, expected) = (Vibrations::compute(found).unwrap(), Vibrations::compute(expected).unwrap());
    let slower = |rates: &[f64]| -> Vec<f64> { rates.iter().map(|rate| rate / time).collect() };
    [
        list_gap(&found.frequencies, &slower(&expected.frequencies)),
        list_gap(&found.free_frequencies, &slower(&expected.free_frequencies)),
        list_gap(&[found.damping_time], &[expected.damping_time * time]),
        list_gap(&found.decay_rates, &slower(&expected.decay_rates)) * ROUNDING / DAMPED,
    ]
}

proptest! {
    #![proptest_config(cases(32))]

    /// Every result is a vector, a tensor or a number. (R1)–(R11), (V2), (V3)
    #[test]
    fn rotating_the_axes_of_the_file_rotates_every_result(assembly in bodies(), R in rotation()) {
        let (before, after) = (assembly.body().unwrap(), rotated(&assembly, &R).body().unwrap());
        let (old, new) = (reduce(&before, 4).unwrap(), reduce(&after, 4).unwrap());
        let J = R * Matrix3::from(sym3::rows(old.J)) * R.transpose();
        let J_gap = (Matrix3::from(sym3::rows(new.J)) - J).amax() / J.amax();
        prop_assert!(J_gap < 1e-13, "J: {J_gap:e}");
        for (name, found, earlier) in
            [("f", &new.f, &old.f), ("K", &new.K, &old.K), ("Ω", &new.Omega, &old.Omega), ("φ", &new.phi, &old.phi)]
        {
            let gap = vector_gap(found, earlier, &R);
            prop_assert!(gap < ROUNDING, "{name}: {gap:e}");
        }
        let energies = (&new.energy_of_momentum, &old.energy_of_momentum);
        for (found, earlier) in [(&new.energy, &old.energy), energies, (&new.power, &old.power)] {
            let gap = scalar_gap(found, earlier, &R);
            prop_assert!(gap < ROUNDING, "energy or power: {gap:e}");
        }
        for gap in vibrations_gap(&after, &before, 1.0) {
            prop_assert!(gap < ROUNDING, "vibrations: {gap:e}");
        }
    }

    /// Coordinates depend on the axes of the file; displacements and hinge angles do not.
    #[test]
    fn rotating_the_axes_of_the_file_rotates_every_displacement(assembly in bodies(), R in rotation()) {
        let (before, after) = (assembly.body().unwrap(), rotated(&assembly, &R).body().unwrap());
        let (old, new) = (reduce(&before, 4).unwrap(), reduce(&after, 4).unwrap());
        let back = |u: [f64; 3]| -> [f64; 3] { (R.transpose() * Vector3::from(u)).into() };
        for (found, earlier) in [(&new.q, &old.q), (&new.rate, &old.rate)] {
            let moved = difference(
                0..=earlier.degree(),
                |d, u| displacements(&after, &value(found.part(d), u), &Matrix3::identity()),
                |d, u| displacements(&before, &value(earlier.part(d), back(u)), &R),
            );
            prop_assert!(moved < ROUNDING, "displacements: {moved:e}");
            let bent = difference(
                0..=earlier.degree(),
                |d, u| angles(&after, &value(found.part(d), u)),
                |d, u| angles(&before, &value(earlier.part(d), back(u))),
            );
            prop_assert!(bent < ROUNDING, "angles: {bent:e}");
        }
    }

    /// Every coefficient has the dimension its degree gives it.
    #[test]
    fn changing_the_units_scales_every_result(assembly in assemblies(), units in units()) {
        let (before, after) = (assembly.body().unwrap(), rescaled(&assembly, units).body().unwrap());
        let (old, new) = (reduce(&before, 4).unwrap(), reduce(&after, 4).unwrap());
        let of = |length: i32, mass: i32, time: i32| units.factor([length, mass, time]);
        let spin_momentum = units.factor([2, 1, -1]);
        let J = old.J.map(|entry| of(2, 1, 0) * entry);
        prop_assert!(list_gap(&new.J, &J) < 1e-14);
        let gaps = [
            ("f", scaled_gap(&new.f, &old.f, |d| of(0, 0, d - 2))),
            ("K", scaled_gap(&new.K, &old.K, |d| of(2, 1, d - 1))),
            ("Ω", scaled_gap(&new.Omega, &old.Omega, |d| of(0, 0, -1) * spin_momentum.powi(-d))),
            ("E(ω)", scaled_gap(&new.energy, &old.energy, |d| of(2, 1, d - 2))),
            ("P", scaled_gap(&new.power, &old.power, |d| of(2, 1, d - 3))),
            ("φ", scaled_gap(&new.phi, &old.phi, |d| of(1, 1, d - 2))),
        ];
        for (name, gap) in gaps {
            prop_assert!(gap < ROUNDING, "{name}: {gap:e}");
        }
        let energy = |d: i32| of(2, 1, -2) * spin_momentum.powi(-d);
        let gap = scaled_gap(&new.energy_of_momentum, &old.energy_of_momentum, energy);
        prop_assert!(gap < ROUNDING, "E(K): {gap:e}");
        for (lengths, pick) in [(1, displacements_of as fn(&FlexibleBody, &[f64]) -> Vec<f64>), (0, angles)] {
            for (found, earlier, rates) in [(&new.q, &old.q, 0), (&new.rate, &old.rate, 1)] {
                let gap = difference(
                    0..=earlier.degree(),
                    |d, u| pick(&after, &value(found.part(d), u)),
                    |d, u| {
                        let factor = of(lengths, 0, d as i32 - rates);
                        pick(&before, &value(earlier.part(d), u)).iter().map(|x| factor * x).collect()
                    },
                );
                prop_assert!(gap < ROUNDING, "q or its rate: {gap:e}");
            }
        }
        for gap in vibrations_gap(&after, &before, units.time) {
            prop_assert!(gap < ROUNDING, "vibrations: {gap:e}");
        }
    }

    /// Criteria (V1)–(V9) are ratios of times and lengths.
    #[test]
    fn changing_the_units_changes_no_criterion(
        assembly in assemblies(), units in units(), spin in direction()
    ) {
        same_criteria(&assembly, units, spin)?;
    }
}

fn same_criteria(assembly: &Assembly, units: Units, spin: [f64; 3]) -> Result<(), TestCaseError> {
    let (before, after) = (assembly.body().unwrap(), rescaled(assembly, units).body().unwrap());
    let old = Validity::assess(&before, 3, spin).unwrap();
    let new = Validity::assess(&after, 3, spin.map(|w| w / units.time)).unwrap();
    for (found, expected) in new.criteria.iter().zip(&old.criteria) {
        prop_assert_eq!(found.comparison, expected.comparison);
        let gap = (found.value - expected.value).abs();
        prop_assert!(gap <= DAMPED * expected.value, "{found:?} {expected:?}");
    }
    prop_assert_eq!(new.optimal_order, old.optimal_order);
    let Units { time, length, .. } = units;
    for (found, expected) in [(new.T1, old.T1), (new.T2, old.T2), (new.T3, old.T3)] {
        prop_assert!((found / time / expected - 1.0).abs() < DAMPED);
    }
    let (Some((_, found)), Some((_, expected))) = (new.displacement, old.displacement) else {
        return Err(TestCaseError::fail("no displacement"));
    };
    prop_assert!((found / length / expected - 1.0).abs() < ROUNDING);
    Ok(())
}

/// Where angular momenta are 1e36 and more, the squares of the factors of their powers are no numbers.
#[test]
fn the_most_extreme_units_change_no_criterion() {
    for exponents in [[9, 9, -9], [-9, -9, 9], [9, -9, 9], [-9, 9, -9]] {
        let [length, mass, time] = exponents.map(|n| 10f64.powi(n));
        same_criteria(&wobbler::assembly(), Units { length, mass, time }, [0.4, -0.2, 0.6]).unwrap();
    }
}

fn displacements_of(body: &FlexibleBody, q: &[f64]) -> Vec<f64> {
    displacements(body, q, &Matrix3::identity())
}
