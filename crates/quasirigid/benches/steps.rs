//! Cost of one step under a torque that changes with each, as a hardware loop makes it: reduced equations, and the full system with three,
//! ten and thirty coordinates.
#![allow(missing_docs)]

use std::hint::black_box;

use divan::Bencher;
use quasirigid::dynamics::{Forced, FullState, FullStepper, Options, ReducedStepper, Start};
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::ALIGNED;

fn main() {
    divan::main();
}

const SPIN: [f64; 3] = [0.05, 0.02, 0.4];
const STEP: f64 = 0.01;

/// A torque that is not that of the step before.
fn torque(number: &mut u32) -> [f64; 3] {
    *number = number.wrapping_add(1);
    let sign = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
    [sign * 1e-3, 2e-3, -sign * 1e-3]
}

#[divan::bench(args = [1, 3, 5])]
fn reduced_of_order(bencher: Bencher, order: usize) {
    let body = ring_of_points(10).body().expect("the ring has an equilibrium");
    let reduced = reduce(&body, order).expect("springs hold it");
    let mut stepper =
        ReducedStepper::new(&reduced, Start::new(SPIN, ALIGNED), 1e-10).expect("the start is one");
    let mut number = 0;
    bencher.bench_local(|| stepper.step(black_box(torque(&mut number)), STEP));
}

#[divan::bench(args = [1, 3, 10])]
fn full_of_points(bencher: Bencher, points: usize) {
    let body = ring_of_points(points).body().expect("the ring has an equilibrium");
    let start = FullState::at_rest(&body, SPIN, ALIGNED);
    let options = Options { tolerance: 1e-10, ..Options::default() };
    let mut stepper = FullStepper::new(Forced::not(&body), &start, options).expect("the start is one");
    let mut number = 0;
    bencher.bench_local(|| stepper.step(black_box(torque(&mut number)), STEP));
}
