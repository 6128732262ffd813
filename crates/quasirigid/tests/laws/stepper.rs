//! Steps under held torques are the histories of the same torques. (T1), (R22)

use nalgebra::Vector3;
use quasirigid::dynamics::{
    Forced, FullState, FullStepper, Method, Options, ReducedStepper, Sample, Start, StepStatus, StepperError,
    propagate, propagate_full,
};
use quasirigid::model::FlexibleBody;
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave, Windows};
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;
use quasirigid::rotation::ALIGNED;

use super::linear::{Rows, satellite};

type V = Vector3<f64>;

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    (V::from(a) - V::from(b)).norm()
}

/// A torque (N·m) for each stretch of so many steps.
const TORQUES: [[f64; 3]; 4] = [[0.4, -0.2, 0.3], [0.0; 3], [-0.6, 0.1, 0.5], [0.2, 0.8, -0.7]];
const STEP: f64 = 0.02;
const STEPS: usize = 25;

/// The state at the end of each torque by histories, one after the other.
fn by_histories(body: &FlexibleBody, start: &FullState, options: &Options) -> Vec<FullState> {
    let mut state = start.clone();
    let after = |torque: [f64; 3]| {
        let wave = Wave { frequency: 0.0, phase: 0.0 };
        let law = ForceLaw::Torque { torque, axes: Axes::Body, wave };
        let forces = [Force { name: "held".into(), law }];
        let mut rows = Rows::default();
        let system = Forced { body, forces: &forces };
        propagate_full(system, &state, &[0.0, STEPS as f64 * STEP], options, &mut rows).unwrap();
        let (Sample { omega, attitude, .. }, q, rate) = rows.rows.pop().unwrap();
        state = FullState { omega, attitude, q, rate, ..state.clone() };
        state.clone()
    };
    TORQUES.map(after).to_vec()
}

#[test]
fn steps_of_the_full_system_are_its_histories() {
    let body = satellite().body().unwrap();
    let start = FullState::at_rest(&body, [0.3, -0.1, 0.8], ALIGNED);
    for method in [Method::Automatic, Method::Implicit] {
        let options = Options { tolerance: 1e-13, method, ..Options::default() };
        let expected = by_histories(&body, &start, &options);
        let mut stepper = FullStepper::new(Forced::not(&body), &start, options).unwrap();
        for (torque, expected) in TORQUES.iter().zip(&expected) {
            for _ in 0..STEPS {
                assert_eq!(stepper.step(*torque, STEP), Ok(StepStatus::Holds));
            }
            let found = stepper.state();
            assert!(
                gap(found.omega, expected.omega) < 1e-9,
                "{method:?}: {:e}",
                gap(found.omega, expected.omega)
            );
            let turned = (0..4).map(|i| (found.attitude[i] - expected.attitude[i]).abs()).fold(0.0, f64::max);
            let moved = found.q.iter().zip(&expected.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(turned < 1e-9 && moved < 1e-9, "{method:?}: {turned:e} {moved:e}");
        }
        // put back to the start, the same torque leads to the same place
        stepper.place(&start).unwrap();
        (0..STEPS).for_each(|_| assert_eq!(stepper.step(TORQUES[0], STEP), Ok(StepStatus::Holds)));
        assert!(gap(stepper.state().omega, expected[0].omega) < 1e-9 && (stepper.time() - 0.5).abs() < 1e-12);
    }
}

#[test]
fn steps_of_reduced_equations_are_their_history_and_follow_torques() {
    let body = ring_of_points(3).body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    let start = Start::new([0.1, 0.05, 0.6], ALIGNED);
    let mut stepper = ReducedStepper::new(&reduced, start, 1e-12).unwrap();
    let options = Options { tolerance: 1e-13, ..Options::default() };
    let mut samples: Vec<Sample> = Vec::new();
    propagate(&reduced, start, &[0.0, 4.0], &options, &mut samples).unwrap();
    (0..200).for_each(|_| assert_eq!(stepper.step([0.0; 3], STEP), Ok(StepStatus::Holds)));
    assert!(gap(stepper.omega(), samples[1].omega) < 1e-11, "{:e}", gap(stepper.omega(), samples[1].omega));
    assert!((stepper.energy() / samples[1].energy - 1.0).abs() < 1e-12);
    // a torque turns the body as it turns the full system, but for how it bends it
    let system = Forced::not(&body);
    let settled = start.settled(system, 3).unwrap();
    let mut full = FullStepper::new(system, &settled, Options::default()).unwrap();
    stepper.place(start).unwrap();
    let mut work = 0.0;
    let before = stepper.energy();
    for torque in TORQUES.map(|torque| torque.map(|entry| 0.02 * entry)) {
        for _ in 0..STEPS {
            let first = stepper.omega();
            assert_eq!(stepper.step(torque, STEP), Ok(StepStatus::Holds));
            full.step(torque, STEP).unwrap();
            work += 0.5 * STEP * V::from(torque).dot(&(V::from(first) + V::from(stepper.omega())));
        }
    }
    assert!(
        gap(stepper.omega(), full.state().omega) < 2e-4,
        "{:e}",
        gap(stepper.omega(), full.state().omega)
    );
    let gained = stepper.energy() - before;
    assert!(work.abs() > 1e-4 && (gained / work - 1.0).abs() < 0.05, "{gained:e} {work:e}");
}

#[test]
fn what_no_step_takes_is_refused_and_ranges_are_told() {
    let body = ring_of_points(2).body().unwrap();
    let reduced = reduce(&body, 2).unwrap();
    let start = Start::new([0.0, 0.0, 0.5], ALIGNED);
    let mut stepper = ReducedStepper::new(&reduced, start, 1e-10).unwrap().within([0.55, 0.6]);
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(stepper.step([0.0; 3], dt), Err(StepperError::Step { .. })));
    }
    assert!(matches!(stepper.step([0.0, f64::NAN, 0.0], 0.1), Err(StepperError::Torque { .. })));
    assert_eq!(stepper.step([0.0; 3], 0.1), Ok(StepStatus::Holds));
    for (spin, status) in [(0.57, StepStatus::Marginal), (0.7, StepStatus::Fails)] {
        stepper.place(Start::new([0.0, 0.0, spin], ALIGNED)).unwrap();
        assert_eq!(stepper.step([0.0; 3], 0.1), Ok(status));
    }
    // a torque that would reach such a spin within a radian counts as that
    stepper.place(start).unwrap();
    assert_eq!(stepper.step([200.0, 0.0, 0.0], 1e-6), Ok(StepStatus::Fails));
    assert!(ReducedStepper::new(&reduced, start, 1.0).is_err());
    let rest = FullState::at_rest(&body, [0.0; 3], ALIGNED);
    let wave = Wave { frequency: 0.0, phase: 0.0 };
    let push = ForceLaw::Torque { torque: [0.1, 0.0, 0.0], axes: Axes::Body, wave };
    let windows = Windows::new(vec![[0.1, 0.2]]).unwrap();
    let law = ForceLaw::During { windows, law: Box::new(push) };
    let forces = [Force { name: "burn".into(), law }];
    let refused =
        FullStepper::new(Forced { body: &body, forces: &forces }, &rest, Options::default()).unwrap_err();
    assert!(refused.to_string().contains("\"burn\" changes at given times"), "{refused}");
    // from rest, by a torque alone
    let mut still = FullStepper::new(Forced::not(&body), &rest, Options::default()).unwrap();
    assert_eq!(still.step([0.1, 0.0, 0.0], 0.05), Ok(StepStatus::Holds));
    assert!(still.state().omega[0] > 0.0);
}
