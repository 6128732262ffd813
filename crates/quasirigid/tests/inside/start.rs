//! Rotors that start with a speed of their own.

use quasirigid::dynamics::{
    BoundaryLayer, Forced, FullState, Options, Outcome, Sample, Start, matched_start, propagate,
    propagate_full, slow_state_point,
};
use quasirigid::elements::Assembly;
use quasirigid::model::FlexibleBody;
use quasirigid::reduction::reduce;
use quasirigid_math::vec3::{add, norm, scale};

use super::bodies::{bare, cavity, sprung};
use crate::support::rotors::{ball, flywheel};

const OMEGA: [f64; 3] = [0.5, 0.7, 0.9];
const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
const END: f64 = 6.0;

/// Body with flywheel, ball, liquid and sprung mass.
fn body() -> FlexibleBody {
    let (point, spring) = sprung();
    Assembly {
        points: vec![point],
        springs: vec![spring],
        rotors: vec![flywheel([0.3, 1.0, -0.5], 1.1, 9.0), ball(0.7, 8.0)],
        cavities: vec![cavity([0.5; 3], 400.0, 0.2)],
        ..bare()
    }
    .body()
    .unwrap()
}

/// Undisplaced state, with all internal elements in motion relative to the body.
fn released(body: &FlexibleBody) -> FullState {
    let mut state = FullState::at_rest(body, OMEGA, ALIGNED);
    for (i, j) in body.cyclic().enumerate() {
        state.rate[j] = 0.4 * (1.0 + i as f64).sin();
    }
    state
}

fn full(body: &FlexibleBody, start: &FullState, times: &[f64]) -> Vec<Sample> {
    let mut samples = Vec::new();
    let options = Options { tolerance: 1e-12, ..Options::default() };
    let run = propagate_full(Forced::not(body), start, times, &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    samples
}

/// Released with speeds of their own: the slow motion from the matched start is right to `ε²`, without the rotation of the start to `ε`.
/// (B2), (C8)
#[test]
fn the_matched_start_gains_an_order() {
    let [matched, plain]: [Vec<f64>; 2] = [true, false].map(|turned| {
        [0.25, 0.125, 0.0625]
            .map(|epsilon| {
                let body = body().stiffened(epsilon).unwrap();
                let start = released(&body);
                let reduced = reduce(&body, 3).unwrap();
                let slow = matched_start(Forced::not(&body), 3, &start).unwrap();
                let (angular_momentum, attitude) = if turned {
                    (slow.angular_momentum, slow.attitude)
                } else {
                    (start.angular_momentum(&body), ALIGNED)
                };
                let initial = Start::new(reduced.Omega.vector(angular_momentum), attitude);
                let mut samples = Vec::new();
                propagate(&reduced, initial, &[END], &Options::default(), &mut samples).unwrap();
                let truth = full(&body, &start, &[END])[0];
                norm(add(truth.omega, scale(-1.0, samples[0].omega)))
            })
            .to_vec()
    });
    let order = |gaps: &[f64]| (gaps[1] / gaps[2]).log2();
    println!("{matched:?} {plain:?}");
    assert!((order(&matched) - 2.0).abs() < 0.3, "{matched:?}");
    assert!((order(&plain) - 1.0).abs() < 0.3, "{plain:?}");
}

/// Slow and fast part together start where the full motion does. (B1)
#[test]
fn slow_and_fast_part_are_the_start_of_the_full_motion() {
    let gaps = [0.25, 0.125].map(|epsilon| {
        let body = body().stiffened(epsilon).unwrap();
        let start = released(&body);
        let layer = BoundaryLayer::compute(Forced::not(&body), 3, &start).unwrap();
        let at_start = layer.at(0.0);
        let slow = matched_start(Forced::not(&body), 3, &start).unwrap();
        let slaved = slow_state_point(Forced::not(&body), 3, &slow).unwrap().rate;
        let gap = body.cyclic().map(|j| (at_start.rate[j] + slaved[j] - start.rate[j]).abs());
        gap.fold(0.0, f64::max)
    });
    assert!(gaps.iter().all(|gap| *gap < 1e-9), "{gaps:?}");
}
