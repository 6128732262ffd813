//! From one pole to the other: the power is that of the reduced equations about either spin within their ranges, and of short runs between.

use std::ops::ControlFlow;

use quasirigid::averaging::{Evolution, RotationState};
use quasirigid::elements::Assembly;
use quasirigid::model::Mode;
use quasirigid::prelude::Carrier;
use quasirigid::secular::{
    DirectOptions, DirectStopReason, EnergyRange, MeasureOptions, MeasuredPower, Poles, follow_directly,
};

use crate::support::rotors::{ball, flywheel};

use super::body_of;

/// A body with rotors that hold a notable share of its inertia, followed through the separatrix: the time is that of the full system, the
/// hand-overs are told, and most of the power needs no run. (Q11)
#[test]
fn a_body_followed_through_the_separatrix_hands_over_from_manifolds_to_short_runs() {
    let mut assembly = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    assembly.rotors = vec![flywheel([0.3, 1.0, -0.5], 0.25, 0.8), ball(0.1, 0.4)];
    let body = body_of(&assembly);
    let range = EnergyRange::compute(&body, 16.0).unwrap();
    let poles = Poles::compute(&body, &range).unwrap();
    let ends =
        [RotationState { mode: Mode::LongAxis, xi: 2.0 }, RotationState { mode: Mode::ShortAxis, xi: 3.0 }];
    let go_on = &mut |_: f64| ControlFlow::Continue(());
    let power = MeasuredPower::along(&body, &range, &poles, ends, &MeasureOptions::default(), go_on).unwrap();
    let reduced = power.measurements.iter().filter(|each| each.reduced).count();
    let runs = power.measurements.len() - reduced;
    println!("{:?}, {reduced} of {} without a run", power.hand_overs, power.measurements.len());
    assert_eq!(power.hand_overs.len(), 2);
    assert!(power.hand_overs.iter().all(|edge| edge.nutation > 0.3 && edge.mismatch < 5e-3));
    assert!(reduced > 0 && runs > 0);
    let evolution = Evolution::new(&power, range.angular_momentum());
    let averaged = evolution.time(ends[0], ends[1]);
    let start = range.state(&body, ends[0]).unwrap();
    let options = DirectOptions {
        until: Some(evolution.motion(ends[1]).energy()),
        duration: f64::MAX,
        most_revolutions: 1e5,
        most_steps: 50_000_000,
        tolerance: 1e-10,
    };
    let run = follow_directly(&body, &start, &options, go_on).unwrap();
    assert_eq!(run.ending, DirectStopReason::Reached);
    let time = run.rows.last().unwrap().t;
    println!("{averaged} s, the full system {time} s");
    assert!((averaged / time - 1.0).abs() < 0.01, "{averaged} {time}");
}
