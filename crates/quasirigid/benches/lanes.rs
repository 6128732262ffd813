//! Speed of ensembles of the dense quartic and quintic equation in lanes, at a known error: `benchmarks/lanes` runs it beside other programs.
#![allow(missing_docs, clippy::print_stdout)]

mod support;

use std::hint::black_box;

use quasirigid::dynamics::{Form, Options, Rounding, SpinPath, spin_path, spin_paths};
use quasirigid::problems::QuarticQuintic;

use support::shortest;

const TRAJECTORIES: usize = 256;
/// Time of each trajectory (s).
const END: f64 = 1000.0;
const REPEATS: usize = 9;

fn main() {
    let problem = QuarticQuintic::published();
    let starts: Vec<[f64; 3]> = (0..TRAJECTORIES)
        .map(|i| {
            std::array::from_fn(|axis| problem.omega[axis] * (1.0 + 0.01 * ((3 * i + axis) as f64).sin()))
        })
        .collect();
    let at = |tolerance, rounding| Options {
        form: Form::AngularVelocity,
        tolerance,
        rounding,
        ..Options::default()
    };
    let all = |options: &Options| -> Vec<SpinPath> {
        let paths = spin_paths(&problem.body, black_box(&starts), &[END], options, &mut |_| true);
        paths.into_iter().map(|path| path.expect("a published problem runs")).collect()
    };
    let exact = all(&at(1e-15, Rounding::Fastest));
    for (name, rounding) in [("lanes", Rounding::Fastest), ("lanes, reproducible", Rounding::Reproducible)] {
        for tolerance in [1e-9, 1e-10, 2e-11, 1e-11, 1e-12, 1e-13] {
            let options = at(tolerance, rounding);
            report(name, tolerance, error(&all(&options), &exact), shortest(REPEATS, || all(&options)));
        }
    }
    let options = at(1e-11, Rounding::Fastest);
    let alone = || -> Vec<SpinPath> {
        starts.iter().filter_map(|omega| spin_path(&problem.body, *omega, &[END], &options).ok()).collect()
    };
    report("one by one", 1e-11, error(&alone(), &exact), shortest(REPEATS, alone));
}

/// Largest error of a component at the end (rad/s).
fn error(found: &[SpinPath], exact: &[SpinPath]) -> f64 {
    let gaps = found
        .iter()
        .zip(exact)
        .flat_map(|(a, b)| (0..3).map(move |axis| (a.omega[0][axis] - b.omega[0][axis]).abs()));
    gaps.fold(0.0, f64::max)
}

fn report(name: &str, tolerance: f64, error: f64, seconds: f64) {
    let each = 1e6 * seconds / (TRAJECTORIES as f64 * END);
    println!("{name} | {tolerance:.0e} | {error:.1e} | {each:.3}");
}
