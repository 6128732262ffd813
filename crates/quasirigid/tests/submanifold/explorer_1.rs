//! Explorer 1 as it flew: a spin 12.6 times the frequency of its whips. `[@pydy]`

use quasirigid::dynamics::{Forced, FullState, Options, Outcome, Sample, propagate_full};
use quasirigid::model::Mode;
use quasirigid::problems::Explorer1;
use quasirigid::submanifold::{Masters, SpinManifoldPlan, Style, propagate_on_manifold};
use quasirigid_math::rotation::ALIGNED;

use super::{body_of, derived};

/// Growth rate (1/s) of a small nutation about the spin of 750 rpm, from an independent linearisation of the whole satellite.
const GROWTH: f64 = 0.074_415_60;

fn plan(angular_momentum: [f64; 3], degree: usize) -> SpinManifoldPlan {
    let (mode, masters, style) = (Mode::LongAxis, Masters::Nutation, Style::NormalForm);
    SpinManifoldPlan { mode, angular_momentum, masters, degree, style }
}

/// Nutation angle (degrees) from the axis of the tube.
fn nutation(sample: &Sample) -> f64 {
    let K = sample.angular_momentum;
    K[0].hypot(K[1]).atan2(K[2]).to_degrees()
}

#[test]
fn a_small_nutation_grows_as_published() {
    let body = body_of(&Explorer1::FLOWN.assembly());
    let spinning = FullState::at_rest(&body, [0.0, 0.0, Explorer1::SPIN], ALIGNED);
    let manifold = derived(&body, &plan(spinning.angular_momentum(&body), 1));
    // Eight digits are printed.
    assert!((manifold.masters[0].decay_rate / -GROWTH - 1.0).abs() < 1e-7, "{:?}", manifold.masters);
}

/// From 0.1° to the edge of the range the nutation of the reduced equations is that of the full satellite.
#[test]
fn the_nutation_is_that_of_the_full_satellite_to_the_edge_of_the_range() {
    let body = body_of(&Explorer1::FLOWN.assembly());
    let spinning = FullState::at_rest(&body, [0.0, 0.0, Explorer1::SPIN], ALIGNED);
    let manifold = derived(&body, &plan(spinning.angular_momentum(&body), 9));
    let range = manifold.range(0.01).nutation.to_degrees();
    assert!(range > 38.0, "{range}");
    let state = manifold.full_state(&[[0.1_f64.to_radians(), 0.0]], ALIGNED);
    let start = manifold.start(&state);
    let times: Vec<f64> = (0..=900).map(|i| 0.1 * f64::from(i)).collect();
    let options = Options { tolerance: 1e-11, ..Options::default() };
    let (mut full, mut reduced): (Vec<Sample>, Vec<Sample>) = Default::default();
    propagate_full(Forced::not(&body), &state, &times, &options, &mut full).unwrap();
    let run = propagate_on_manifold(&manifold, &start, &times, &options, &mut reduced).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    let mut widest = 0.0;
    for (full, reduced) in full.iter().zip(&reduced).take_while(|(full, _)| nutation(full) < range) {
        let gap = nutation(reduced) / nutation(full) - 1.0;
        assert!(gap.abs() < 0.01, "{} s: {} {}", full.t, nutation(full), nutation(reduced));
        widest = nutation(full);
    }
    println!("range {range} degrees, followed to {widest}");
    assert!(widest > 0.95 * range);
}

/// The published motion starts with straight whips at a nutation of 24°, and reaches 30° and 45° after 2.94 and 8.97 s.
#[test]
fn the_published_history_is_followed_to_the_edge_of_the_range() {
    let body = body_of(&Explorer1::FLOWN.assembly());
    let flown = FullState::at_rest(&body, [0.75, 0.75, Explorer1::SPIN], ALIGNED);
    let manifold = derived(&body, &plan(flown.angular_momentum(&body), 11));
    let start = manifold.start(&flown);
    let times: Vec<f64> = (0..=1000).map(|i| 0.01 * f64::from(i)).collect();
    let mut samples: Vec<Sample> = Vec::new();
    propagate_on_manifold(&manifold, &start, &times, &Options::default(), &mut samples).unwrap();
    for (angle, published) in [(30.0, 2.94), (45.0, 8.97)] {
        let reached = samples.iter().find(|sample| nutation(sample) >= angle).unwrap().t;
        assert!((reached / published - 1.0).abs() < 0.005, "{angle} degrees after {reached} s");
    }
}
