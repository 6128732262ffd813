//! Invariants and accounts of a propagation. (P1)–(P6)
#![allow(clippy::print_stdout)]

use std::f64::consts::TAU;

use proptest::prelude::*;
use quasirigid::dynamics::{Form, Options, Outcome, Sample, Start, propagate, spin_path};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::problems::AxialMass;
use quasirigid::reduction::{Vibrations, reduce};
use quasirigid_math::sym3::times;
use quasirigid_math::vec3::norm;

use super::wobbler::{attitude, inertial, reduced, times_to};
use crate::support::{bodies, cases, direction};

/// Start of every deterministic run (rad/s).
const START: [f64; 3] = [0.5, -0.3, 0.9];

fn run(body: &ReducedBody, times: &[f64], options: Options) -> Vec<Sample> {
    let mut samples = Vec::new();
    let initial = Start::new(START, attitude());
    let run = propagate(body, initial, times, &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    assert_eq!(samples.len(), times.len());
    samples
}

/// More steps than any run here needs: a diverging run ends.
fn at(tolerance: f64) -> Options {
    Options { tolerance, most_steps: 1_000_000, ..Options::default() }
}

/// Projection on `|K|` after each step leaves only the rounding of one projection there; samples inside a step are as good as the tolerance
/// of a step, which must be 1e-13 for thirteen digits. (P6)
#[test]
fn momentum_is_kept_through_ten_thousand_turns() {
    let body = reduced(3);
    // The body rotates more slowly as it loses energy.
    let times = times_to(1.1e4 * TAU / norm(START), 200);
    let G = norm(run(&body, &[0.0], at(1e-12))[0].angular_momentum);
    for tolerance in [1e-8, 1e-12, 1e-13] {
        let samples = run(&body, &times, at(tolerance));
        let last = samples[199];
        assert!(last.revolutions > 1e4);
        let change = |sample: &Sample| (norm(sample.angular_momentum) / G - 1.0).abs();
        let worst = samples.iter().map(change).fold(0.0, f64::max);
        println!(
            "tolerance {tolerance:e}, {:.0} turns: |K| within {worst:.1e}, {:.1e} at the end; projected away {:.1e}; \
             energy taken by dashpots {:.3e} J, made by the integrator {:.1e} J",
            last.revolutions,
            change(&last),
            last.momentum_drift,
            last.dissipated,
            last.energy_drift
        );
        assert!(worst < tolerance, "{worst:e}");
        // The last sample is the end of the last step.
        assert!(last.momentum_drift != 0.0 && last.momentum_drift.abs() < 1e3 * tolerance);
    }
}

/// The inertial angular momentum is a constant vector, (P3).
#[test]
fn inertial_momentum_keeps_its_direction() {
    let body = reduced(3);
    let samples = run(&body, &times_to(2e3, 150), at(1e-12));
    let K_N = inertial(attitude(), run(&body, &[0.0], at(1e-12))[0].angular_momentum);
    for sample in &samples {
        let K = inertial(sample.attitude, sample.angular_momentum);
        let gap = norm(std::array::from_fn(|i| K[i] - K_N[i])) / norm(K_N);
        assert!(gap < 1e-12, "t = {}: {gap:e}", sample.t);
        let length = sample.attitude.iter().map(|x| x * x).sum::<f64>();
        assert!((length - 1.0).abs() < 1e-14);
    }
}

/// The angle about the angular momentum is the one that no constant fixes. A steady spin about an axis of symmetry advances it at a
/// constant rate. (P3)
#[test]
fn a_steady_spin_turns_the_attitude_at_its_rate() {
    let problem = AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.3 };
    let body = reduce(&problem.assembly().body().unwrap(), 3).unwrap();
    let times = [1.0, 7.7, 40.0];
    let initial = Start::new([0.0, 0.0, 1.3], [1.0, 0.0, 0.0, 0.0]);
    let mut samples = Vec::new();
    propagate(&body, initial, &times, &at(1e-13), &mut samples).unwrap();
    for (t, sample) in times.iter().zip(&samples) {
        let (sin, cos) = (0.65 * t).sin_cos();
        let sign = (sample.attitude[0] * cos + sample.attitude[3] * sin).signum();
        for (found, expected) in sample.attitude.iter().zip([cos, 0.0, 0.0, sin]) {
            // Forty radians at 1e-13 per step.
            assert!((sign * found - expected).abs() < 1e-11, "{sample:?}");
        }
        assert!((sample.revolutions - 1.3 * t / TAU).abs() < 1e-12 * t);
    }
}

