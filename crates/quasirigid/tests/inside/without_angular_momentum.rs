//! Bodies whose wheels take up the whole angular momentum.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use nalgebra::{Matrix3, Vector3};
use quasirigid::dynamics::{
    Forced, Form, FullState, Method, Options, Outcome, Run, Sample, SlowEquations, SlowState, Start,
    matched_start, propagate, propagate_forced, propagate_full, spin_path,
};
use quasirigid::elements::{Assembly, Cavity, WheelSpeed};
use quasirigid::model::{FlexibleBody, Principal};
use quasirigid::reduction::{Validity, Verdict, reduce, residual};
use quasirigid::verification::{VerificationPlan, verify};
use quasirigid_math::expression::Expression;
use quasirigid_math::rotation::{ALIGNED, angle_between, turned};
use quasirigid_math::vec3::{add, norm, scale};

use super::bodies::{bare, cavity, start, wheel};
use super::oracle::Gyrostat;
use crate::support::parts;
use crate::support::rotors::{ball, flywheel};

/// Body with rotors and a liquid, and a wheel that takes up the angular momentum of this spin.
fn taken_up(bare: Assembly, omega: [f64; 3], cavities: Vec<Cavity>) -> Assembly {
    let rotors = vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0), ball(0.7, 9.0)];
    let assembly = Assembly { rotors, cavities, ..bare };
    let J = Matrix3::from(assembly.body().unwrap().inertia());
    let angular_momentum = J * Vector3::from(omega);
    let wheel =
        wheel((-angular_momentum).into(), WheelSpeed::Constant { angular_momentum: angular_momentum.norm() });
    Assembly { wheels: vec![wheel], ..assembly }
}

/// Bodies without angular momentum: to the last bit, and but for rounding.
fn without_momentum() -> [(FlexibleBody, [f64; 3]); 2] {
    let aligned = Assembly {
        carrier: Some(parts::carrier(40.0, [0.0; 3], parts::diag([9.0, 13.0, 16.0]))),
        ..Assembly::default()
    };
    let (along, skew) = ([0.0, 0.0, 0.75], [0.3, -0.5, 0.4]);
    let exact = taken_up(aligned, along, Vec::new()).body().unwrap();
    let rounded = taken_up(bare(), skew, vec![cavity([0.4, 0.3, 0.2], 500.0, 0.1)]).body().unwrap();
    let left =
        |body: &FlexibleBody, omega| norm(FullState::at_rest(body, omega, ALIGNED).angular_momentum(body));
    assert!(left(&exact, along) == 0.0);
    assert!(left(&rounded, skew) < 1e-14 && left(&rounded, skew) > 0.0, "{:e}", left(&rounded, skew));
    [(exact, along), (rounded, skew)]
}

const END: f64 = 20.0;

/// Asserts an even rotation about an axis that is fixed in space, without loss of energy, to the tolerance of 1e-12 in each step.
fn assert_even(name: &str, omega: [f64; 3], run: Run, samples: &[Sample]) {
    assert_eq!(run.outcome, Outcome::Finished, "{name}");
    let last = samples.last().unwrap();
    let apart = norm(add(last.omega, scale(-1.0, omega))) / norm(omega);
    let turn = angle_between(last.attitude, turned(ALIGNED, scale(END, omega)));
    let revolutions = last.revolutions * TAU / (END * norm(omega)) - 1.0;
    let drifts = [last.momentum_drift, last.energy_drift / last.energy, last.dissipated / last.energy];
    println!("{name}: {apart:e} {turn:e} {revolutions:e} {drifts:?} in {} steps", run.work.steps);
    assert!(apart < 1e-11 && turn < 1e-10 && revolutions.abs() < 1e-11, "{name}: {last:?}");
    assert!(drifts.iter().all(|drift| drift.abs() < 1e-12), "{name}: {last:?}");
}

