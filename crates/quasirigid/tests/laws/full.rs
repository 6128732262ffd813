//! The full system: its invariants, motions without dissipation, and the fate of its fast part.

use quasirigid::dynamics::{
    BoundaryLayer, Event, Forced, Form, FullState, Method, Options, Outcome, Rounding, Sample, SlowEquations,
    SlowState, Start, composite_spin, matched_start, propagate, propagate_forced, propagate_full,
    slow_state_point, steady_spins,
};
use quasirigid::elements::{Carrier, End};
use quasirigid::model::FlexibleBody;
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::problems::CommonProblem;
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::{ALIGNED, angle_between};
use quasirigid_math::vec3::{add, norm, scale};

use crate::support::parts;
use crate::support::{Sprung, sprung_body};

fn carrier() -> Carrier {
    parts::carrier(30.0, [0.1, -0.2, 0.05], [[9.0, 0.3, -0.2], [0.3, 12.0, 0.5], [-0.2, 0.5, 14.0]])
}

/// Two masses off every axis, on different springs.
fn body() -> FlexibleBody {
    let masses = [
        parts::sprung(1.1, [0.9, 0.3, 0.4], [700.0, 900.0, 1100.0], [9.0, 7.0, 8.0]),
        parts::sprung(0.7, [-0.5, 0.8, -0.6], [500.0, 800.0, 600.0], [6.0, 5.0, 8.0]),
    ];
    sprung_body(carrier(), &masses).body().unwrap()
}

const OMEGA: [f64; 3] = [0.5, 0.7, 0.9];

fn at(tolerance: f64) -> Options {
    Options { tolerance, ..Options::default() }
}

