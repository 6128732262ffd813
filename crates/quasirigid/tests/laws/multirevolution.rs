//! Motions followed in leaps over whole revolutions end where those followed step by step end, and lose no digits over many of them.
//! (P9)–(P12)

use std::f64::consts::TAU;

use proptest::prelude::*;
use quasirigid::averaging::{Evolution, PolynomialPower};
use quasirigid::dynamics::{Event, Observer, Options, Outcome, Run, Sample, Start, propagate};
use quasirigid::elements::{Assembly, Wheel, WheelSpeed};
use quasirigid::model::{Principal, ReducedBody, Support};
use quasirigid::problems::AxialMass;
use quasirigid::reduction::{Vibrations, reduce};
use quasirigid_math::rotation::angle_between;
use quasirigid_math::vec3::{add, cross, norm, scale};

use super::wobbler::{assembly, attitude, inertial, reduced, times_to};
use crate::support::rotors::{ball, flywheel};
use crate::support::{assemblies, cases, direction, transform::rescaled, units};

/// Samples, and the energy of each dissipator.
#[derive(Default)]
struct Kept {
    samples: Vec<Sample>,
    budget: Vec<(String, f64)>,
}

impl Observer for Kept {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }
}

fn followed(body: &ReducedBody, omega: [f64; 3], times: &[f64], options: &Options) -> (Run, Kept) {
    let mut kept = Kept::default();
    let run = propagate(body, Start::new(omega, attitude()), times, options, &mut kept).unwrap();
    (run, kept)
}

/// Steps that are as good as they can be.
fn step_by_step() -> Options {
    Options { leaps: false, tolerance: 1e-14, ..Options::default() }
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(add(a, scale(-1.0, b))) / norm(b)
}

/// Follows a body both ways and compares everything that a sample tells; `phase` is the error (rad) that the steps themselves have.
#[track_caller]
fn assert_same(body: &ReducedBody, omega: [f64; 3], times: &[f64], phase: f64) {
    let (in_leaps, leaping) = followed(body, omega, times, &Options::default());
    let (in_steps, stepping) = followed(body, omega, times, &step_by_step());
    assert_eq!((in_leaps.outcome, in_steps.outcome), (Outcome::Finished, Outcome::Finished));
    assert!(in_leaps.work.leaped > 0 && in_steps.work.leaped == 0, "{in_leaps:?}");
    for (found, expected) in leaping.samples.iter().zip(&stepping.samples) {
        let off = [
            gap(found.angular_momentum, expected.angular_momentum),
            gap(found.omega, expected.omega),
            angle_between(found.attitude, expected.attitude),
        ];
        assert!(off.iter().all(|off| *off < phase), "t = {}: {off:?}", found.t);
        let drift = found.energy_drift.abs() + expected.energy_drift.abs() + 1e-15 * expected.energy;
        assert!((found.energy - expected.energy).abs() < 4.0 * drift, "{found:?} {expected:?}");
        assert!(
            (found.dissipated - expected.dissipated).abs() <= 1e-8 * expected.dissipated,
            "{found:?} {expected:?}"
        );
        assert!((found.revolutions - expected.revolutions).abs() <= 1e-9 * expected.revolutions);
        assert!(found.energy_drift.abs() < 1e-12 * expected.energy, "{found:?}");
    }
    assert_eq!(leaping.samples.len(), times.len());
    for ((name, found), (other, expected)) in leaping.budget.iter().zip(&stepping.budget) {
        let whole = in_steps.last.dissipated;
        assert!(name == other && (found - expected).abs() < 1e-5 * whole, "{name}: {found:e} {expected:e}");
    }
    assert_eq!(leaping.budget.len(), stepping.budget.len());
}

#[test]
fn leaps_end_where_steps_do() {
    let body = reduced(3);
    let times = [0.0, 3.0, 3e5, 6e5];
    assert_same(&body, [0.11, 0.02, 0.05], &times, 1e-6);
    assert_same(&body, [-0.02, 0.03, -0.12], &times, 1e-6);
    assert_same(&reduced(5), [0.02, 0.03, 0.12], &times, 1e-6);
}

/// From a rotation about the long axis through the separatrix to one about the short axis, which settles.
#[test]
fn leaps_pass_the_separatrix() {
    let body = reduced(3);
    let (omega, times) = ([0.95, 0.05, 0.34], times_to(2.4e5, 6));
    assert_same(&body, omega, &times, 1e-4);
    let (run, _) = followed(&body, omega, &[times[5]], &Options::default());
    let above = |K: f64, energy: f64| K * K / (2.0 * energy * Principal::compute(body.J).moments[1]);
    let G = norm(run.last.angular_momentum);
    let first = followed(&body, omega, &[0.0], &Options::default()).0.last;
    assert!(
        above(G, first.energy) < 0.99 && above(G, run.last.energy) > 1.01 && run.work.leaped > 1000,
        "{run:?}"
    );
}

