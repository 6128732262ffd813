//! End of a drift under slow torques, against Euler's equations with the torque in them, integrated here.

use std::ops::ControlFlow;

use quasirigid::averaging::{
    Drift, DriftHistory, DriftLimits, DriftState, DriftStopReason, Evolution, FreeRotation, MeanPower,
    RotationState, SlowTorque,
};
use quasirigid::model::{Mode, Principal};
use quasirigid_math::vec3::norm;

use crate::support::parts;

const MOMENTS: [f64; 3] = [2.0, 3.0, 4.0];

/// Zero power.
#[derive(Debug)]
struct Rigid;

impl MeanPower for Rigid {
    fn moments(&self) -> [f64; 3] {
        MOMENTS
    }

    fn mean_power(&self, _: &FreeRotation) -> f64 {
        0.0
    }
}

fn drift(torque: SlowTorque) -> Drift<Rigid> {
    let axes = parts::diag([1.0, 1.0, 1.0]);
    Drift::new(Rigid, &Principal { moments: MOMENTS, axes }, torque)
}

fn start(mode: Mode, xi: f64, angular_momentum: f64) -> DriftState {
    DriftState {
        t: 0.0,
        rotation_state: RotationState { mode, xi },
        angular_momentum,
        side: 1.0,
        direction: [0.0, 0.0, 1.0],
        revolutions: 0.0,
    }
}

