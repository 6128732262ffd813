//! Time of what a user asks of a body of many coordinates, beside a short history of the full system, with the exponent over the number of
//! coordinates: a carrier with 10 to 10⁴ sprung points. Arguments: the largest number of points, the largest of a history.
#![allow(missing_docs, clippy::print_stdout, non_snake_case)]

use std::time::Instant;

use quasirigid::dynamics::{Forced, FullState, Options, Sample, propagate_full};
use quasirigid::model::{FlexibleBody, Principal};
use quasirigid::modes::{ModeRange, RelativeEquilibrium, SpinMagnitude, SpinMode, SpinModes};
use quasirigid::problems::hub_of_points;
use quasirigid::reduction::{Validity, reduce};
use quasirigid::secular::{EnergyRange, Poles};

const POINTS: [usize; 7] = [10, 30, 100, 300, 1000, 3000, 10_000];
/// Points from which the exponent is fitted: bodies of fewer coordinates have dense matrices.
const FITTED: usize = 100;
const OMEGA: [f64; 3] = [0.1, 0.05, 0.5];
/// Length of the history (s).
const DURATION: f64 = 200.0;

fn main() {
    let given: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let (most, longest) = (given.first().copied().unwrap_or(10_000), given.get(1).copied().unwrap_or(1000));
    for (count, mass, axis) in [(60, 50.0, 2), (60, 50.0, 0), (60, 50.0, 1), (60, 4000.0, 2), (100, 50.0, 2)]
    {
        println!("{count} points of {mass} kg, axis {axis}: {}", compared(count, mass, axis));
    }
    println!("  points     modes     poles     check   history  (s)      modes found");
    let mut times: Vec<(usize, [f64; 3])> = Vec::new();
    for points in POINTS.into_iter().filter(|points| *points <= most) {
        let body = hub_of_points(points, 50.0).body().expect("the hub has an equilibrium");
        let (modes, found) = timed(|| modes(&body));
        let (poles, _) = timed(|| poles(&body));
        let (check, _) = timed(|| check(&body));
        let history = (points <= longest).then(|| timed(|| history(&body)).0);
        let told = match found.range {
            ModeRange::All => format!("all {}", found.modes.len()),
            ModeRange::Slowest(slow) => {
                format!("{} below {:.3} rad/s, missing {:?}", found.modes.len(), slow.rate, slow.missing)
            }
        };
        let history = history.map_or_else(|| "-".to_owned(), |time| format!("{time:.3}"));
        println!("{points:8} {modes:9.4} {poles:9.4} {check:9.4} {history:>9}           {told}");
        times.push((points, [modes, poles, check]));
    }
    for (place, name) in ["modes", "poles", "check"].iter().enumerate() {
        let fitted = times.iter().filter(|(points, _)| *points >= FITTED);
        let logs: Vec<[f64; 2]> = fitted.map(|(n, t)| [(*n as f64).ln(), t[place].ln()]).collect();
        println!("{name}: grows as n^{:.2}", slope(&logs));
    }
}

fn modes(body: &FlexibleBody) -> SpinModes {
    let spin = RelativeEquilibrium::near(body, [0.0, 0.0, 1.0], SpinMagnitude::Rate(0.5)).expect("a spin");
    SpinModes::about(body, spin).expect("its modes")
}

/// Largest relative difference of an eigenvalue, and of a decay rate, from those of the dense matrix.
fn compared(count: usize, mass: f64, axis: usize) -> String {
    let body = hub_of_points(count, mass).body().expect("the hub has an equilibrium");
    let axis = Principal::compute(body.invariants().J).axes[axis];
    let spin = RelativeEquilibrium::near(&body, axis, SpinMagnitude::Rate(0.5)).expect("a spin");
    let few = SpinModes::about(&body, spin.clone()).expect("the slowest modes");
    let all = SpinModes::all_about(&body, spin).expect("all modes");
    let (mut values, mut decays) = (0.0_f64, 0.0_f64);
    for mode in &few.modes {
        let gap =
            |other: &SpinMode| (mode.frequency - other.frequency).hypot(mode.decay_rate - other.decay_rate);
        let other = all.modes.iter().min_by(|a, b| gap(a).total_cmp(&gap(b))).expect("a mode");
        values = values.max(gap(other) / mode.frequency.hypot(mode.decay_rate));
        decays = decays.max((mode.decay_rate / other.decay_rate - 1.0).abs());
    }
    let ModeRange::Slowest(slow) = few.range else { return "every mode".to_owned() };
    let below = all.modes.iter().filter(|mode| mode.frequency.hypot(mode.decay_rate) < slow.rate).count();
    format!(
        "{} modes, {below} below {:.4}, missing {:?}, least energy {}; eigenvalues {values:.1e}, decay rates {decays:.1e}",
        few.modes.len(),
        slow.rate,
        slow.missing,
        slow.positive_energy
    )
}

/// What an evolution needs of the steady spins.
fn poles(body: &FlexibleBody) -> Poles {
    let range = EnergyRange::compute(body, 800.0).expect("a range");
    Poles::compute(body, &range).expect("its poles")
}

fn check(body: &FlexibleBody) -> Validity {
    let reduced = reduce(body, 3).expect("order 3");
    Validity::assess_reduced(body, &reduced, OMEGA).expect("a verdict")
}

fn history(body: &FlexibleBody) -> usize {
    let state = FullState::at_rest(body, OMEGA, [1.0, 0.0, 0.0, 0.0]);
    let mut samples: Vec<Sample> = Vec::new();
    let options = Options::default();
    propagate_full(Forced::not(body), &state, &[DURATION], &options, &mut samples).expect("a history");
    samples.len()
}

/// Seconds of some work, and its result.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let found = work();
    (start.elapsed().as_secs_f64(), found)
}

/// Slope of the line of least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    sum(&|p| (p[0] - x) * (p[1] - y)) / sum(&|p| (p[0] - x).powi(2))
}
