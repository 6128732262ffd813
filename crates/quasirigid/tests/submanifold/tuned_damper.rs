//! Tuned damper: the damper and the nutation exchange their energy, and no average holds.

use std::ops::ControlFlow;

use quasirigid::dynamics::{Forced, FullState, Options, Sample, propagate_full};
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::prelude::{Assembly, CARRIER, Carrier, Point, Spring};
use quasirigid::secular::{DirectOptions, DirectRun, DirectStopReason, follow_directly, follow_on_manifold};
use quasirigid::submanifold::{Masters, SpinManifold, SpinManifoldPlan, Style, propagate_on_manifold};
use quasirigid_math::rotation::ALIGNED;

use super::derived;

/// Satellite with 0.1 kg on a spring along its axis of spin, tuned to the frequency of its nutation at 60 rpm.
fn satellite(damping_ratio: f64) -> FlexibleBody {
    let (mass, stiffness) = (0.1_f64, 0.789);
    let damping = 2.0 * damping_ratio * (mass * stiffness).sqrt();
    let mut satellite = Assembly::default().with(Carrier::principal(100.0, [10.0, 12.0, 16.0]));
    let damper = satellite.add(Point::new("damper", mass, [0.4, 0.0, 0.2]).along([0.0, 0.0, 1.0]));
    satellite.add(Spring::isotropic(stiffness, damping).between(damper, CARRIER));
    satellite.body().unwrap()
}

/// Time at which the energy above that of the steady spin (J) has fallen to a value.
fn time(manifold: &SpinManifold, samples: &[Sample], target: f64) -> f64 {
    let excess = |sample: &Sample| sample.energy - manifold.steady_energy();
    let after = samples.iter().position(|sample| excess(sample) <= target).unwrap();
    let (before, after) = (&samples[after - 1], &samples[after]);
    let part = (excess(before) - target) / (excess(before) - excess(after));
    before.t + part * (after.t - before.t)
}

/// From damping ratios at which the energy beats between both to those at which the damper creeps, and wobbles to 10°: the damper at rest
/// at the start, every time within 1 %.
#[test]
fn every_time_is_that_of_the_full_system() {
    let mut worst: f64 = 0.0;
    for damping_ratio in [0.003, 0.01, 0.03, 0.1, 0.3, 1.0] {
        let body = satellite(damping_ratio);
        for wobble in [2.0_f64, 5.0, 10.0] {
            let (sine, cosine) = (wobble.to_radians().sin(), wobble.to_radians().cos());
            let rate = std::f64::consts::TAU;
            let omega = [rate * sine * 1.6 * 0.8, rate * sine * 16.0 / 12.0 * 0.6, rate * cosine];
            let full = FullState::at_rest(&body, omega, ALIGNED);
            let angular_momentum = full.angular_momentum(&body);
            let (mode, masters, style) = (Mode::ShortAxis, Masters::Automatic, Style::NormalForm);
            let plan = SpinManifoldPlan { mode, angular_momentum, masters, degree: 9, style };
            let manifold = derived(&body, &plan);
            let start = manifold.start(&full);
            let times: Vec<f64> = (0..=12_000).map(|i| 0.1 * f64::from(i)).collect();
            let options = Options { tolerance: 1e-10, ..Options::default() };
            let (mut whole, mut reduced): (Vec<Sample>, Vec<Sample>) = Default::default();
            propagate_full(Forced::not(&body), &full, &times, &options, &mut whole).unwrap();
            let run = propagate_on_manifold(&manifold, &start, &times, &options, &mut reduced).unwrap();
            for share in [0.9, 0.5, 0.1, 0.01, 0.001] {
                let target = share * (full.energy(&body) - manifold.steady_energy());
                let [full, reduced] = [&whole, &reduced].map(|samples| time(&manifold, samples, target));
                let gap = (reduced / full - 1.0).abs();
                assert!(
                    gap < 0.01,
                    "ratio {damping_ratio}, {wobble} degrees, {share}: {reduced} s for {full}"
                );
                worst = worst.max(gap);
            }
            assert!(run.worst.0.largest() < 0.01, "{:?}", run.worst);
        }
    }
    println!("largest difference of a time: {worst:.1e}");
}

/// The time in which the wobble dies to a tenth of its energy, and the mean power on the way, by the equations about the spin and by the full
/// system. (Q10), (Q20)
#[test]
fn a_history_on_the_manifold_ends_when_that_of_the_full_system_does() {
    let body = satellite(0.1);
    let rate = std::f64::consts::TAU;
    let start = FullState::at_rest(&body, [0.05 * rate, 0.08 * rate, rate], ALIGNED);
    let (mode, masters, style) = (Mode::ShortAxis, Masters::Nutation, Style::NormalForm);
    let plan =
        SpinManifoldPlan { mode, angular_momentum: start.angular_momentum(&body), masters, degree: 3, style };
    let manifold = derived(&body, &plan);
    let steady = manifold.steady_energy();
    let options = DirectOptions {
        until: Some(steady + 0.1 * (start.energy(&body) - steady)),
        duration: f64::MAX,
        most_revolutions: 1e5,
        most_steps: 50_000_000,
        tolerance: 1e-10,
    };
    let go_on = &mut |_: f64| ControlFlow::Continue(());
    let found = follow_on_manifold(&body, mode, &start, &options, go_on).unwrap().unwrap();
    let direct = follow_directly(&body, &start, &options, go_on).unwrap();
    assert_eq!((&found.run.ending, &direct.ending), (&DirectStopReason::Reached, &DirectStopReason::Reached));
    let [time, expected] = [&found.run, &direct].map(|run| run.rows.last().unwrap().t);
    assert!((time / expected - 1.0).abs() < 0.02, "{time} s, the full system {expected} s");
    let period = std::f64::consts::TAU / manifold.backbone_point(0.05).frequency;
    for share in [0.2, 0.5, 0.8] {
        let power = |run: &DirectRun| {
            run.mean_power(run.rows.partition_point(|row| row.t < share * expected), period)
        };
        let ratio = power(&found.run) / power(&direct);
        assert!(
            (ratio - 1.0).abs() < 0.03,
            "power at {share} of the time: {ratio} of that of the full system"
        );
    }
}

/// An amplitude has a mean energy, and the energy its amplitude; energies beyond the range have none.
#[test]
fn an_energy_has_its_amplitude_within_the_range() {
    let body = satellite(0.1);
    let rate = std::f64::consts::TAU;
    let start = FullState::at_rest(&body, [0.05 * rate, 0.08 * rate, rate], ALIGNED);
    let plan = SpinManifoldPlan {
        mode: Mode::ShortAxis,
        angular_momentum: start.angular_momentum(&body),
        masters: Masters::Nutation,
        degree: 3,
        style: Style::NormalForm,
    };
    let manifold = derived(&body, &plan);
    let (least, most) = (manifold.steady_energy(), manifold.power_at(0.1).energy);
    for amplitude in [0.02, 0.07] {
        let energy = manifold.power_at(amplitude).energy;
        let found = manifold.amplitude_at(energy, 0.1).unwrap();
        assert!((found / amplitude - 1.0).abs() < 1e-6, "{found} {amplitude}");
    }
    for outside in [least - 0.2 * (most - least), least + 1.2 * (most - least)] {
        assert_eq!(manifold.amplitude_at(outside, 0.1), None);
    }
}