fn full(body: &FlexibleBody, start: &FullState, times: &[f64], options: Options) -> Vec<Sample> {
    let mut samples = Vec::new();
    let run = propagate_full(Forced::not(body), start, times, &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    samples
}

/// Internal forces act in body axes with the reaction at the displaced point, so a body that rotates steadily about a principal axis, at
/// its equilibrium stretch, loses nothing.
#[test]
fn a_steady_spin_dissipates_nothing() {
    let body = body();
    let reduced = reduce(&body, 11).unwrap();
    for steady in steady_spins(&reduced, 15.0) {
        let omega = steady.unwrap().omega;
        let (q, rate) = (reduced.q.value(omega), reduced.rate.value(omega));
        assert!(q.iter().any(|q| q.abs() > 1e-3), "the body is stretched");
        let start = FullState { q, rate, ..FullState::at_rest(&body, omega, ALIGNED) };
        let last = full(&body, &start, &[10.0], at(1e-13))[0];
        assert!(last.dissipated < 1e-13 * last.energy, "{:e} J of {} J", last.dissipated, last.energy);
    }
}

/// Explicit, implicit and both alternately: methods for the same motion, whose errors of the energy are small beside the energy that the
/// dashpots take.
#[test]
fn methods_agree() {
    let body = body();
    let start = FullState::at_rest(&body, OMEGA, ALIGNED);
    let times = [0.3, 2.0, 11.0, 40.0];
    let run = |method| full(&body, &start, &times, Options { method, ..at(1e-12) });
    let [explicit, implicit, both] = [Method::Explicit, Method::Implicit, Method::Automatic].map(run);
    for (i, truth) in explicit.iter().enumerate() {
        for other in [&implicit[i], &both[i]] {
            assert!(norm(add(truth.omega, scale(-1.0, other.omega))) < 1e-10);
            assert!((truth.dissipated / other.dissipated - 1.0).abs() < 1e-7);
            assert!(other.energy_drift.abs() < 1e-7 * other.dissipated, "{:e}", other.energy_drift);
            assert!(other.momentum_drift.abs() < 1e-11);
        }
    }
}

/// A force of no size has the stages of implicit steps found one after the other; without it they are found side by side in lanes.
#[test]
fn stages_side_by_side_are_those_found_in_turn() {
    let body = body();
    let still = FullState::at_rest(&body, OMEGA, ALIGNED);
    let start = FullState { place: [1.0, -2.0, 0.5], velocity: [0.3, 0.1, -0.2], ..still };
    let times = [0.3, 2.0, 11.0, 40.0];
    let law =
        ForceLaw::Torque { torque: [0.0; 3], axes: Axes::Body, wave: Wave { frequency: 0.0, phase: 0.0 } };
    let none = [Force { name: "none".into(), law }];
    let options = Options { method: Method::Implicit, ..at(1e-12) };
    let mut in_turn: Vec<Sample> = Vec::new();
    let system = Forced { body: &body, forces: &none };
    let slow = propagate_full(system, &start, &times, &options, &mut in_turn).unwrap();
    for rounding in [Rounding::Fastest, Rounding::Reproducible] {
        let mut beside: Vec<Sample> = Vec::new();
        let options = Options { rounding, ..options.clone() };
        let quick = propagate_full(Forced::not(&body), &start, &times, &options, &mut beside).unwrap();
        assert_ne!(quick.work, slow.work, "the same steps");
        for (truth, found) in in_turn.iter().zip(&beside) {
            assert!(norm(add(truth.omega, scale(-1.0, found.omega))) < 1e-10);
            assert!(angle_between(truth.attitude, found.attitude) < 1e-10);
            assert!(norm(add(truth.place, scale(-1.0, found.place))) < 1e-10);
            assert!((truth.energy / found.energy - 1.0).abs() < 1e-10);
            assert!((truth.dissipated / found.dissipated - 1.0).abs() < 1e-8);
            assert!((truth.revolutions / found.revolutions - 1.0).abs() < 1e-8);
        }
    }
}

/// Twenty points in a chain, each sprung to the carrier and to its neighbours: more coordinates than are solved by a full matrix.
fn chain() -> FlexibleBody {
    let masses: Vec<Sprung> = (0..20)
        .map(|i| {
            let (number, angle) = (f64::from(i), 0.55 * f64::from(i));
            let stiffness = [90.0 + 5.0 * number, 120.0, 150.0];
            parts::sprung(
                0.2 + 0.01 * number,
                [0.8 * angle.cos(), 0.9 * angle.sin(), 0.05 * number - 0.4],
                stiffness,
                scale(0.01, stiffness),
            )
        })
        .collect();
    let mut assembly = sprung_body(carrier(), &masses);
    assembly.springs.extend((1..20).map(|next| {
        parts::spring(
            End::Point(next - 1),
            End::Point(next),
            parts::diagonal([60.0, 50.0, 40.0], [0.6, 0.5, 0.4]),
        )
    }));
    assembly.body().unwrap()
}

#[test]
fn methods_agree_on_many_coordinates() {
    let body = chain();
    assert_eq!(body.coordinates().len(), 60);
    let start = FullState::at_rest(&body, OMEGA, ALIGNED);
    let run = |method| full(&body, &start, &[1.0, 8.0], Options { method, ..at(1e-11) });
    for (explicit, implicit) in run(Method::Explicit).iter().zip(run(Method::Implicit)) {
        assert!(norm(add(explicit.omega, scale(-1.0, implicit.omega))) < 1e-10);
        assert!((explicit.dissipated / implicit.dissipated - 1.0).abs() < 1e-7);
    }
}

/// Released from rest: the slow motion from the matched start is right to `ε³`, without the rotation of the start to `ε²`.
#[test]
fn matched_start_gains_an_order() {
    let [matched, plain]: [Vec<f64>; 2] = [true, false].map(|turned| {
        [0.5, 0.25, 0.125]
            .map(|epsilon| {
                let body = body().stiffened(epsilon).unwrap();
                let start = FullState::at_rest(&body, OMEGA, ALIGNED);
                let reduced = reduce(&body, 3).unwrap();
                let slow = matched_start(Forced::not(&body), 3, &start).unwrap();
                let angular_momentum =
                    if turned { slow.angular_momentum } else { start.angular_momentum(&body) };
                let initial = Start::new(reduced.Omega.vector(angular_momentum), slow.attitude);
                let times: Vec<f64> = (40..=80).map(|i| f64::from(i) * 0.25).collect();
                let mut samples: Vec<Sample> = Vec::new();
                propagate(&reduced, initial, &times, &at(1e-13), &mut samples).unwrap();
                let truth = full(&body, &start, &times, at(1e-13));
                let gap = |(a, b): (&Sample, &Sample)| norm(add(a.omega, scale(-1.0, b.omega)));
                truth.iter().zip(&samples).map(gap).fold(0.0, f64::max)
            })
            .to_vec()
    });
    let order = |errors: &[f64]| (errors[1] / errors[2]).log2();
    println!(
        "matched {:?} order {:.3}; plain {:?} order {:.3}",
        matched,
        order(&matched),
        plain,
        order(&plain)
    );
    assert!((order(&matched) - 3.0).abs() < 0.3, "{}", order(&matched));
    assert!((order(&plain) - 2.0).abs() < 0.3, "{}", order(&plain));
}

/// The composite solution holds in the layer itself: the spin to `ε²`, where the slow spin alone is wrong by `ε`.
#[test]
fn composite_solution_holds_from_the_first_moment() {
    let [with, without]: [Vec<f64>; 2] = [true, false].map(|fast| {
        [0.25, 0.125, 0.0625]
            .map(|epsilon| {
                let body = body().stiffened(epsilon).unwrap();
                let start = FullState::at_rest(&body, OMEGA, ALIGNED);
                let system = Forced::not(&body);
                let slow = matched_start(system, 3, &start).unwrap();
                let layer = BoundaryLayer::compute(system, 3, &start).unwrap();
                let times: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.005 * epsilon).collect();
                let mut samples: Vec<Sample> = Vec::new();
                propagate_forced(SlowEquations::series(system, 3), &slow, &times, &at(1e-13), &mut samples)
                    .unwrap();
                let truth = full(&body, &start, &times, at(1e-13));
                let gap = |(a, b): (&Sample, &Sample)| {
                    let part = layer.at(a.t);
                    let spin = if fast { composite_spin(b.omega, &part) } else { b.omega };
                    norm(add(a.omega, scale(-1.0, spin)))
                };
                truth.iter().zip(&samples).map(gap).fold(0.0, f64::max)
            })
            .to_vec()
    });
    let order = |errors: &[f64]| (errors[1] / errors[2]).log2();
    println!(
        "composite {:?} order {:.3}; slow {:?} order {:.3}",
        with,
        order(&with),
        without,
        order(&without)
    );
    assert!(order(&with) > 1.8, "{}", order(&with));
    assert!((order(&without) - 1.0).abs() < 0.2, "{}", order(&without));
}

