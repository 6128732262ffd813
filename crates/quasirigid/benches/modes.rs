//! Time to find a steady spin and every small motion about it, for sprung points of three coordinates each; and the eigenvalues at
//! many spins beside the modes there.
#![allow(missing_docs)]

use divan::Bencher;
use quasirigid::model::Mode;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes, campbell};
use quasirigid::problems::ring_of_points;

fn main() {
    divan::main();
}

/// Points of 30 to 600 coordinates, spinning at a tenth of a radian a second.
#[divan::bench(args = [10, 30, 100, 200], sample_count = 5)]
fn points(bencher: Bencher, count: usize) {
    let body = ring_of_points(count).body().expect("the ring has an equilibrium");
    bencher.bench(|| {
        let spin = RelativeEquilibrium::near(&body, [0.0, 0.0, 1.0], SpinMagnitude::Rate(0.1))
            .expect("a steady spin");
        SpinModes::about(&body, spin).expect("its modes")
    });
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
        let steady =
            |spin: &f64| RelativeEquilibrium::extreme(&body, Mode::ShortAxis, SpinMagnitude::Rate(*spin));
        bencher.bench(|| spins.iter().map(steady).collect::<Vec<_>>());
    }

    #[divan::bench(args = POINTS, sample_count = 20)]
    fn modes_one_by_one(bencher: Bencher, count: usize) {
        let (body, spins) = (ring_of_points(count).body().expect("a body"), spins());
        let modes = |spin: &f64| {
            let steady =
                RelativeEquilibrium::extreme(&body, Mode::ShortAxis, SpinMagnitude::Rate(*spin)).ok()?;
            SpinModes::about(&body, steady).ok()
        };
        bencher.bench(|| spins.iter().map(modes).collect::<Vec<_>>());
    }
}
