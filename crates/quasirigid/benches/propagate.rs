//! Speed of the reduced equations: one right-hand side, and a propagation at a known error.
#![allow(non_snake_case, missing_docs, clippy::print_stdout)]

use std::hint::black_box;

use divan::Bencher;
use divan::counter::ItemsCount;
use quasirigid::dynamics::{Form, Options, Sample, Start, propagate, spin_path};
use quasirigid::model::Kinetics;
use quasirigid::problems::{QuarticQuintic, ring_of_points};
use quasirigid_math::polynomial::{Kernel, Series};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::simd::{Arithmetic, Rounding, Task, dispatch};
use quasirigid_math::vec3::cross;

fn main() {
    let problem = QuarticQuintic::published();
    for tolerance in TOLERANCES {
        let (error, steps) = error(&problem, tolerance);
        println!("tolerance {tolerance:7.0e}: error {error:.1e} after 1000 s, {steps} steps");
    }
    divan::main();
}

const TOLERANCES: [f64; 6] = [1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];
const EVALUATIONS: usize = 100_000;

/// Largest error of the spin over the reference times.
fn error(problem: &QuarticQuintic, tolerance: f64) -> (f64, u64) {
    let times: Vec<f64> = problem.reference.iter().map(|(t, _)| *t).collect();
    let options = Options { form: Form::AngularVelocity, tolerance, ..Options::default() };
    let path = spin_path(&problem.body, problem.omega, &times, &options).expect("a published problem runs");
    let errors = path
        .omega
        .iter()
        .zip(&problem.reference)
        .flat_map(|(found, (_, expected))| (0..3).map(move |axis| (found[axis] - expected[axis]).abs()));
    (errors.fold(0.0, f64::max), path.work.steps)
}

/// Items are seconds of motion.
#[divan::bench(args = TOLERANCES)]
fn quartic_quintic_1000_s(bencher: Bencher, tolerance: f64) {
    let problem = QuarticQuintic::published();
    let options = Options { form: Form::AngularVelocity, tolerance, ..Options::default() };
    bencher
        .counter(ItemsCount::new(1000_usize))
        .bench(|| spin_path(&problem.body, black_box(problem.omega), &[1000.0], &options));
}

/// Propagation with attitude, accounts and projection on the invariants. Items are seconds of motion.
#[divan::bench]
fn with_attitude_and_accounts_1000_s(bencher: Bencher) {
    let problem = QuarticQuintic::published();
    let options = Options { form: Form::AngularVelocity, ..Options::default() };
    let start = Start::new(problem.omega, ALIGNED);
    bencher.counter(ItemsCount::new(1000_usize)).bench(|| {
        let mut samples: Vec<Sample> = Vec::new();
        propagate(&problem.body, black_box(start), &[1000.0], &options, &mut samples)
    });
}

/// Many right-hand sides, each waiting for the one before.
struct Chain<'a> {
    kernel: &'a Kernel,
    angular_momentum: bool,
}

impl Task for Chain<'_> {
    type Output = [f64; 3];

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> [f64; 3] {
        let mut x = black_box([0.3, 1.5, 0.2]);
        for _ in 0..EVALUATIONS {
            let [a, b, c, _] = self.kernel.value::<A>(x);
            let rate = if self.angular_momentum { cross(x, [a, b, c]) } else { [a, b, c] };
            x = std::array::from_fn(|i| x[i] + 1e-9 * rate[i]);
        }
        x
    }
}

fn dense(degrees: &[usize]) -> Kernel {
    let mut map = Series::zero(degrees[degrees.len() - 1], 3);
    for &degree in degrees {
        let mut part = map.part(degree).clone();
        part.coefficients_mut().flatten().enumerate().for_each(|(i, c)| *c = 1e-3 * (i as f64).sin());
        map.set(part);
    }
    Kernel::new(&map)
}

/// Items are right-hand sides `f₂ + f₄ + f₅`.
#[divan::bench]
fn right_hand_side_of_the_papers_form(bencher: Bencher) {
    let kernel = dense(&[2, 4, 5]);
    bencher
        .counter(ItemsCount::new(EVALUATIONS))
        .bench(|| dispatch(Rounding::Fastest, Chain { kernel: &kernel, angular_momentum: false }));
}

/// Items are right-hand sides `K × (Ω₁ + Ω₃ + Ω₄)`.
#[divan::bench]
fn right_hand_side_of_the_momentum_form(bencher: Bencher) {
    let kernel = dense(&[1, 3, 4]);
    bencher
        .counter(ItemsCount::new(EVALUATIONS))
        .bench(|| dispatch(Rounding::Fastest, Chain { kernel: &kernel, angular_momentum: true }));
}

/// Rates of the full system: velocities from momenta, and loads. Items are coordinates, whose mass matrix falls into blocks.
#[divan::bench(args = [10, 100, 333, 3333])]
fn full_rates_of_sprung_points(bencher: Bencher, count: usize) {
    let body = ring_of_points(count).body().expect("the ring has an equilibrium");
    let n = body.coordinates().len();
    let mut kinetics = Kinetics::new(&body).expect("its mass matrix is positive");
    let wave = |scale: f64| -> Vec<f64> { (0..n).map(|i| scale * (0.7 * i as f64).sin()).collect() };
    let (q, p, mut rate, mut load) = (wave(1e-3), wave(1e-2), vec![0.0; n], vec![0.0; n]);
    bencher.counter(ItemsCount::new(n)).bench_local(|| {
        load.fill(0.0);
        let velocities = kinetics.velocities(black_box([1.0, 2.0, 3.0]), &p, &q, &mut rate);
        velocities.add_loads(&q, &rate, &mut load)
    });
}
