//! Mean power of periodic motions of the full system against short runs of it and against the harmonics of light parts. (Q19)

use std::ops::ControlFlow;

use nalgebra::{Rotation3, Vector3};
use quasirigid::averaging::{Evolution, FreeRotation, HillResponse, MeanPower, RotationState};
use quasirigid::elements::{Assembly, Carrier, End, HingeCoefficient, Hinged};
use quasirigid::model::{Mode, Principal, Rheology};
use quasirigid::secular::{
    EnergyRange, MeasureError, MeasureOptions, MeasuredBy, MeasuredPower, Measurement, Places, Poles,
};

use crate::support::parts;
use crate::support::rotors::{ball, flywheel};
use crate::support::transform::{Units, rescaled, rotated};

/// Measurement near a rotation state with the angular momentum of a spin (rad/s) about the axis of greatest inertia; none within the range of the
/// reduced equations about the spin, which need none.
fn measured(
    assembly: &Assembly,
    spin: f64,
    state: RotationState,
    places: Places,
) -> Result<Option<Measurement>, MeasureError> {
    let body = assembly.body().expect("a body");
    let moments = Principal::compute(body.invariants().J).moments;
    let range = EnergyRange::compute(&body, spin * moments[2]).expect("a range");
    let poles = Poles::compute(&body, &range).expect("poles");
    let ends = [RotationState { xi: state.xi - 0.01, ..state }, state];
    let go_on = &mut |_: f64| ControlFlow::Continue(());
    let options = MeasureOptions::default();
    let found = MeasuredPower::along(&body, &range, &poles, (ends, places), &options, go_on)?;
    let wanted =
        if places == Places::PeriodicMotions { MeasuredBy::PeriodicMotion } else { MeasuredBy::ShortRun };
    Ok(found.measurements.into_iter().rfind(|each| each.by == wanted))
}

/// Power (W) of the periodic motion whose mean energy is that of a rotation state, and its relative error. The forced motion of heavy parts adds
/// to the energy of a motion through a given place, so that the place is moved until it has.
fn power(assembly: &Assembly, spin: f64, state: RotationState) -> Result<Option<[f64; 2]>, MeasureError> {
    let mut at = state;
    for _ in 0..20 {
        let Some(found) = measured(assembly, spin, at, Places::PeriodicMotions)? else { return Ok(None) };
        let gap = state.xi - found.rotation_state.xi;
        if gap.abs() < 1e-4 {
            return Ok(Some([found.power, found.error]));
        }
        at.xi += gap;
    }
    panic!("no motion at {state:?}")
}

/// A carrier without symmetry, its centre off the origin.
fn carrier() -> Carrier {
    parts::carrier(30.0, [0.1, -0.2, 0.05], [[9.0, 0.3, -0.2], [0.3, 12.0, 0.5], [-0.2, 0.5, 16.0]])
}

/// Two masses on skew lines: their share of the mass, and their frequencies (rad/s).
fn masses(mass: f64, frequencies: [f64; 2], damping: f64) -> Assembly {
    let places = [[0.9, 0.3, 0.4], [-0.5, 0.8, -0.6]];
    let lines = [[0.3, -0.4, 0.9], [0.8, 0.5, 0.2]];
    let point = |i: usize| parts::line_point(format!("mass {i}"), mass, places[i], lines[i]);
    let spring = |i: usize| {
        let stiffness = mass * frequencies[i] * frequencies[i];
        let law = parts::isotropic(stiffness, 2.0 * damping * mass * frequencies[i]);
        parts::spring(End::Point(i), End::Carrier, law)
    };
    Assembly {
        carrier: Some(carrier()),
        points: (0..2).map(point).collect(),
        springs: (0..2).map(spring).collect(),
        ..Assembly::default()
    }
}