#[test]
fn a_body_without_momentum_turns_evenly() {
    let times = [0.5 * END, END];
    for (body, omega) in without_momentum() {
        let reduced = reduce(&body, 3).unwrap();
        for form in [Form::AngularMomentum, Form::AngularVelocity] {
            let options = Options { form, most_steps: 10_000, ..Options::default() };
            let initial = Start::new(omega, ALIGNED);
            let mut samples = Vec::new();
            let run = propagate(&reduced, initial, &times, &options, &mut samples).unwrap();
            assert_even(&format!("{form:?}"), omega, run, &samples);
            let path = spin_path(&reduced, omega, &times, &options).unwrap();
            assert_eq!(path.outcome, Outcome::Finished);
            assert!(norm(add(path.omega[1], scale(-1.0, omega))) < 1e-12 * norm(omega), "{form:?} {path:?}");
        }
        let full = FullState::at_rest(&body, omega, ALIGNED);
        for method in [Method::Explicit, Method::Implicit, Method::Automatic] {
            let options = Options { method, ..Options::default() };
            let mut samples = Vec::new();
            let run = propagate_full(Forced::not(&body), &full, &times, &options, &mut samples).unwrap();
            assert_even(&format!("{method:?}"), omega, run, &samples);
        }
        let slow: SlowState = matched_start(Forced::not(&body), 3, &full).unwrap();
        let mut samples = Vec::new();
        let run = propagate_forced(
            SlowEquations::series(Forced::not(&body), 3),
            &slow,
            &times,
            &Options::default(),
            &mut samples,
        )
        .unwrap();
        assert_even("forced", omega, run, &samples);
    }
}

/// A steady spin loads internal rotors and liquids with nothing but rounding, whatever wheels do: the equations hold, and no criterion is a
/// ratio of two roundings. (R12)
#[test]
fn the_equations_hold_for_a_body_that_turns_evenly() {
    let rotors = vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0), ball(0.7, 9.0)];
    let cavities = vec![cavity([0.4, 0.3, 0.2], 500.0, 0.1)];
    let steady = Assembly { rotors, cavities, ..bare() }.body().unwrap();
    let axes = Principal::compute(steady.invariants().J).axes;
    let without_wheels = axes.map(|axis| (steady.clone(), scale(0.7, axis)));
    for (body, omega) in without_wheels.into_iter().chain(without_momentum()) {
        let validity = Validity::assess(&body, 3, omega).unwrap();
        println!("{:?}", validity.criteria);
        assert!(validity.criteria.iter().all(|criterion| criterion.value.is_finite()));
        assert_eq!(validity.verdict(), Verdict::Holds, "{:?}", validity.criteria);
        let residual = residual(&body, &reduce(&body, 3).unwrap(), omega);
        assert_eq!((residual.elastic, residual.cyclic), (0.0, 0.0), "{residual:?}");
    }
}

/// On both sides of the angular momentum below which its direction is not conserved by projection, the attitude does not depend on the
/// method.
#[test]
fn little_angular_momentum_is_held_or_not_with_the_same_result() {
    let omega = [0.3, -0.5, 0.4];
    for share in [1e-6, 9.9e-4, 1.02e-3, 0.1] {
        let taken = taken_up(bare(), omega, Vec::new());
        let WheelSpeed::Constant { angular_momentum } = taken.wheels[0].speed else {
            panic!("{:?}", taken.wheels)
        };
        let mut assembly = Assembly { rotors: Vec::new(), ..taken };
        assembly.wheels[0].speed =
            WheelSpeed::Constant { angular_momentum: angular_momentum / (1.0 + share) };
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, 0).unwrap();
        assert!((norm(reduced.angular_momentum(omega)) / norm(reduced.wheels()) / share - 1.0).abs() < 1e-8);
        let initial = Start::new(omega, ALIGNED);
        let [angular_momentum, paper] = [Form::AngularMomentum, Form::AngularVelocity].map(|form| {
            let options = Options { form, ..Options::default() };
            propagate(&reduced, initial, &[END], &options, &mut Vec::new()).unwrap()
        });
        let state = FullState::at_rest(&body, omega, ALIGNED);
        let options = Options::default();
        let full = propagate_full(Forced::not(&body), &state, &[END], &options, &mut Vec::new()).unwrap();
        let apart = [paper, full].map(|run| angle_between(run.last.attitude, angular_momentum.last.attitude));
        let drifts = [angular_momentum, paper, full].map(|run| run.last.momentum_drift);
        println!("{share}: {apart:?} {drifts:?}");
        assert!(apart[0] < 1e-9 && apart[1] < 1e-11, "{share}: {apart:?}");
        assert!(drifts.iter().all(|drift| drift.abs() < 1e-11), "{share}: {drifts:?}");
    }
}

