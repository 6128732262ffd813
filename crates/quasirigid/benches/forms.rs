//! Cost of the energy form beside the paper's polynomial, per step and in lanes, in one run.
//!
//! What a step costs is the number of vectors of coefficients in its polynomials, printed first: (p + 3)(p + 4)(p + 5)/6 of the paper's torque to
//! degree p + 2. The energy form in full has `∇E` to degree p + 1, `c` to p − 1 and the two halves of `T` to 2p − 2 (2 at p = 3), which is most of
//! it; on the sphere of its angular momentum each of these of degree d has (d + 1)², `c` is a row beside `∇E`, and a half of `T` has 2d + 1: (P9)
//! and (P10), docs/theory/05-propagation.md.
#![allow(missing_docs, clippy::print_stdout)]

mod support;

use std::hint::black_box;

use quasirigid::dynamics::{Form, Options, SpinPath, spin_path, spin_paths};
use quasirigid::model::ReducedBody;
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;

use support::shortest;

/// Trajectories, and the time of each (s) at a spin of about one rad/s.
const TRAJECTORIES: usize = 256;
const END: f64 = 1000.0;
const REPEATS: usize = 7;
const ORDERS: [usize; 6] = [2, 3, 4, 5, 6, 7];

fn main() {
    println!("order | form | ns/step alone | us/s of motion in lanes");
    for order in ORDERS {
        let [paper, full, sphere] = coefficients(order);
        println!("{order} | coefficients | {paper} of the paper | {full} in full, {sphere} on a sphere");
        let body = reduce(&ring_of_points(4).body().expect("a body"), order).expect("a reduction");
        let costs = [Form::AngularVelocity, Form::AngularMomentum].map(|form| {
            let [step, lane] = cost(&body, form);
            println!("{order} | {form:?} | {step:.0} | {lane:.3}");
            [step, lane]
        });
        println!("{order} | ratio | {:.2} | {:.2}", costs[1][0] / costs[0][0], costs[1][1] / costs[0][1]);
    }
}

/// Vectors of coefficients of the paper's torque, of the energy form, and of that on a sphere.
fn coefficients(order: usize) -> [usize; 3] {
    let all = |degree: usize| (degree + 1) * (degree + 2) * (degree + 3) / 6;
    let on_sphere = |degree: usize| (degree + 1) * (degree + 1);
    let braking = if order > 3 { 2 * order - 2 } else { 2 * order - 4 };
    [
        all(order + 2),
        all(order + 1) + all(order - 1) + 2 * all(braking),
        on_sphere(order + 1) + on_sphere(braking) + 2 * braking + 1,
    ]
}

/// Nanoseconds of a step alone, and microseconds of a second of motion in lanes.
fn cost(body: &ReducedBody, form: Form) -> [f64; 2] {
    let options = Options { form, tolerance: 1e-11, ..Options::default() };
    let starts: Vec<[f64; 3]> = (0..TRAJECTORIES)
        .map(|i| [0.7, 0.5, 0.6].map(|w| w * (1.0 + 0.01 * (3.0 * i as f64).sin())))
        .collect();
    let alone = || spin_path(body, black_box(starts[0]), &[END], &options).expect("a free spin");
    let steps = alone().work.steps as f64;
    let together = || -> Vec<SpinPath> {
        let paths = spin_paths(body, black_box(&starts), &[END], &options, &mut |_| true);
        paths.into_iter().map(|path| path.expect("a free spin")).collect()
    };
    [1e9 * shortest(REPEATS, alone) / steps, 1e6 * shortest(REPEATS, together) / (TRAJECTORIES as f64 * END)]
}