/// The integrator's error of the energy stays a thousandth of the energy that the dashpots take. (P4)
#[test]
fn numerical_drift_stays_below_the_physical_dissipation() {
    let body = reduced(3);
    let last = run(&body, &[2e3], at(1e-12))[0];
    assert!(last.dissipated > 0.0);
    assert!(last.energy_drift.abs() < 1e-3 * last.dissipated, "{last:?}");
}

/// A run of loose tolerance shows its error of the energy in the paper's equations, and the account closes: `E − E₀ = drift − dissipated`
/// up to the truncation of the series, which is a few `|ω|/Ω` of the dissipation. (P4)
#[test]
fn a_loose_tolerance_shows_in_the_account_of_energy() {
    let body = reduced(3);
    let start = run(&body, &[0.0], at(1e-12))[0].energy;
    let form = Form::AngularVelocity;
    let loose = run(&body, &[2e3], Options { form, ..at(1e-3) })[0];
    let tight = run(&body, &[2e3], Options { form, ..at(1e-12) })[0];
    assert!(loose.energy_drift.abs() > 1e3 * tight.energy_drift.abs(), "{loose:?} {tight:?}");
    assert!(loose.energy_drift.abs() > 1e-3 * tight.dissipated, "{loose:?}");
    for last in [loose, tight] {
        let left = last.energy - start - last.energy_drift + last.dissipated;
        assert!(left.abs() < 0.2 * last.dissipated, "{left:e} of {:e}", last.dissipated);
    }
}

/// The energy form keeps both laws at rounding, however loose the tolerance: the energy falls by what the dashpots took, and `|K|` stays.
/// (R16)
#[test]
fn the_energy_form_keeps_its_laws_at_any_tolerance() {
    let body = reduced(3);
    let first = run(&body, &[0.0], at(1e-12))[0];
    for tolerance in [1e-3, 1e-6, 1e-12] {
        for last in run(&body, &[1.7, 2e3], at(tolerance)) {
            let left = last.energy - first.energy + last.dissipated;
            assert!(
                left.abs() < 1e-14 * first.energy,
                "tolerance {tolerance:e}: {left:e} of {:e}",
                first.energy
            );
            let length = norm(last.angular_momentum) / norm(first.angular_momentum) - 1.0;
            assert!(length.abs() < 1e-14, "tolerance {tolerance:e}: {length:e}");
        }
    }
}

/// A rigid body has no dashpots: every change of its energy is the integrator's. (P4)
#[test]
fn a_rigid_body_keeps_its_energy() {
    let body = reduced(1);
    let start = run(&body, &[0.0], at(1e-12))[0].energy;
    for (tolerance, allowed) in [(1e-13, 1e-10), (1e-3, f64::INFINITY)] {
        for form in [Form::AngularMomentum, Form::AngularVelocity] {
            let last = run(&body, &[1e3], Options { form, ..at(tolerance) })[0];
            assert_eq!(last.dissipated, 0.0);
            let change = last.energy - start;
            assert!(change.abs() <= allowed * start, "{change:e}");
            // The rounding of two energies.
            assert!((last.energy_drift - change).abs() < 4e-15 * start, "{} {change}", last.energy_drift);
        }
    }
}