/// A heavy arm on a hinge, whose displacement is along a curved path.
fn hinged() -> Assembly {
    let arm = Hinged {
        name: "arm".into(),
        mass: 2.0,
        center_of_mass: [0.9, 0.25, 0.4],
        inertia: parts::diag([0.05, 0.3, 0.32]),
        hinge: [0.5, 0.1, 0.1],
        axes: vec![[0.0, 0.6, 0.8]],
        stiffness: HingeCoefficient::PerAxis(vec![12.0]),
        damping: HingeCoefficient::PerAxis(vec![0.6]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    };
    Assembly { carrier: Some(carrier()), hinged: vec![arm], ..Assembly::default() }
}

fn rotors() -> Assembly {
    Assembly {
        carrier: Some(carrier()),
        rotors: vec![flywheel([0.3, 1.0, -0.5], 0.2, 0.05), ball(0.05, 0.02)],
        ..Assembly::default()
    }
}

/// Heavy masses, half of the frequency of which the spin reaches, a hinged arm and rotors, in both modes, next to the axis and near the
/// separatrix.
#[test]
fn periodic_motions_have_the_power_of_short_runs() {
    let bodies = [(masses(2.0, [2.5, 3.1], 0.02), 1.0), (hinged(), 0.5), (rotors(), 0.3)];
    let mut compared = 0;
    for (assembly, spin) in &bodies {
        for (mode, xi) in [(Mode::ShortAxis, -0.5), (Mode::ShortAxis, -2.0), (Mode::LongAxis, -0.5)] {
            let Ok(Some(run)) = measured(assembly, *spin, RotationState { mode, xi }, Places::ShortRuns)
            else {
                continue;
            };
            let Some([periodic, error]) = power(assembly, *spin, run.rotation_state).expect("a motion")
            else {
                continue;
            };
            let gap = (periodic / run.power - 1.0).abs();
            println!("{mode:?} {xi}: {periodic:.6e} W, off {gap:.1e} of {error:.1e} and {:.1e}", run.error);
            assert!(gap < error + run.error + 1e-3, "{mode:?} {xi}: {periodic:e} {:e}", run.power);
            compared += 1;
        }
    }
    assert!(compared >= 6, "{compared}");
}

/// Light masses in resonance with a harmonic of the polhode and away from it: the power of the harmonics, another mathematics.
#[test]
fn light_parts_take_the_power_of_the_harmonics() {
    let mut compared = 0;
    let places =
        [(Mode::ShortAxis, 0.2), (Mode::LongAxis, -1.0), (Mode::LongAxis, 0.1), (Mode::ShortAxis, -3.5)];
    for (mode, xi) in places {
        for frequency in [2.3, 3.1, 9.0] {
            let assembly = masses(1e-5, [frequency, 1.3 * frequency], 0.08);
            let Some([periodic, error]) =
                power(&assembly, 1.0, RotationState { mode, xi }).expect("a motion")
            else {
                continue;
            };
            let body = assembly.body().expect("a body");
            let moments = Principal::compute(body.invariants().J).moments;
            let motion = FreeRotation::at_logit(moments, moments[2], mode, xi);
            let harmonics = HillResponse::compute(&body).expect("a response").mean_power(&motion);
            let gap = (periodic / harmonics - 1.0).abs();
            println!("{mode:?} {xi} {frequency}: {periodic:.6e} W, off {gap:.1e} of {error:.1e}");
            assert!(
                gap < 1e-3 && error < 5e-3,
                "{mode:?} {xi} {frequency}: {periodic:e} {harmonics:e} {error:e}"
            );
            compared += 1;
        }
    }
    assert!(compared >= 8, "{compared}");
}

/// A rotor along the axis of the spin is not turned by a small wobble at first order: the power goes as the square of the energy of the wobble,
/// whose inverse grows evenly, down to wobbles far smaller than those at which modes give the power of other bodies.
#[test]
fn a_wobble_that_no_mode_damps_falls_by_a_power_law() {
    let mut assembly = Assembly::default().with(Carrier::principal(55.0, [11.0, 22.0, 27.6]));
    assembly.rotors = vec![flywheel([0.0, 0.0, 1.0], 0.55, 0.93)];
    let body = assembly.body().expect("a body");
    let range = EnergyRange::compute(&body, 3.7).expect("a range");
    let poles = Poles::compute(&body, &range).expect("poles");
    assert_eq!(poles.rate(Mode::ShortAxis), Some(0.0));
    let at = |degrees: f64| {
        let xi = FreeRotation::logit_of(range.moments(), Mode::ShortAxis, degrees.to_radians());
        RotationState { mode: Mode::ShortAxis, xi }
    };
    let go_on = &mut |_: f64| ControlFlow::Continue(());
    let ends = ([at(3.0), at(0.1)], Places::PeriodicMotions);
    let power = MeasuredPower::along(&body, &range, &poles, ends, &MeasureOptions::default(), go_on)
        .expect("a power");
    let evolution = Evolution::new(&power, range.angular_momentum());
    let energy = |degrees: f64| evolution.motion(at(degrees)).energy_from_axis();
    let rate = (1.0 / energy(2.0) - 1.0 / energy(3.0)) / evolution.time(at(3.0), at(2.0));
    for degrees in [1.0, 0.3, 0.1] {
        let law = (1.0 / energy(degrees) - 1.0 / energy(3.0)) / rate;
        let time = evolution.time(at(3.0), at(degrees));
        assert!((time / law - 1.0).abs() < 0.02, "{degrees}: {time} s, {law} s");
    }
}

/// The power turns with the axes, and scales as a power does.
#[test]
fn the_power_knows_no_axes_and_no_units() {
    let assembly = masses(2.0, [2.1, 2.6], 0.05);
    let state = RotationState { mode: Mode::ShortAxis, xi: -0.5 };
    let at = |assembly: &Assembly, spin: f64| {
        power(assembly, spin, state).expect("a motion").expect("a place of its own")[0]
    };
    let known = at(&assembly, 1.0);
    let R = Rotation3::new(Vector3::new(0.7, -1.3, 0.4));
    assert!((at(&rotated(&assembly, R.matrix()), 1.0) / known - 1.0).abs() < 1e-5);
    let units = Units { length: 1e3, mass: 1e-4, time: 60.0 };
    let scaled = at(&rescaled(&assembly, units), 1.0 / units.time);
    assert!((scaled / (known * units.factor([2, 1, -3])) - 1.0).abs() < 1e-5);
}

/// A mass so weakly damped that the rotation drives it by its changing centrifugal stiffness grows: that is no state to be averaged.
#[test]
fn a_vibration_that_grows_is_told() {
    let grows = (0..40).any(|i| {
        let assembly = masses(1.0, [0.6 + 0.03 * f64::from(i), 3.1], 1e-6);
        let state = RotationState { mode: Mode::LongAxis, xi: -1.0 };
        matches!(power(&assembly, 1.0, state), Err(MeasureError::Grows { rate }) if rate > 0.0)
    });
    assert!(grows);
}