/// Rotors that slip, a momentum wheel, and a body of revolution, which has no separatrix but a family of steady spins across its axis.
#[test]
fn rotors_wheels_and_bodies_of_revolution_leap() {
    let with = |change: &dyn Fn(&mut Assembly)| {
        let mut assembly = assembly();
        change(&mut assembly);
        reduce(&assembly.body().unwrap(), 3).unwrap()
    };
    let times = [3e5, 6e5];
    let rotors =
        with(&|assembly| assembly.rotors = vec![flywheel([0.6, 0.0, 0.8], 0.02, 3.0), ball(0.05, 4.0)]);
    assert_same(&rotors, [0.03, 0.02, 0.1], &times, 1e-6);
    let wheel = Wheel {
        name: "wheel".into(),
        axis: [0.0, 0.6, 0.8],
        speed: WheelSpeed::Constant { angular_momentum: 0.03 },
    };
    let wheels = with(&|assembly| assembly.wheels = vec![wheel.clone()]);
    assert_same(&wheels, [0.03, 0.02, 0.1], &times, 1e-6);
    let of_revolution = AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 3.0 };
    let of_revolution = reduce(&of_revolution.assembly().body().unwrap(), 3).unwrap();
    assert_same(&of_revolution, [0.3, 0.0, 0.4], &times, 1e-6);
}

/// A thousand million revolutions: `|K|` to rounding, the energy to 1e-10 of what the dashpots took, and fewer steps than revolutions by far.
#[test]
fn a_billion_revolutions_leave_no_drift() {
    let body = reduced(3);
    let omega = [0.003, 0.002, 0.01];
    let times = times_to(1e9 * TAU / norm(omega), 50);
    let (run, kept) = followed(&body, omega, &times, &Options::default());
    let before = followed(&body, omega, &[0.0], &Options::default()).1.samples[0];
    let (G, K_N) = (norm(before.angular_momentum), inertial(attitude(), before.angular_momentum));
    for sample in &kept.samples {
        assert!((norm(sample.angular_momentum) / G - 1.0).abs() < 1e-14, "{sample:?}");
        assert!(gap(inertial(sample.attitude, sample.angular_momentum), K_N) < 1e-13);
        assert!(sample.energy_drift.abs() < 1e-10 * sample.dissipated, "{sample:?}");
    }
    // the rest is the truncation of the series, (R10)
    let lost = before.energy - run.last.energy;
    assert!((lost / run.last.dissipated - 1.0).abs() < 1e-3, "{lost:e} {run:?}");
    assert!(run.last.revolutions > 9e8 && run.work.leaped > 100_000_000, "{run:?}");
    assert!(run.work.steps < 1_000_000, "{run:?}");
}

/// A wobble that dies out about an axis that is none of the body's own: the digits of ever smaller angles last, and so do the leaps.
#[test]
fn dying_wobbles_leap_to_the_end() {
    let body = reduced(3);
    let omega = [0.02, 0.01, 0.05];
    let times = times_to(1e9 * TAU / norm(omega), 20);
    let (run, kept) = followed(&body, omega, &times, &Options::default());
    let axis = Principal::compute(body.J).axes[2];
    let wobble = |sample: &Sample| norm(cross(sample.angular_momentum, axis)) / norm(sample.angular_momentum);
    let [start, end] = [&kept.samples[0], &run.last].map(wobble);
    assert!(start > 0.05 && end < 1e-3, "{start} {end}");
    assert!(run.work.leaped > 100_000_000 && run.work.steps < 300_000, "{run:?}");
    assert!(run.last.energy_drift.abs() < 1e-12 * run.last.dissipated, "{run:?}");
}

/// Where outputs lie, and that a motion was begun anew on the way, changes only the rounding of its phase.
#[test]
fn outputs_and_starts_on_the_way_change_nothing() {
    let body = reduced(3);
    let (omega, end) = ([0.02, 0.03, 0.12], 4e6);
    let last = |omega, attitude, times: &[f64]| {
        let mut samples = Vec::new();
        let run =
            propagate(&body, Start::new(omega, attitude), times, &Options::default(), &mut samples).unwrap();
        assert!(run.work.leaped > 0);
        run.last
    };
    let whole = last(omega, attitude(), &[end]);
    let many = last(omega, attitude(), &times_to(end, 40));
    let half = last(omega, attitude(), &[0.37 * end]);
    let rest = last(half.omega, half.attitude, &[0.63 * end]);
    for other in [many, rest] {
        assert!(gap(other.angular_momentum, whole.angular_momentum) < 1e-7, "{other:?} {whole:?}");
        assert!(angle_between(other.attitude, whole.attitude) < 1e-7);
        assert!((other.energy / whole.energy - 1.0).abs() < 1e-14);
    }
    assert!((many.dissipated / whole.dissipated - 1.0).abs() < 1e-12);
    assert!(((half.dissipated + rest.dissipated) / whole.dissipated - 1.0).abs() < 1e-10);
    assert!(((half.revolutions + rest.revolutions) / whole.revolutions - 1.0).abs() < 1e-12);
}