/// Output at a time inside a step is as accurate as a step that ends there.
#[test]
fn dense_output_is_where_a_step_would_have_ended() {
    let body = reduced(3);
    for form in [Form::AngularMomentum, Form::AngularVelocity] {
        let options = Options { form, ..at(1e-12) };
        let times = [3.1, 3.2, 17.0, 33.3, 50.0];
        let dense = run(&body, &times, options.clone());
        for (t, inside) in times.iter().zip(&dense) {
            let ended = run(&body, &[*t], options.clone())[0];
            for i in 0..3 {
                // Some fifty steps of 1e-12 each.
                assert!((inside.omega[i] - ended.omega[i]).abs() < 2e-10, "t = {t}");
            }
            for i in 0..4 {
                assert!((inside.attitude[i] - ended.attitude[i]).abs() < 2e-10, "t = {t}");
            }
            assert!((inside.energy - ended.energy).abs() < 2e-10 * ended.energy);
            assert!((inside.dissipated - ended.dissipated).abs() <= 1e-6 * ended.dissipated);
            assert!((inside.revolutions - ended.revolutions).abs() < 1e-9);
        }
    }
}

proptest! {
    #![proptest_config(cases(24))]

    /// The period of the rigid spin, from an elliptic integral and from the integrator. (V8)
    #[test]
    fn the_rigid_spin_returns_after_its_period(assembly in bodies(), u in direction()) {
        let body = reduce(&assembly.body().unwrap(), 1).unwrap();
        let omega = u.map(|x| x * Vibrations::compute(&assembly.body().unwrap()).unwrap().frequencies[0]);
        let polhode = Principal::compute(body.J).polhode(omega).unwrap();
        let period = TAU / polhode.frequency;
        let path = spin_path(&body, omega, &[0.5 * period, period], &at(1e-13)).unwrap();
        let gap = |i: usize| norm(std::array::from_fn(|k| path.omega[i][k] - omega[k])) / norm(omega);
        prop_assert!(gap(1) < 1e-8, "after a period {:e}, nome {}", gap(1), polhode.nome);
        // Unless the spin stays next to an axis, half a period takes it elsewhere.
        let K = times(body.J, omega);
        let moved = norm(quasirigid_math::vec3::cross(omega, K)) / (norm(omega) * norm(K));
        prop_assert!(gap(0) > 0.1 * moved, "after half a period {:e}", gap(0));
    }

    /// The fast method and the full one follow the same equations.
    #[test]
    fn spin_path_is_the_spin_of_propagate(assembly in bodies(), u in direction(), paper in any::<bool>()) {
        let body = assembly.body().unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let body = reduce(&body, 3).unwrap();
        let omega = u.map(|x| 0.05 * frequency * x);
        let times = times_to(100.0 / norm(omega), 7);
        let form = if paper { Form::AngularVelocity } else { Form::AngularMomentum };
        let options = Options { form, ..at(1e-13) };
        let path = spin_path(&body, omega, &times, &options).unwrap();
        let mut samples = Vec::new();
        let initial = Start::new(omega, attitude());
        propagate(&body, initial, &times, &options, &mut samples).unwrap();
        prop_assert_eq!(path.omega.len(), samples.len());
        for (fast, full) in path.omega.iter().zip(&samples) {
            let gap = norm(std::array::from_fn(|i| fast[i] - full.omega[i]));
            // A hundred radians at 1e-13 per step, grown by the shear of the polhodes.
            prop_assert!(gap < 1e-9 * norm(omega), "{gap:e}");
        }
    }

    /// The angular-momentum form keeps `|K|` at every order and any damping; the angular-velocity form does not, (P2).
    #[test]
    fn only_the_momentum_form_keeps_the_momentum(assembly in bodies(), u in direction(), p in 2..6usize) {
        let body = assembly.body().unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let body = reduce(&body, p).unwrap();
        let omega = u.map(|x| 0.1 * frequency * x);
        let end = [200.0 / norm(omega)];
        let initial = Start::new(omega, attitude());
        let last = |form: Form| {
            let mut samples = Vec::new();
            propagate(&body, initial, &end, &Options { form, ..at(1e-13) }, &mut samples).unwrap();
            samples[0].momentum_drift.abs()
        };
        prop_assert!(last(Form::AngularMomentum) < 1e-9, "{:e}", last(Form::AngularMomentum));
        prop_assert!(last(Form::AngularVelocity) > 10.0 * last(Form::AngularMomentum), "{:e}", last(Form::AngularVelocity));
    }
}