#[test]
fn a_verification_without_momentum() {
    for (body, omega) in without_momentum() {
        let plan = VerificationPlan {
            orders: vec![0, 1, 2],
            rotations: 1.0,
            halvings: 2,
            samples: 10,
            ..VerificationPlan::default()
        };
        let system = Forced::not(&body);
        let verification = verify(system, &start(omega), &plan, &mut |_| ControlFlow::Continue(())).unwrap();
        println!("{:?}", verification.rows);
        assert!(verification.reached(), "{:?}", verification.rows);
    }
}

/// Angular momentum of a body with a flywheel and a ball of given speeds.
fn loose_momentum() -> Vector3<f64> {
    let axis = Vector3::from(AXIS).normalize();
    INERTIA * Vector3::from(OMEGA) + 1.1 * FLYWHEEL * axis + 1.4 * Vector3::from(BALL)
}

const INERTIA: Matrix3<f64> = Matrix3::new(9.0, 0.2, 0.0, 0.2, 13.0, -0.4, 0.0, -0.4, 16.0);
const OMEGA: [f64; 3] = [1.2, 0.35, 0.2];
const AXIS: [f64; 3] = [0.3, 1.0, -0.5];
const FLYWHEEL: f64 = 4.0;
const BALL: [f64; 3] = [-2.0, 1.5, 0.5];

/// Flywheel and ball start with speeds of their own, and the wheel takes up their angular momentum and that of the body.
#[test]
fn rotors_come_to_rest_in_a_body_without_momentum() {
    let rotors = vec![flywheel(AXIS, 1.1, 0.7), ball(1.4, 2.5)];
    let angular_momentum = loose_momentum();
    let wheels = vec![wheel(
        (-angular_momentum).into(),
        WheelSpeed::Constant { angular_momentum: angular_momentum.norm() },
    )];
    let body = Assembly { rotors, wheels, ..bare() }.body().unwrap();
    let mut state = FullState::at_rest(&body, OMEGA, ALIGNED);
    state.rate.copy_from_slice(&[FLYWHEEL, BALL[0], BALL[1], BALL[2]]);
    assert!(norm(state.angular_momentum(&body)) < 1e-13);
    let gyrostat = Gyrostat {
        inertia: INERTIA,
        flywheel: (Vector3::from(AXIS).normalize(), 1.1, 0.7),
        ball: (1.4, 2.5),
        wheel: |_| -loose_momentum(),
    };
    let first = gyrostat.state(OMEGA.into(), FLYWHEEL, BALL.into());
    let end = 7.0;
    let spin: [f64; 3] = gyrostat.spin(end, &gyrostat.after(first, end, 20_000)).into();
    for method in [Method::Explicit, Method::Implicit, Method::Automatic] {
        let mut samples = Vec::new();
        let options = Options { tolerance: 1e-13, method, ..Options::default() };
        let run = propagate_full(Forced::not(&body), &state, &[end], &options, &mut samples).unwrap();
        assert_eq!(run.outcome, Outcome::Finished);
        let last = samples[0];
        println!("{method:?} {last:?} {:?}", run.work);
        assert!(norm(add(last.omega, scale(-1.0, spin))) < 1e-10 * norm(spin), "{:?} {spin:?}", last.omega);
        assert!(last.energy_drift.abs() < 1e-10 * last.dissipated && last.dissipated > 1.0, "{last:?}");
    }
}

