//! What modes tell of a rotor that a wobble does not turn, and of the sense and the place of a steady spin, in any axes. (M1), (M25)

use nalgebra::{Matrix3, Rotation3, Vector3};
use quasirigid::elements::{Assembly, Carrier, RotorKind, Wheel, WheelSpeed};
use quasirigid::model::Mode;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid::secular::EnergyRange;
use quasirigid_math::random::Random;

use crate::support::rotors::flywheel;
use crate::support::transform::rotated;
use crate::support::{Sprung, sprung_body};

fn any_rotation(random: &mut Random) -> Matrix3<f64> {
    let vector = Vector3::from([0, 1, 2].map(|_| 6.0 * random.unit() - 3.0));
    *Rotation3::new(vector).matrix()
}

/// The body with all its axes turned, rotors and wheels too.
fn turned(assembly: &Assembly, R: &Matrix3<f64>) -> Assembly {
    let mut turned = rotated(assembly, R);
    let along = |axis: &mut [f64; 3]| *axis = (R * Vector3::from(*axis)).into();
    for rotor in &mut turned.rotors {
        if let RotorKind::Flywheel { axis } = &mut rotor.kind {
            along(axis);
        }
    }
    turned.wheels.iter_mut().for_each(|wheel| along(&mut wheel.axis));
    turned
}

/// Decay rate of the nutation about an axis, in units of its frequency.
fn decay(assembly: &Assembly, mode: Mode, towards: [f64; 3]) -> f64 {
    let body = assembly.body().expect("a body");
    let given = SpinMagnitude::AngularMomentum(7.0);
    let spin = RelativeEquilibrium::extreme_towards(&body, mode, given, towards).expect("a steady spin");
    let modes = SpinModes::about(&body, spin).expect("modes");
    let nutation = modes.nutation().expect("a nutation");
    nutation.decay_rate / nutation.frequency.max(1e-300)
}

/// A rotor along the axis of the spin is not turned by a small wobble, which neither decays nor grows in any axes; about the other axis it damps.
#[test]
fn a_rotor_along_the_axis_of_spin_does_not_damp() {
    let mut random = Random::new(5);
    for (axis, mode, other) in [
        ([1.0, 0.0, 0.0], Mode::LongAxis, Mode::ShortAxis),
        ([0.0, 0.0, 1.0], Mode::ShortAxis, Mode::LongAxis),
    ] {
        for apart in [0.3, 1e-4, 1e-9, 3e-11] {
            let mut assembly =
                Assembly::default().with(Carrier::principal(10.0, [2.0, 4.1, 4.1 * (1.0 + apart)]));
            assembly.rotors = vec![flywheel(axis, 0.08, 3.0)];
            for _ in 0..20 {
                let assembly = turned(&assembly, &any_rotation(&mut random));
                assert_eq!(decay(&assembly, mode, [0.0; 3]), 0.0);
                assert!(decay(&assembly, other, [0.0; 3]).abs() > 1e-6 * f64::sqrt(apart));
            }
        }
    }
}

/// Of two moments that differ by 1e-11 the greater is told from the other in any axes, of a body that yields.
#[test]
fn nearly_equal_effective_moments_are_in_their_order_in_any_axes() {
    let mut random = Random::new(9);
    let tips = [0.6, -0.6].map(|x| Sprung {
        mass: 0.56,
        position: [x, 0.0, 0.0],
        stiffness: [456.0; 3],
        damping: [0.67; 3],
    });
    let carrier = Carrier::principal(56.0, [19.2, 38.4, 38.4 * (1.0 + 1e-11)]);
    let assembly = sprung_body(carrier, &tips);
    for _ in 0..40 {
        let R = any_rotation(&mut random);
        let body = turned(&assembly, &R).body().expect("a body");
        let range = EnergyRange::compute(&body, 25.0).expect("a range");
        let spin = range.equilibrium(Mode::ShortAxis).expect("a steady spin");
        let omega = R.transpose() * Vector3::from(spin.omega);
        assert!(omega[2].abs() > 0.99 * omega.norm(), "{omega}");
    }
}

