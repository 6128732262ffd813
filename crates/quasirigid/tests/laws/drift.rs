//! Slow external torques: energy and angular momentum drift together.

use std::ops::ControlFlow;

use quasirigid::averaging::{
    Drift, DriftHistory, DriftLimits, DriftState, DriftStopReason, Evolution, FreeRotation, MeanPower,
    PolynomialPower, RotationState, SlowTorque,
};
use quasirigid::dynamics::{Forced, Options, SlowEquations, SlowState, propagate_forced};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{Mode, Principal};
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::norm;

use super::evolution::tumbler;
use crate::support::parts;

/// Drift to the last of some times, without an interruption.
fn followed(drift: &Drift<impl MeanPower>, start: DriftState, times: &[f64]) -> DriftHistory {
    drift.follow(start, times, &DriftLimits::until(times[times.len() - 1]), |_| ControlFlow::Continue(()))
}

fn start(rotation_state: RotationState, angular_momentum: f64) -> DriftState {
    DriftState {
        t: 0.0,
        rotation_state,
        angular_momentum,
        side: 1.0,
        direction: [0.0, 0.0, 1.0],
        revolutions: 0.0,
    }
}

/// Drift without a torque is the evolution at one angular momentum, through the separatrix too.
#[test]
fn drift_without_torque_is_the_evolution() {
    let reduced = reduce(&tumbler(0.5).body().unwrap(), 3).unwrap();
    let power = PolynomialPower::from_reduced(&reduced);
    let evolution = Evolution::new(&power, 15.0);
    let drift = Drift::new(&power, &Principal::compute(reduced.J), SlowTorque::default());
    let [long, short] = [Mode::LongAxis, Mode::ShortAxis].map(|mode| move |xi| RotationState { mode, xi });
    for (from, to) in [(short(-1.0), short(3.0)), (long(2.0), long(-3.0)), (long(1.0), short(2.0))] {
        let passage = evolution.passage(from, to);
        let found = followed(&drift, start(from, 15.0), &[0.5 * passage.time, passage.time]);
        assert_eq!(found.ending, DriftStopReason::Finished);
        let [_, last] = found.states[..] else { panic!("two states") };
        assert_eq!(last, found.end);
        let crossed = found.passages.iter().map(|passage| passage.t).next();
        let expected = evolution.separatrix_time(from, to);
        assert_eq!(crossed.is_some(), expected.is_some());
        if let (Some(crossed), Some(expected)) = (crossed, expected) {
            assert!((crossed / expected - 1.0).abs() < 1e-8, "{crossed} {expected}");
            assert_eq!(found.passages[0].probability, 0.5);
        }
        assert_eq!(last.rotation_state.mode, to.mode);
        assert!((last.rotation_state.xi - to.xi).abs() < 1e-6, "{last:?} {to:?}");
        assert!((last.revolutions / passage.revolutions - 1.0).abs() < 1e-7, "{last:?} {passage:?}");
        assert!((last.angular_momentum / 15.0 - 1.0).abs() < 1e-14);
    }
}

/// Zero power.
#[derive(Debug)]
struct Rigid([f64; 3]);

impl MeanPower for Rigid {
    fn moments(&self) -> [f64; 3] {
        self.0
    }

    fn mean_power(&self, _: &FreeRotation) -> f64 {
        0.0
    }
}

/// A steady spin under drag slows by `e^{−κt/I}`, under a torque along its axis it gains `Mt`.
#[test]
fn steady_spins_follow_their_closed_laws() {
    let moments = [2.0, 3.0, 4.0];
    let principal = Principal { moments, axes: parts::diag([1.0, 1.0, 1.0]) };
    let rigid = Rigid(moments);
    let times = [1e5, 3e5];
    for (mode, axis) in [(Mode::ShortAxis, 2), (Mode::LongAxis, 0)] {
        let rotation_state = RotationState { mode, xi: 25.0 };
        let mut constant = [0.0; 3];
        constant[axis] = 3e-6;
        let torque = SlowTorque { constant, ..SlowTorque::default() };
        let states =
            followed(&Drift::new(&rigid, &principal, torque), start(rotation_state, 5.0), &times).states;
        for (state, t) in states.iter().zip(times) {
            assert!((state.angular_momentum / (5.0 + 3e-6 * t) - 1.0).abs() < 1e-9, "{state:?}");
        }
        let torque = SlowTorque { drag: 1e-5, ..SlowTorque::default() };
        let states =
            followed(&Drift::new(&rigid, &principal, torque), start(rotation_state, 5.0), &times).states;
        let slowed = (-1e-5 * times[0] / moments[axis]).exp();
        assert!((states[0].angular_momentum / (5.0 * slowed) - 1.0).abs() < 1e-8, "{states:?}");
    }
}

/// Drag, a constant torque and dashpots at once, averaged and by the reduced equations; the weaker the torques and the
/// stiffer the body the closer.
#[test]
fn drift_is_that_of_the_reduced_equations() {
    let gap = |weakness: f64| {
        let body = tumbler(0.5).body().unwrap();
        let reduced = reduce(&body, 3).unwrap();
        let power = PolynomialPower::from_reduced(&reduced);
        let principal = Principal::compute(reduced.J);
        let torque = SlowTorque { constant: [0.0, 0.0, 4e-3 / weakness], drag: 6e-3 / weakness, eddy: None };
        let (omega, duration) = ([0.4, 0.2, 0.9], 600.0 * weakness);
        let named = |law| Force { name: String::new(), law };
        let forces = [
            named(ForceLaw::SpinDrag { coefficient: torque.drag }),
            named(ForceLaw::Torque { torque: torque.constant, axes: Axes::Body, wave: Wave::default() }),
        ];
        let system = Forced { body: &body, forces: &forces };
        let still =
            SlowState { angular_momentum: [0.0; 3], attitude: ALIGNED, place: [0.0; 3], velocity: [0.0; 3] };
        let slow = still.with_spin(system, 2, omega).unwrap();
        let mut samples = Vec::new();
        let options = Options { tolerance: 1e-11, ..Options::default() };
        propagate_forced(SlowEquations::series(system, 3), &slow, &[0.0, duration], &options, &mut samples)
            .unwrap();
        let G = norm(samples[0].angular_momentum);
        let evolution = Evolution::new(&power, G);
        let ratio = G * G / (2.0 * samples[0].energy * principal.moments[2]);
        let drift = Drift::new(&power, &principal, torque);
        let found = followed(&drift, start(evolution.rotation_state(ratio).unwrap(), G), &[duration]);
        assert_eq!(found.ending, DriftStopReason::Finished);
        let (last, state) = (&samples[1], found.end);
        let reached = Evolution::new(&power, state.angular_momentum).motion(state.rotation_state);
        println!(
            "weaker by {weakness}: |K| {:.6} {:.6}, E {:.6} {:.6} of {:.6}",
            norm(last.angular_momentum),
            state.angular_momentum,
            last.energy,
            reached.energy(),
            samples[0].energy
        );
        [norm(last.angular_momentum) / state.angular_momentum - 1.0, last.energy / reached.energy() - 1.0]
            .map(f64::abs)
    };
    let [strong, weak] = [gap(1.0), gap(4.0)];
    assert!(weak.iter().all(|gap| *gap < 2e-3), "{strong:?} {weak:?}");
}