/// Without a wheel too a rotor can take up the angular momentum of the body: the body comes to rest. To the last bit, `Jω + I Q̇ a = 0`.
#[test]
fn a_flywheel_takes_up_the_momentum_of_the_body() {
    let carrier = parts::carrier(40.0, [0.0; 3], parts::diag([9.0, 13.0, 16.0]));
    let rotors = vec![flywheel([0.0, 0.0, 1.0], 2.0, 0.7)];
    let body = Assembly { carrier: Some(carrier), rotors, ..Assembly::default() }.body().unwrap();
    let mut state = FullState::at_rest(&body, [0.0, 0.0, 0.75], ALIGNED);
    state.rate[0] = -6.0;
    assert_eq!(state.angular_momentum(&body), [0.0; 3]);
    // (I − I²/C) Q̈ = −κ Q̇
    let left = (-0.7 * END / (2.0 - 4.0 / 16.0)).exp();
    for method in [Method::Explicit, Method::Implicit, Method::Automatic] {
        let options = Options { method, ..Options::default() };
        let run = propagate_full(Forced::not(&body), &state, &[END], &options, &mut Vec::new()).unwrap();
        println!("{method:?} {run:?}");
        assert_eq!(run.outcome, Outcome::Finished);
        assert!((run.last.omega[2] / 0.75 - left).abs() < 1e-11 && run.last.momentum_drift.abs() < 1e-12);
        let turned = angle_between(run.last.attitude, turned(ALIGNED, [0.0, 0.0, 0.75 * 2.5 * (1.0 - left)]));
        assert!(turned < 1e-10, "{turned:e}");
    }
}

/// Motors rotate a body from rest, `ω = −J⁻¹k(t)`, about an axis that is fixed in space. (C4)
#[test]
fn a_driven_wheel_turns_a_body_from_rest() {
    let speed = Expression::parse("5 * t + 2 * sin(0.8 * t)", &["t"]).unwrap();
    let axis = Vector3::new(0.3, 0.2, 1.0);
    let wheels = vec![wheel(axis.into(), WheelSpeed::Prescribed { inertia: 0.3, speed })];
    let body = Assembly { wheels, ..bare() }.body().unwrap();
    let end = 6.0_f64;
    let turned_by = |angle: f64| -> [f64; 3] {
        (-0.3 * angle * INERTIA.try_inverse().unwrap() * axis.normalize()).into()
    };
    let omega = turned_by(5.0 * end + 2.0 * (0.8 * end).sin());
    let attitude = turned(ALIGNED, turned_by(2.5 * end * end + 2.5 * (1.0 - (0.8 * end).cos())));
    let check = |name: &str, run: Run| {
        let (last, steps) = (run.last, run.work.steps);
        let apart = norm(add(last.omega, scale(-1.0, omega))) / norm(omega);
        let turn = angle_between(last.attitude, attitude);
        println!("{name}: {:?} {apart:e} {turn:e} {:e} in {steps} steps", run.outcome, last.energy_drift);
        assert_eq!(run.outcome, Outcome::Finished);
        assert!(apart < 1e-11 && turn < 1e-10 && last.energy_drift.abs() < 1e-10 * last.energy, "{last:?}");
    };
    let system = Forced::not(&body);
    let full = FullState::at_rest(&body, [0.0; 3], ALIGNED);
    for method in [Method::Explicit, Method::Implicit, Method::Automatic] {
        let options = Options { method, most_steps: 10_000, ..Options::default() };
        check(
            &format!("{method:?}"),
            propagate_full(system, &full, &[end], &options, &mut Vec::new()).unwrap(),
        );
    }
    let slow =
        SlowState { angular_momentum: [0.0; 3], attitude: ALIGNED, place: [0.0; 3], velocity: [0.0; 3] };
    let options = Options { most_steps: 10_000, ..Options::default() };
    check(
        "reduced",
        propagate_forced(SlowEquations::series(system, 1), &slow, &[end], &options, &mut Vec::new()).unwrap(),
    );
}
