//! Free vibrations by sums over all of them, which need no eigenvalue. (V2), (V3), (V5)

use nalgebra::{DMatrix, Matrix3};
use proptest::prelude::*;
use quasirigid::model::{FlexibleBody, Support};
use quasirigid::reduction::Vibrations;
use quasirigid_math::sparse::SparseRows;
use quasirigid_math::sym3;

use crate::support::{assemblies, cases};

/// Rounding of eigenvalues of a matrix of some ten rows, relative to the largest.
const ROUNDING: f64 = 1e-10;

fn full(matrix: &SparseRows<f64>) -> DMatrix<f64> {
    let mut full = DMatrix::zeros(matrix.size(), matrix.size());
    matrix.iter().for_each(|(row, column, entry)| full[(row, column)] += entry);
    full
}

/// `A` with the translation of a free body eliminated, written out. (S6)
fn mass(body: &FlexibleBody) -> DMatrix<f64> {
    let invariants = body.invariants();
    let n = body.coordinates().len();
    let mut A = DMatrix::zeros(n, n);
    invariants.pairs.iter().for_each(|(row, column, pair)| A[(row, column)] += pair.A);
    if *body.support() == Support::Free {
        let S = rows(&invariants.S);
        A -= &S * S.transpose() / invariants.mass;
    }
    A
}

fn rows(vectors: &[[f64; 3]]) -> DMatrix<f64> {
    DMatrix::from_fn(vectors.len(), 3, |row, axis| vectors[row][axis])
}

/// `A − h J⁻¹ hᵀ`.
fn recoiling(body: &FlexibleBody) -> DMatrix<f64> {
    let h = rows(&body.invariants().h);
    let inverse = Matrix3::from(sym3::rows(body.invariants().J)).try_inverse().unwrap();
    mass(body) - &h * inverse * h.transpose()
}

proptest! {
    #![proptest_config(cases(32))]

    /// Sums over the vibrations: `Σ 1/Ω² = tr C⁻¹A`, fixed or free to recoil, and `Σ −Re λ = tr A⁻¹B`.
    #[test]
    fn sums_over_the_vibrations_are_traces(assembly in assemblies()) {
        let body = assembly.body().unwrap();
        let vibrations = Vibrations::compute(&body).unwrap();
        let (A, B, C) = (mass(&body), full(body.damping()), full(body.stiffness()));
        let squares = |frequencies: &[f64]| frequencies.iter().map(|frequency| frequency.powi(-2)).sum::<f64>();
        let compliance = C.clone().try_inverse().unwrap();
        let held = (&compliance * &A).trace();
        prop_assert!((squares(&vibrations.frequencies) / held - 1.0).abs() < ROUNDING);
        let free = (&compliance * recoiling(&body)).trace();
        prop_assert!((squares(&vibrations.free_frequencies) / free - 1.0).abs() < ROUNDING);
        prop_assert_eq!(vibrations.decay_rates.len(), 2 * body.coordinates().len());
        let decay = (A.try_inverse().unwrap() * &B).trace();
        prop_assert!((vibrations.decay_rates.iter().sum::<f64>() / decay - 1.0).abs() < ROUNDING);
        // The largest of n eigenvalues is between their mean and their sum, all being positive.
        let times = (compliance * B).trace();
        let share = vibrations.damping_time / times;
        prop_assert!(share < 1.0 + ROUNDING && share * body.coordinates().len() as f64 > 1.0 - ROUNDING);
    }

    /// Recoil takes inertia away: no vibration becomes slower, and none is undamped where every spring has a dashpot.
    #[test]
    fn a_body_free_to_recoil_vibrates_faster(assembly in assemblies()) {
        let vibrations = Vibrations::compute(&assembly.body().unwrap()).unwrap();
        for (held, free) in vibrations.frequencies.iter().zip(&vibrations.free_frequencies) {
            prop_assert!(*free > held * (1.0 - ROUNDING), "{held} {free}");
        }
        prop_assert!(vibrations.decay_rates.iter().all(|rate| *rate > 0.0));
    }

    /// Lowest frequency: `C − Ω²A` is singular there and at no lower one. (V2)
    #[test]
    fn the_lowest_frequency_is_the_lowest(assembly in assemblies()) {
        let body = assembly.body().unwrap();
        let lowest = Vibrations::compute(&body).unwrap().frequencies[0];
        let stiffer = |frequency: f64| full(body.stiffness()) - mass(&body) * (frequency * frequency);
        prop_assert!(stiffer(lowest * (1.0 - 1e-6)).cholesky().is_some());
        prop_assert!(stiffer(lowest * (1.0 + 1e-6)).cholesky().is_none());
    }
}