fn onward(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Euler's equations with a torque fixed in the body and a drag, by the classical method of Runge and Kutta.
fn euler(torque: SlowTorque, mut omega: [f64; 3], h: f64, mut go_on: impl FnMut(f64, [f64; 3]) -> bool) {
    let rate = |w: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let gyroscopic = (MOMENTS[j] - MOMENTS[k]) * w[j] * w[k];
            (gyroscopic + torque.constant[i] - torque.drag * w[i]) / MOMENTS[i]
        })
    };
    let moved = |w: [f64; 3], k: [f64; 3], h: f64| -> [f64; 3] { std::array::from_fn(|i| w[i] + h * k[i]) };
    let mut t = 0.0;
    while go_on(t, omega) {
        let k1 = rate(omega);
        let k2 = rate(moved(omega, k1, h / 2.0));
        let k3 = rate(moved(omega, k2, h / 2.0));
        let k4 = rate(moved(omega, k3, h));
        omega = std::array::from_fn(|i| omega[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        t += h;
    }
}

/// Angular momentum, and `D/I₃`.
fn slow(omega: [f64; 3]) -> [f64; 2] {
    let G = norm([0, 1, 2].map(|i| MOMENTS[i] * omega[i]));
    let twice_energy: f64 = (0..3).map(|i| MOMENTS[i] * omega[i] * omega[i]).sum();
    [G, G * G / (twice_energy * MOMENTS[2])]
}

/// In both modes, with a torque along the spin and against it, and a drag: the weaker the torques the closer.
#[test]
fn drift_is_that_of_eulers_equations() {
    let torque = |weakness: f64, sign: f64| SlowTorque {
        constant: [sign * 4e-3 / weakness, 3e-3 / weakness, sign * 5e-3 / weakness],
        drag: 4e-3 / weakness,
        eddy: None,
    };
    for (mode, xi, sign) in [
        (Mode::ShortAxis, 1.5, 1.0),
        (Mode::ShortAxis, 3.0, -1.0),
        (Mode::LongAxis, 2.0, 1.0),
        (Mode::LongAxis, 2.5, -1.0),
    ] {
        let gap = |weakness: f64| {
            let (torque, duration) = (torque(weakness, sign), 150.0 * weakness);
            let from = start(mode, xi, 5.0);
            let found = drift(torque).follow(from, &[], &DriftLimits::until(duration), onward);
            assert_eq!((found.ending, found.end.t), (DriftStopReason::Finished, duration));
            assert!(found.passages.is_empty());
            let motion = FreeRotation::at_logit(MOMENTS, 5.0, mode, xi);
            // Mean over the last revolutions: variations within a revolution are not part of the drift.
            let (mut sum, mut rows) = ([0.0; 2], 0.0);
            let window = 20.0 * motion.polhode_period();
            euler(torque, motion.omega(0.0), 0.02, |t, omega| {
                if t > duration - window {
                    let [G, ratio] = slow(omega);
                    sum = [sum[0] + G, sum[1] + ratio];
                    rows += 1.0;
                }
                t < duration + window
            });
            let ratio = Evolution::new(&Rigid, 5.0).ratio(found.end.rotation_state);
            println!(
                "{mode:?} {sign}: {:?} {:?}",
                sum.map(|sum| sum / rows),
                [found.end.angular_momentum, ratio]
            );
            [sum[0] / rows / found.end.angular_momentum - 1.0, sum[1] / rows / ratio - 1.0].map(f64::abs)
        };
        let [strong, weak] = [gap(1.0), gap(8.0)];
        println!("{strong:?} {weak:?}");
        assert!((0..2).all(|i| weak[i] < 2e-3 && weak[i] < 0.5 * strong[i].max(1e-3)), "{strong:?} {weak:?}");
    }
}

/// A torque against the spin takes a wobbling body to the separatrix, where it turns over: about the other side of the axis of greatest
/// inertia the same torque spins it up. (A10)
#[test]
fn a_torque_against_the_spin_turns_the_body_over() {
    let gaps = [1.0, 8.0].map(|weakness| {
        let torque = SlowTorque { constant: [0.0, 0.0, -1e-3 / weakness], drag: 1e-5 / weakness, eddy: None };
        let (from, duration) = (start(Mode::ShortAxis, 1.0, 5.0), 4000.0 * weakness);
        let found = drift(torque).follow(from, &[], &DriftLimits::until(duration), onward);
        let [passage] = found.passages[..] else { panic!("{found:?}") };
        assert_eq!((passage.from, passage.to), ((Mode::ShortAxis, 1.0), (Mode::ShortAxis, -1.0)));
        assert_eq!(
            (passage.probability, found.ending, found.end.side),
            (1.0, DriftStopReason::Finished, -1.0)
        );
        let (mut turned, mut last) = (f64::NAN, [0.0; 3]);
        let omega = FreeRotation::at_logit(MOMENTS, 5.0, Mode::ShortAxis, 1.0).omega(0.0);
        euler(torque, omega, 0.02, |t, omega| {
            if turned.is_nan() && omega[2] < 0.0 {
                turned = t;
            }
            last = omega;
            t < duration
        });
        assert!(last[2] < 0.0);
        let ([G, ratio], expected) =
            (slow(last), Evolution::new(&Rigid, 5.0).ratio(found.end.rotation_state));
        println!("{turned} {passage:?}, {G} {ratio} {expected} {:?}", found.end);
        [turned / passage.t, G / found.end.angular_momentum, ratio / expected]
            .map(|share| (share - 1.0).abs())
    });
    let [strong, weak] = gaps;
    assert!((0..3).all(|i| strong[i] < 0.03 && weak[i] < 5e-3), "{gaps:?}");
}

/// From the long-axis mode drag leads through the separatrix to either side, and a torque changes the odds. (A10)
#[test]
fn sides_are_entered_with_their_probabilities() {
    let torque = SlowTorque { constant: [0.0, 0.0, 1.3e-4], drag: 5e-4, eddy: None };
    let [xi, G] = [-2.0, 5.0];
    let found = drift(torque).follow(start(Mode::LongAxis, xi, G), &[], &DriftLimits::until(1e4), onward);
    let passage = found.passages[0];
    assert_eq!(passage.to, (Mode::ShortAxis, 1.0));
    let starts = 300;
    let mut positive = 0;
    for i in 0..starts {
        let from = xi + 0.2 * f64::from(i) / f64::from(starts);
        let motion = FreeRotation::at_logit(MOMENTS, G, Mode::LongAxis, from);
        let mut last = [0.0; 3];
        euler(torque, motion.omega(0.0), 0.04, |_, omega| {
            last = omega;
            slow(omega)[1] < (MOMENTS[1] + 0.008) / MOMENTS[2] // captured; the drag leads back from the worse side later
        });
        positive += u32::from(last[2] > 0.0);
    }
    let share = f64::from(positive) / f64::from(starts);
    println!("{share} {passage:?}");
    assert!((0.55..0.95).contains(&passage.probability));
    assert!((share - passage.probability).abs() < 0.02, "{share} {passage:?}");
}

/// Whatever the rows asked for, the end is the same in every bit.
#[test]
fn ends_do_not_depend_on_the_rows() {
    let torque = SlowTorque { constant: [0.0, 0.0, -1e-3], drag: 1e-4, eddy: None };
    let target = Evolution::new(&Rigid, 5.0).rotation_state(0.8);
    let ends = |limits: DriftLimits| {
        let found = [21, 2001].map(|rows: usize| {
            let times: Vec<f64> = (0..rows).map(|i| limits.end * i as f64 / (rows - 1) as f64).collect();
            drift(torque).follow(start(Mode::ShortAxis, 2.0, 5.0), &times, &limits, onward)
        });
        assert_eq!((found[0].end, found[0].ending), (found[1].end, found[1].ending));
        assert!(found.iter().all(|found| found.states.iter().all(|state| state.t <= found.end.t)));
        let [few, _] = found;
        few
    };
    let all = DriftLimits::until(1e6);
    let reached = ends(DriftLimits { target, ..all });
    let ratio = Evolution::new(&Rigid, 5.0).ratio(reached.end.rotation_state);
    assert!(reached.ending == DriftStopReason::Target && (ratio / 0.8 - 1.0).abs() < 1e-13, "{reached:?}");
    assert_eq!(ends(all).ending, DriftStopReason::Finished);
    assert!(reached.ending.done() && ends(all).ending.done());
    assert_eq!(ends(all).passages.len(), 1);
}

fn close(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// A steady spin comes to rest after `(I/κ) ln(1/share)`, a torque `M` spins it up to `Ω` after `(IΩ − G)/M`.
#[test]
fn steady_spins_end_at_rest_or_spun_up() {
    let ended = |mode: Mode, torque, fastest| -> DriftHistory {
        let limits = DriftLimits { fastest, ..DriftLimits::until(1e12) };
        let found = drift(torque).follow(
            DriftState { rotation_state: RotationState::steady(mode), ..start(mode, 0.0, 5.0) },
            &[],
            &limits,
            onward,
        );
        assert!(found.end.rotation_state == RotationState::steady(mode) && found.steps < 2000, "{found:?}");
        found
    };
    for mode in [Mode::ShortAxis, Mode::LongAxis] {
        let axis = mode.circled();
        let torque = |torque: f64| {
            let mut constant = [0.0; 3];
            constant[axis] = torque;
            SlowTorque { constant, ..SlowTorque::default() }
        };
        if mode == Mode::ShortAxis {
            let slowed = ended(mode, SlowTorque { drag: 1e-4, ..SlowTorque::default() }, f64::INFINITY);
            assert_eq!(slowed.ending, DriftStopReason::Rest { share: 1e-9 });
            assert!(!slowed.ending.done());
            close(slowed.end.t, MOMENTS[axis] / 1e-4 * 1e9_f64.ln());
        }
        let found = ended(mode, torque(1e-4), 3.0);
        assert!(matches!(found.ending, DriftStopReason::SpunUp { rate } if (rate / 3.0 - 1.0).abs() < 1e-12));
        close(found.end.t, (3.0 * MOMENTS[axis] - 5.0) / 1e-4);
    }
}

/// Where the wobble decays the steady spin is followed on; before, there was a wobble of some degrees.
#[test]
fn a_wobble_that_dies_out_leaves_a_steady_spin() {
    let torque = SlowTorque { constant: [0.0, 0.0, 1e-3], drag: 1e-3, eddy: None };
    let limits = DriftLimits::until(1e7);
    let found = drift(torque).follow(start(Mode::ShortAxis, 1.0, 5.0), &[1e7], &limits, onward);
    assert_eq!(
        (found.ending, found.states[0].rotation_state),
        (DriftStopReason::Finished, RotationState::steady(Mode::ShortAxis))
    );
    assert!(found.died_out.is_some_and(|t| t > 0.0 && t < 1e6) && found.steps < 5000, "{found:?}");
    close(found.end.angular_momentum, MOMENTS[2]); // drag and torque balance at Ω = M/κ = 1
}

#[test]
fn a_drift_can_be_stopped_and_never_hangs() {
    let torque = SlowTorque { constant: [0.0, 0.0, -1e-3], drag: 1e-4, eddy: None };
    let from = start(Mode::ShortAxis, 2.0, 5.0);
    let limits = DriftLimits::until(1e6);
    let mut asked = 0;
    let stopped = drift(torque).follow(from, &[0.0, 1e6], &limits, |share| {
        assert!((0.0..=1.0).contains(&share));
        asked += 1;
        if asked == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!((stopped.ending, stopped.states.len(), stopped.steps), (DriftStopReason::Interrupted, 1, 5));
    assert!(stopped.end.t > 0.0);
    let limited = drift(torque).follow(from, &[], &DriftLimits { steps: 7, ..limits }, onward);
    assert_eq!((limited.ending, limited.steps), (DriftStopReason::StepLimit { steps: 7 }, 7));
    let held = drift(SlowTorque::default()).follow(start(Mode::ShortAxis, -30.0, 5.0), &[], &limits, onward);
    assert_eq!(held.ending, DriftStopReason::Held);
    let undefined = SlowTorque { constant: [0.0, 0.0, f64::NAN], drag: 0.0, eddy: None };
    let failed = drift(undefined).follow(from, &[], &limits, onward);
    assert!(matches!(failed.ending, DriftStopReason::Failed(_)) && failed.end.t == 0.0, "{failed:?}");
}
