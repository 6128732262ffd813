//! Time to find a steady spin and every small motion about it, for sprung points of three coordinates each; and the eigenvalues of many
//! matrices and of many spins in lanes beside the same one by one.
#![allow(missing_docs)]

use divan::Bencher;
use quasirigid::model::Mode;
use quasirigid::modes::{Given, RelativeEquilibrium, SpinModes, campbell};
use quasirigid::problems::ring_of_points;
use quasirigid_math::batched;
use quasirigid_math::eigen::{Dense, eigenvalues, eigenvectors};
use quasirigid_math::random::Random;
use quasirigid_math::simd::Rounding;

fn main() {
    divan::main();
}

/// Points of 30 to 600 coordinates, spinning at a tenth of a radian a second.
#[divan::bench(args = [10, 30, 100, 200], sample_count = 5)]
fn points(bencher: Bencher, count: usize) {
    let body = ring_of_points(count).body().expect("the ring has an equilibrium");
    bencher.bench(|| {
        let spin =
            RelativeEquilibrium::near(&body, [0.0, 0.0, 1.0], Given::Rate(0.1)).expect("a steady spin");
        SpinModes::about(&body, spin).expect("its modes")
    });
}

/// Eigenvalues of 256 random matrices.
mod matrices {
    use super::*;

    const SIZES: [usize; 5] = [5, 9, 15, 31, 63];

    fn random(size: usize) -> Vec<Dense> {
        let mut draws = Random::new(1);
        let mut matrix = || {
            let mut matrix = Dense::zero(size);
            (0..size * size).for_each(|place| matrix.add(place / size, place % size, draws.unit() - 0.5));
            matrix
        };
        (0..256).map(|_| matrix()).collect()
    }

    #[divan::bench(args = SIZES, sample_count = 20)]
    fn lanes(bencher: Bencher, size: usize) {
        let all = random(size);
        bencher.bench(|| batched::eigenvalues(&all, Rounding::Fastest));
    }

    #[divan::bench(args = SIZES, sample_count = 20)]
    fn lanes_reproducible(bencher: Bencher, size: usize) {
        let all = random(size);
        bencher.bench(|| batched::eigenvalues(&all, Rounding::Reproducible));
    }

    #[divan::bench(args = SIZES, sample_count = 20)]
    fn one_by_one(bencher: Bencher, size: usize) {
        let all = random(size);
        bencher.bench(|| all.iter().map(eigenvalues).collect::<Vec<_>>());
    }

    #[divan::bench(args = [5, 9, 15], sample_count = 20)]
    fn one_by_one_with_vectors(bencher: Bencher, size: usize) {
        let all = random(size);
        bencher.bench(|| all.iter().map(eigenvectors).collect::<Vec<_>>());
    }
}

/// A ring of one, two or four points at 256 spins.
mod spins {
    use super::*;

    const POINTS: [usize; 3] = [1, 2, 4];

    fn spins() -> Vec<f64> {
        (1..=256).map(|k| 1e-3 * f64::from(k)).collect()
    }

    #[divan::bench(args = POINTS, sample_count = 20)]
    fn campbell_diagram(bencher: Bencher, count: usize) {
        let (body, spins) = (ring_of_points(count).body().expect("a body"), spins());
        bencher.bench(|| campbell(&body, Mode::ShortAxis, &spins));
    }

    #[divan::bench(args = POINTS, sample_count = 20)]
    fn steady_spins(bencher: Bencher, count: usize) {
        let (body, spins) = (ring_of_points(count).body().expect("a body"), spins());
        let steady = |spin: &f64| RelativeEquilibrium::extreme(&body, Mode::ShortAxis, Given::Rate(*spin));
        bencher.bench(|| spins.iter().map(steady).collect::<Vec<_>>());
    }

    #[divan::bench(args = POINTS, sample_count = 20)]
    fn modes_one_by_one(bencher: Bencher, count: usize) {
        let (body, spins) = (ring_of_points(count).body().expect("a body"), spins());
        let modes = |spin: &f64| {
            let steady = RelativeEquilibrium::extreme(&body, Mode::ShortAxis, Given::Rate(*spin)).ok()?;
            SpinModes::about(&body, steady).ok()
        };
        bencher.bench(|| spins.iter().map(modes).collect::<Vec<_>>());
    }
}
