//! From one pole to the other: the power is that of the reduced equations about either spin within their ranges, and of short runs between.

use std::ops::ControlFlow;

use quasirigid::averaging::{Evolution, RotationState};
use quasirigid::elements::Assembly;
use quasirigid::model::Mode;
use quasirigid::prelude::Carrier;
use quasirigid::secular::{
    DirectOptions, DirectStopReason, EnergyRange, MeasureOptions, MeasuredBy, MeasuredPower, Places, Poles,
    follow_directly,
};

use crate::support::rotors::{ball, flywheel};

use super::body_of;

/// A body with rotors followed through the separatrix: the hand-overs are told, part of the power needs no run, and times of sections are
/// those of the full system, within the range of the equations about the spin and across the separatrix. (Q11)
#[test]
fn a_body_followed_through_the_separatrix_hands_over_from_manifolds_to_short_runs() {
    let mut assembly = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    assembly.rotors = vec![flywheel([0.3, 1.0, -0.5], 0.2, 200.0), ball(0.05, 20.0)];
    let body = body_of(&assembly);
    let range = EnergyRange::compute(&body, 16.0).unwrap();
    let poles = Poles::compute(&body, &range).unwrap();
    let long = |xi: f64| RotationState { mode: Mode::LongAxis, xi };
    let short = |xi: f64| RotationState { mode: Mode::ShortAxis, xi };
    let ends = [long(2.0), short(3.0)];
    let go_on = &mut |_: f64| ControlFlow::Continue(());
    let power = MeasuredPower::along(
        &body,
        &range,
        &poles,
        (ends, Places::ShortRuns),
        &MeasureOptions::default(),
        go_on,
    )
    .unwrap();
    let reduced = power.measurements.iter().filter(|each| each.by == MeasuredBy::SpinManifold).count();
    println!("{:?}, {reduced} of {} without a run", power.boundaries, power.measurements.len());
    assert_eq!(power.boundaries.len(), 2);
    assert!(power.boundaries.iter().all(|edge| edge.nutation > 0.4 && edge.mismatch < 1e-3));
    assert!(reduced > 2 && reduced < power.measurements.len());
    let evolution = Evolution::new(&power, range.angular_momentum());
    for (from, to) in [(long(2.0), long(1.4)), (long(-2.0), short(-2.0))] {
        let averaged = evolution.time(from, to);
        let start = range.state(&body, from).unwrap();
        let options = DirectOptions {
            until: Some(evolution.motion(to).energy()),
            duration: f64::MAX,
            most_revolutions: 1e5,
            most_steps: 50_000_000,
            tolerance: 1e-10,
        };
        let run = follow_directly(&body, &start, &options, go_on).unwrap();
        let time = run.rows.last().unwrap().t;
        println!("{averaged} s, the full system {time} s");
        assert!(
            run.ending == DirectStopReason::Reached && (averaged / time - 1.0).abs() < 5e-3,
            "{averaged} {time}"
        );
    }
}
