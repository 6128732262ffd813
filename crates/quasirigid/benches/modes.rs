//! Time to find a steady spin and every small motion about it, for sprung points of three coordinates each.
#![allow(missing_docs)]

use divan::Bencher;
use quasirigid::modes::{Given, RelativeEquilibrium, SpinModes};
use quasirigid::problems::ring_of_points;

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