/// Events end a motion in the revolution in which they happen: energies, angles that swing within a revolution, and several at once.
#[test]
fn events_are_not_leaped_over() {
    let body = reduced(3);
    let omega = [0.15, 0.1, 0.4];
    let whole = followed(&body, omega, &[0.0, 2e5], &Options::default()).1.samples;
    let axis = Principal::compute(body.J).axes[2];
    let energy = |share: f64| Event::Energy(whole[0].energy + share * (whole[1].energy - whole[0].energy));
    let angle = |angle: f64| Event::Nutation { axis, angle };
    let least = |t: f64| {
        let (from, to) = (t, t + 60.0);
        let times: Vec<f64> = (0..2000).map(|i| from + (to - from) * f64::from(i) / 2000.0).collect();
        let samples = followed(&body, omega, &times, &Options::default()).1.samples;
        let angles =
            samples.iter().map(|sample| quasirigid_math::rotation::angle(sample.angular_momentum, axis));
        angles.fold(f64::INFINITY, f64::min)
    };
    // touched once a revolution, for the first time about 30 000 s; steps may miss the first touches
    let narrow = angle(least(3e4));
    for (events, error) in [
        (vec![energy(0.5)], 1e-4),
        (vec![energy(1e-4)], 1e-4),
        (vec![narrow], 1e3),
        (vec![energy(0.9), narrow, angle(3.0)], 1e3),
    ] {
        let ended = |leaps: bool| {
            let options = Options { events: events.clone(), leaps, tolerance: 1e-14, ..Options::default() };
            followed(&body, omega, &[2e5, 4e5], &options).0
        };
        let [found, expected] = [ended(true), ended(false)];
        assert_eq!(found.outcome, expected.outcome);
        assert!(matches!(found.outcome, Outcome::Event(_)), "{found:?}");
        assert!((found.last.t - expected.last.t).abs() < error, "{events:?}: {found:?} {expected:?}");
        assert!(found.work.steps < expected.work.steps || found.last.t < 1e3, "{found:?}");
    }
}

/// A spin without a wobble stays, about the stable axis and about the unstable one.
#[test]
fn steady_spins_stay() {
    let body = reduced(3);
    for spin in quasirigid::dynamics::steady_spins(&body, 0.2).into_iter().flatten() {
        let (run, kept) = followed(&body, spin.omega, &[1e3, 1e9], &Options::default());
        if spin.frequency > 0.0 {
            assert!(gap(kept.samples[1].omega, spin.omega) < 1e-9, "{run:?}");
            assert!(run.work.steps < 100_000, "{run:?}");
        }
    }
}

/// The time to an energy by the average, a road of its own, is that of the motion but for the square of spin over elastic frequency.
#[test]
fn times_are_those_of_the_average() {
    let body = reduced(3);
    let Principal { moments, axes } = Principal::compute(body.J);
    let power = PolynomialPower::from_reduced(&body);
    for spin in [0.02, 0.04] {
        let omega = add(scale(0.6 * spin, axes[0]), scale(0.8 * spin, axes[2]));
        let start = followed(&body, omega, &[0.0], &Options::default()).1.samples[0];
        let G = norm(start.angular_momentum);
        let evolution = Evolution::new(power.clone(), G);
        let ratio = |energy: f64| G * G / (2.0 * energy * moments[2]);
        let [from, to] =
            [start.energy, 0.98 * start.energy].map(|energy| evolution.stage(ratio(energy)).unwrap());
        let expected = evolution.time(from, to);
        let events = vec![Event::Energy(0.98 * start.energy)];
        let run = followed(&body, omega, &[3.0 * expected], &Options { events, ..Options::default() }).0;
        assert!(matches!(run.outcome, Outcome::Event(_)) && run.work.leaped > 0, "{run:?}");
        let off = (run.last.t / expected - 1.0).abs();
        assert!(off < 100.0 * (spin / 13.0f64).powi(2), "{spin}: {off:e}");
    }
}

proptest! {
    #![proptest_config(cases(10))]

    /// Any body, in any units, about any axis.
    #[test]
    fn any_body_leaps(assembly in assemblies(), units in units(), u in direction()) {
        let assembly = Assembly { support: Support::Free, ..assembly };
        let body = rescaled(&assembly, units).body().unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let omega = u.map(|x| 0.02 * frequency * x);
        let body = reduce(&body, 3).unwrap();
        let end = 2.0e4 * TAU / norm(omega);
        let (run, kept) = followed(&body, omega, &[0.5 * end, end], &Options::default());
        let (direct, steps) = followed(&body, omega, &[0.5 * end, end], &step_by_step());
        prop_assert_eq!(run.outcome, direct.outcome);
        for (found, expected) in kept.samples.iter().zip(&steps.samples) {
            let drift = expected.energy_drift.abs() + 1e-13 * expected.energy;
            prop_assert!((found.energy - expected.energy).abs() < 10.0 * drift, "{:?} {:?}", found, expected);
            prop_assert!((found.dissipated / expected.dissipated - 1.0).abs() < 1e-5, "{:?} {:?}", found, expected);
            prop_assert!(gap(found.angular_momentum, expected.angular_momentum) < 1e-3, "{:?} {:?}", found, expected);
        }
    }
}