/// Series in time at each state and polynomials of the spin are two methods for the same slow manifold: they differ by the next order.
#[test]
fn slow_manifold_by_series_in_time_is_the_polynomial_one() {
    for order in 2..=5 {
        let differences = [0.25, 0.125].map(|epsilon| {
            let body = body().stiffened(epsilon).unwrap();
            let reduced = reduce(&body, order).unwrap();
            let still = SlowState {
                angular_momentum: [0.0; 3],
                attitude: ALIGNED,
                place: [0.0; 3],
                velocity: [0.0; 3],
            };
            let system = Forced::not(&body);
            let state = still.with_spin(system, order, OMEGA).unwrap();
            let point = slow_state_point(system, order, &state).unwrap();
            let largest =
                |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            largest(&point.q, &reduced.q.value(OMEGA))
        });
        let measured = (differences[0] / differences[1]).log2();
        assert!(measured > order as f64 + 0.8, "p = {order}: {measured:.3}, {differences:?}");
    }
}

/// A run ends where the energy or the wobble passes its limit, at that moment and not at the end of a step.
#[test]
fn events_end_a_run_where_they_happen() {
    let body = CommonProblem::SOFT.assembly().body().unwrap();
    let start = FullState::at_rest(&body, CommonProblem::SPIN, ALIGNED);
    let mark = start.energy(&body) - 2e-3;
    let options = Options { events: vec![Event::Energy(mark)], ..at(1e-11) };
    let mut samples: Vec<Sample> = Vec::new();
    let run = propagate_full(Forced::not(&body), &start, &[1e-3, 1e5], &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Event(Event::Energy(mark)));
    assert!((run.last.energy / mark - 1.0).abs() < 1e-12, "{} J, asked {mark} J", run.last.energy);
    assert_eq!(samples.len(), 1);
    let reduced = reduce(&body, 3).unwrap();
    let initial = Start::new(CommonProblem::SPIN, ALIGNED);
    for form in [Form::AngularMomentum, Form::AngularVelocity] {
        let options = Options { form, ..options.clone() };
        let run = propagate(&reduced, initial, &[1e-3, 1e5], &options, &mut Vec::new()).unwrap();
        assert!((run.last.energy / mark - 1.0).abs() < 1e-12, "{form:?}: {:?}", run.outcome);
    }
}

/// Of two events in one step the earlier one ends the run, in whichever order they are watched for; of two at the same moment, the first
/// in the list.
#[test]
fn the_earliest_of_two_events_ends_a_run() {
    let body = CommonProblem::SOFT.assembly().body().unwrap();
    let start = FullState::at_rest(&body, CommonProblem::SPIN, ALIGNED);
    let energy = start.energy(&body);
    let [early, late] = [2.0e-3, 2.000_001e-3].map(|fall| Event::Energy(energy - fall));
    let ended = |events: Vec<Event>| {
        let options = Options { events, ..at(1e-11) };
        let mut samples: Vec<Sample> = Vec::new();
        propagate_full(Forced::not(&body), &start, &[1e5], &options, &mut samples).unwrap()
    };
    for events in [vec![early, late], vec![late, early]] {
        assert_eq!(ended(events).outcome, Outcome::Event(early));
    }
    // The rate passes the middle of its values at the ends; halves of both sides are exact.
    let limit = 0.5 * (norm(CommonProblem::SPIN) + norm(ended(vec![early]).last.omega));
    let [one, other] = [1.0, 2.0].map(|slowest| Event::Validity { slowest, limit: limit / slowest });
    for events in [[one, other], [other, one]] {
        assert_eq!(ended(events.to_vec()).outcome, Outcome::Event(events[0]));
    }
}
