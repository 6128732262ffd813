//! Time to derive the reduced equations about a steady spin, and of a history by them beside the full system at equal error.
#![allow(missing_docs)]
#![allow(non_snake_case)]

use std::ops::ControlFlow;

use divan::Bencher;
use quasirigid::dynamics::{Forced, Options, Sample, propagate_full};
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::problems::{Explorer1, ring_of_points};
use quasirigid::submanifold::{
    ManifoldStart, Masters, SpinManifold, SpinManifoldPlan, Style, propagate_on_manifold,
};

fn main() {
    divan::main();
}

/// Spin (rad/s): a fifth of the slowest vibration of the ring.
const SPIN: f64 = 4.0;
/// Revolutions of a history, and its amplitude (rad).
const REVOLUTIONS: f64 = 1000.0;
const AMPLITUDE: f64 = 0.05;

fn derived(body: &FlexibleBody, degree: usize, masters: Masters) -> SpinManifold<'_> {
    let J = body.inertia();
    let angular_momentum = [0.0, 0.0, SPIN * J[2][2]];
    let plan = SpinManifoldPlan {
        mode: Mode::ShortAxis,
        angular_momentum,
        masters,
        degree,
        style: Style::NormalForm,
    };
    SpinManifold::derive(body, &plan, &mut |_| ControlFlow::Continue(())).expect("a nutation")
}

/// Points of three coordinates each, degree 5: 51, 99 and 300 coordinates.
#[divan::bench(args = [17, 33, 100], sample_count = 3)]
fn derive_degree_5(bencher: Bencher, points: usize) {
    let body = ring_of_points(points).body().expect("the ring has an equilibrium");
    bencher.bench(|| derived(&body, 5, Masters::Nutation));
}

/// The same with a second pair of masters.
#[divan::bench(args = [17, 33], sample_count = 3)]
fn derive_degree_5_two_pairs(bencher: Bencher, points: usize) {
    let body = ring_of_points(points).body().expect("the ring has an equilibrium");
    bencher.bench(|| derived(&body, 5, Masters::With(vec![0.0])));
}

/// Explorer 1 as it flew, 8 coordinates on curved paths.
#[divan::bench(args = [3, 5, 7, 9, 11], sample_count = 5)]
fn derive_explorer_1(bencher: Bencher, degree: usize) {
    let body = Explorer1::FLOWN.assembly().body().expect("the satellite");
    let spin = [0.0, 0.0, Explorer1::SPIN];
    let K =
        quasirigid::dynamics::FullState::at_rest(&body, spin, [1.0, 0.0, 0.0, 0.0]).angular_momentum(&body);
    let plan = SpinManifoldPlan {
        mode: Mode::LongAxis,
        angular_momentum: K,
        masters: Masters::Nutation,
        degree,
        style: Style::NormalForm,
    };
    bencher.bench(|| {
        SpinManifold::derive(&body, &plan, &mut |_| ControlFlow::Continue(())).expect("a nutation")
    });
}

/// Time (s) of the histories, and a start on the manifold.
fn history(manifold: &SpinManifold) -> ([f64; 2], ManifoldStart) {
    let end = REVOLUTIONS * std::f64::consts::TAU / SPIN;
    let state = manifold.full_state(&[[AMPLITUDE, 0.0]], [1.0, 0.0, 0.0, 0.0]);
    ([0.0, end], manifold.start(&state))
}

/// A history of 1000 revolutions by the reduced equations of degree 7: 4e-9 of the angular velocity of the wobble off.
#[divan::bench(args = [2, 17], sample_count = 10)]
fn history_reduced(bencher: Bencher, points: usize) {
    let body = ring_of_points(points).body().expect("the ring has an equilibrium");
    let manifold = derived(&body, 7, Masters::Nutation);
    let (times, start) = history(&manifold);
    let options = Options { tolerance: 1e-9, ..Options::default() };
    bencher.bench(|| {
        let mut samples: Vec<Sample> = Vec::new();
        propagate_on_manifold(&manifold, &start, &times, &options, &mut samples).expect("a history");
        samples
    });
}

/// The same by the full system, at a tolerance that leaves it 1e-8 off with 2 points and 4e-8 with 17.
#[divan::bench(args = [2, 17], sample_count = 3)]
fn history_full(bencher: Bencher, points: usize) {
    let body = ring_of_points(points).body().expect("the ring has an equilibrium");
    let manifold = derived(&body, 7, Masters::Nutation);
    let (times, start) = history(&manifold);
    let state = manifold.full_state(&start.z, start.attitude);
    let options = Options { tolerance: 1e-6, ..Options::default() };
    bencher.bench(|| {
        let mut samples: Vec<Sample> = Vec::new();
        propagate_full(Forced::not(&body), &state, &times, &options, &mut samples).expect("a history");
        samples
    });
}
