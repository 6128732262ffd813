//! Ends of a propagation, and starts that it refuses.

use std::ops::ControlFlow;

use quasirigid::dynamics::{
    Forced, Form, FullState, Observer, Options, Outcome, PropagateError, Sample, Start, propagate,
    propagate_full, spin_path,
};
use quasirigid::model::ReducedBody;

use super::wobbler::{attitude, reduced, times_to};

const START: [f64; 3] = [0.5, -0.3, 0.9];

fn state(omega: [f64; 3]) -> Start {
    Start::new(omega, attitude())
}

/// Keeps samples and ends the run at the first sign of progress.
#[derive(Default)]
struct Impatient {
    samples: Vec<Sample>,
    asked: usize,
}

impl Observer for Impatient {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        assert!(t > 0.0);
        self.asked += 1;
        ControlFlow::Break(())
    }
}

fn whole(body: &ReducedBody, times: &[f64]) -> Vec<Sample> {
    let mut samples = Vec::new();
    let run = propagate(body, state(START), times, &Options::default(), &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    assert_eq!(run.last.t, times[times.len() - 1]);
    samples
}

/// The samples of an interrupted run are those of the whole run, bit for bit.
#[test]
fn an_interrupted_run_leaves_valid_samples() {
    let body = reduced(3);
    let times = times_to(3e4, 600);
    let mut observer = Impatient::default();
    let run = propagate(&body, state(START), &times, &Options::default(), &mut observer).unwrap();
    assert_eq!(run.outcome, Outcome::Interrupted);
    assert_eq!(observer.asked, 1);
    assert!(run.last.t > 0.0 && run.last.t < 3e4);
    let reached = times.iter().take_while(|t| **t <= run.last.t).count();
    assert_eq!(observer.samples.len(), reached);
    assert_eq!(observer.samples, whole(&body, &times)[..reached]);
}

#[test]
fn a_step_limit_leaves_valid_samples() {
    let body = reduced(3);
    let times = times_to(100.0, 50);
    let mut samples: Vec<Sample> = Vec::new();
    let options = Options { most_steps: 20, ..Options::default() };
    let run = propagate(&body, state(START), &times, &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::StepLimit);
    assert_eq!(run.work.steps, 20);
    let reached = times.iter().take_while(|t| **t <= run.last.t).count();
    assert!(reached > 0 && reached < 50);
    assert_eq!(samples, whole(&body, &times)[..reached]);
    let path = spin_path(&body, START, &times, &options).unwrap();
    assert_eq!(path.outcome, Outcome::StepLimit);
    assert!(!path.omega.is_empty() && path.omega.len() < 50);
}

/// Far outside its validity the angular-velocity form can run away in finite time; the samples before remain valid.
#[test]
fn a_runaway_ends_as_a_failure_with_valid_samples() {
    let body = reduced(4);
    let times = times_to(1e-3, 100);
    let mut samples: Vec<Sample> = Vec::new();
    let options = Options { form: Form::AngularVelocity, most_steps: 100_000, ..Options::default() };
    let run = propagate(&body, state([30.0, 30.0, 30.0]), &times, &options, &mut samples).unwrap();
    assert!(matches!(run.outcome, Outcome::Failed(_)), "{run:?}");
    assert!(run.last.t < 1e-3 && !samples.is_empty());
    assert_eq!(samples.len(), times.iter().take_while(|t| **t <= run.last.t).count());
    assert!(samples.iter().all(|sample| sample.omega.iter().all(|w| w.is_finite())));
}

/// Times may repeat and may be zero.
#[test]
fn samples_stand_at_the_times_asked_for() {
    let times = [0.0, 0.0, 1.5, 1.5, 4.0];
    let samples = whole(&reduced(3), &times);
    assert_eq!(samples.iter().map(|sample| sample.t).collect::<Vec<_>>(), times);
    assert_eq!(samples[2], samples[3]);
    assert_eq!(samples[0].dissipated, 0.0);
    for (found, asked) in samples[0].omega.iter().zip(START) {
        assert!((found - asked).abs() < 1e-14, "the run starts with the spin asked for");
    }
}

#[test]
fn a_run_without_times_ends_at_its_start() {
    let mut samples: Vec<Sample> = Vec::new();
    let run = propagate(&reduced(3), state(START), &[], &Options::default(), &mut samples).unwrap();
    assert_eq!((run.outcome, run.last.t, run.work.steps), (Outcome::Finished, 0.0, 0));
    assert!(samples.is_empty());
}

fn refused(omega: [f64; 3], times: &[f64], options: Options) -> Option<PropagateError> {
    let body = reduced(3);
    let mut samples: Vec<Sample> = Vec::new();
    let error = propagate(&body, state(omega), times, &options, &mut samples).err();
    assert!(error.is_none() || samples.is_empty(), "refused before the first step");
    // `spin_path` refuses the same input; NaN keeps errors from being compared.
    let other = spin_path(&body, omega, times, &options).err();
    assert_eq!(format!("{error:?}"), format!("{other:?}"));
    error
}

#[test]
fn what_is_no_spin_is_refused() {
    for omega in [[f64::NAN, 0.0, 1.0], [0.0, f64::INFINITY, 0.0]] {
        let error = refused(omega, &[1.0], Options::default());
        assert!(matches!(error, Some(PropagateError::NoSpin { .. })), "{error:?}");
    }
    for rest_and_slow in [[0.0; 3], [0.0, 0.0, 1e-100]] {
        assert_eq!(refused(rest_and_slow, &[1.0], Options::default()), None);
    }
}

#[test]
fn tolerances_are_refused_on_both_sides_of_their_range() {
    let at = |tolerance: f64| refused(START, &[0.1], Options { tolerance, ..Options::default() });
    for tolerance in [0.999e-15, 1.001e-2, 0.0, -1e-6, f64::NAN, f64::INFINITY] {
        assert!(matches!(at(tolerance), Some(PropagateError::Tolerance { .. })), "{tolerance}");
    }
    assert_eq!((at(1e-15), at(1e-2)), (None, None));
}

#[test]
fn times_that_do_not_ascend_are_refused() {
    for times in [&[-1.0][..], &[1.0, 0.5], &[f64::NAN], &[0.1, f64::INFINITY], &[1.0, 2.0, f64::NAN]] {
        let error = refused(START, times, Options::default());
        assert!(matches!(error, Some(PropagateError::Times { .. })), "{times:?}: {error:?}");
    }
    let error = refused(START, &[0.5, 2.0, 1.0], Options::default());
    assert_eq!(error, Some(PropagateError::Times { t: 1.0, before: 2.0 }));
}

/// A spin beyond the largest that the truncated series reaches has no angular momentum.
#[test]
fn a_spin_without_momentum_is_refused() {
    assert_eq!(
        refused([300.0, -200.0, 400.0], &[1.0], Options::default()),
        Some(PropagateError::NoAngularMomentum)
    );
}

/// A state of another body: other coordinates, or other rates.
#[test]
fn a_state_of_another_body_is_refused() {
    let body = super::wobbler::assembly().body().unwrap();
    let needed = body.coordinates().len();
    let good = FullState::at_rest(&body, START, attitude());
    for (coordinates, rates) in [(0, needed), (needed, needed + 1), (0, 0)] {
        let state = FullState { q: vec![0.0; coordinates], rate: vec![0.0; rates], ..good.clone() };
        let found = propagate_full(
            Forced::not(&body),
            &state,
            &[1.0],
            &Options::default(),
            &mut Impatient::default(),
        );
        assert_eq!(found.err(), Some(PropagateError::Coordinates { coordinates, rates, needed }));
    }
}

/// Starts that are no attitude, or no number, are refused before the first step.
#[test]
fn a_start_that_is_no_state_is_refused() {
    let body = reduced(3);
    let with = |attitude| {
        let initial = Start { attitude, ..state(START) };
        propagate(&body, initial, &[1.0], &Options::default(), &mut Vec::<Sample>::new()).err()
    };
    assert!(matches!(with([f64::NAN; 4]), Some(PropagateError::Attitude { .. })));
    assert!(matches!(with([0.0; 4]), Some(PropagateError::Attitude { .. })));
    assert_eq!(with([0.0, 0.0, 1.0, 0.0]), None);
}