/// With a momentum wheel the steady spin has the sense that is asked for, that of the wheel by default, in any axes.
#[test]
fn a_steady_spin_with_a_wheel_has_the_sense_asked_for() {
    let mut random = Random::new(6);
    let wheel = Wheel {
        name: "wheel".into(),
        axis: [0.1, -0.2, 1.0],
        speed: WheelSpeed::Constant { angular_momentum: 2.0 },
    };
    let mut assembly = Assembly::default().with(Carrier::principal(10.0, [2.0, 4.1, 5.6]));
    assembly.wheels = vec![wheel];
    for sense in [1.0, -1.0] {
        let mut known = None;
        for _ in 0..20 {
            let R = any_rotation(&mut random);
            let towards: [f64; 3] = (R * Vector3::new(0.2, 0.1, sense)).into();
            let body = turned(&assembly, &R).body().expect("a body");
            let given = SpinMagnitude::AngularMomentum(17.0);
            let spin =
                RelativeEquilibrium::extreme_towards(&body, Mode::ShortAxis, given, towards).expect("a spin");
            let omega = R.transpose() * Vector3::from(spin.omega);
            let known = known.get_or_insert(omega);
            assert!(omega[2] * sense > 0.0 && (omega - *known).norm() < 1e-9, "{omega} {known}");
        }
    }
}

/// In the plane of two equal moments the steady spin is the one next to the direction asked for, with the rate of (M26).
#[test]
fn a_steady_spin_in_a_neutral_plane_is_the_one_asked_for() {
    let mut random = Random::new(7);
    let mut assembly = Assembly::default().with(Carrier::principal(29.6, [5.92, 11.84, 11.84]));
    assembly.rotors = vec![flywheel([0.0, 0.0, 1.0], 0.237, 0.052)];
    let towards = Vector3::new(-0.4, 0.7, -0.3);
    let known = decay(&assembly, Mode::ShortAxis, towards.into());
    let angle = towards[1].atan2(towards[2]);
    let G = 0.007; // so slow that the rotor lags little: (M26) is off by λI/c of itself, 1e-7
    let spin = G / 11.84;
    let closed = 0.237_f64.powi(2) * spin * spin / (0.052 * 5.92) * 0.5 * angle.sin().powi(2);
    let body = assembly.body().expect("a body");
    let given = SpinMagnitude::AngularMomentum(G);
    let towards_own = towards.into();
    let own =
        RelativeEquilibrium::extreme_towards(&body, Mode::ShortAxis, given, towards_own).expect("a spin");
    let own = SpinModes::about(&body, own).expect("modes");
    let rate = own.nutation().expect("a nutation").decay_rate;
    assert!((rate / closed - 1.0).abs() < 1e-6, "{rate:e} {closed:e}");
    for _ in 0..20 {
        let R = any_rotation(&mut random);
        let found = decay(&turned(&assembly, &R), Mode::ShortAxis, (R * towards).into());
        assert!((found / known - 1.0).abs() < 1e-6, "{found} {known}");
    }
}

/// Three moments that differ by less than 1e-9, but beyond rounding: about the axis of greatest the wobble of the friction of a rotor decays,
/// about that of least it grows, in any axes; these are the axes of the rigid body, whose third one is unstable.
#[test]
fn axes_of_nearly_equal_moments_are_those_of_the_body() {
    let mut random = Random::new(8);
    for apart in [3e-10, 3e-8, 1e-3] {
        let moments = [0.3, -0.5, 1.0].map(|share| 4.0 * (1.0 + apart * share));
        let mut assembly = Assembly::default().with(Carrier::principal(10.0, moments));
        assembly.rotors = vec![flywheel([0.3, -0.8, 0.5], 0.02, 1.0)];
        for (mode, sign) in [(Mode::ShortAxis, 1.0), (Mode::LongAxis, -1.0)] {
            for _ in 0..10 {
                let R = any_rotation(&mut random);
                let body = turned(&assembly, &R).body().expect("a body");
                let given = SpinMagnitude::AngularMomentum(0.4);
                let spin = RelativeEquilibrium::extreme_towards(&body, mode, given, [0.3, 0.2, -0.9])
                    .expect("a spin");
                let own = R.transpose() * Vector3::from(spin.omega).normalize();
                let axis = if mode == Mode::ShortAxis { 2 } else { 1 };
                assert!(own[axis].abs() > 0.999, "{apart:e} {mode:?} {own}");
                let modes = SpinModes::about(&body, spin).expect("modes");
                let nutation = modes.nutation().expect("a nutation");
                assert!(
                    sign * nutation.decay_rate > 0.0 && nutation.frequency > 0.0,
                    "{apart:e} {nutation:?}"
                );
            }
        }
    }
}
