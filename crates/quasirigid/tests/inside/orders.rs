//! Order `p`, the degree `p + 2` of `f`, is in error by `ε^{p+1}`: 1, 2, 3, 4 for the degrees 2 to 5. (E4),
//! docs/theory/09-forced-reduction.md

use quasirigid::dynamics::{Form, Options, spin_path, steady_spins};
use quasirigid::elements::{ApplicationPoint, Assembly, Cavity, WheelSpeed};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::reduction::reduce;
use quasirigid_math::expression::Expression;
use quasirigid_math::vec3::{add, norm, scale};

use super::bodies::{bare, cavity, everything, orders, sprung, wheel};
use crate::support::rotors::{ball, flywheel};

const OMEGA: [f64; 3] = [1.2, 0.35, 0.2];

fn assert_orders(assembly: &Assembly, highest: usize) {
    for (p, order) in orders(assembly, OMEGA, highest).into_iter().enumerate() {
        assert!((order - (p + 1) as f64).abs() < 0.25, "p = {p}: {order}");
    }
}

#[test]
fn flywheel_orders() {
    let rotors = vec![flywheel([0.3, 1.0, -0.5], 1.1, 6.0)];
    assert_orders(&Assembly { rotors, ..bare() }, 3);
}

#[test]
fn ball_orders() {
    assert_orders(&Assembly { rotors: vec![ball(1.4, 16.0)], ..bare() }, 3);
}

#[test]
fn rotors_beside_a_sprung_mass() {
    let (point, spring) = sprung();
    let rotors = vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0), ball(0.7, 9.0)];
    assert_orders(&Assembly { rotors, points: vec![point], springs: vec![spring], ..bare() }, 3);
}

/// The angular momentum of a wheel counts as degree one, beside the spin.
#[test]
fn a_momentum_wheel_beside_rotor_and_sprung_mass() {
    let (point, spring) = sprung();
    let rotors = vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0)];
    let wheels = vec![wheel([1.0, 0.2, 0.4], WheelSpeed::Constant { angular_momentum: 6.0 })];
    assert_orders(&Assembly { rotors, wheels, points: vec![point], springs: vec![spring], ..bare() }, 3);
}

/// With forces, and a wheel whose speed changes, the slow motion is found by series in time.
#[test]
fn rotors_under_a_torque_and_a_driven_wheel() {
    let (point, spring) = sprung();
    let law = ForceLaw::<ApplicationPoint>::Torque {
        torque: [0.8, -0.5, 0.3],
        axes: Axes::Inertial,
        wave: Wave { frequency: 1.3, phase: 0.4 },
    };
    let speed = Expression::parse("10 + 4 * sin(1.1 * t)", &["t"]).unwrap();
    let assembly = Assembly {
        rotors: vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0), ball(0.7, 9.0)],
        wheels: vec![wheel([1.0, 0.2, 0.4], WheelSpeed::Prescribed { inertia: 0.2, speed })],
        points: vec![point],
        springs: vec![spring],
        forces: vec![Force { name: "torque".into(), law }],
        ..bare()
    };
    assert_orders(&assembly, 3);
}

#[test]
fn a_ball_of_liquid_with_its_modes() {
    let tank = Cavity { modes: 4, ..cavity([0.5; 3], 1500.0, 0.06) };
    assert_orders(&Assembly { cavities: vec![tank], ..bare() }, 3);
}

#[test]
fn an_ellipsoid_of_liquid_beside_a_sprung_mass() {
    let (point, spring) = sprung();
    let cavities = vec![cavity([0.6, 0.45, 0.3], 1500.0, 0.05)];
    assert_orders(&Assembly { cavities, points: vec![point], springs: vec![spring], ..bare() }, 3);
}

/// The angular-velocity form and the angular-momentum form differ by the terms that the order leaves out, and not at all for a rigid body
/// with a wheel. (P1), (P2), (C4)
#[test]
fn both_forms_of_the_equations_know_of_the_wheel() {
    let body = everything().body().unwrap();
    let spin = |order: usize, form: Form, epsilon: f64| {
        let reduced = reduce(&body.stiffened(epsilon).unwrap(), order).unwrap();
        let options = Options { form, tolerance: 1e-14, ..Options::default() };
        spin_path(&reduced, scale(0.5, OMEGA), &[6.0], &options).unwrap().omega[0]
    };
    let gap = |order, epsilon| {
        let [angular_momentum, paper] =
            [Form::AngularMomentum, Form::AngularVelocity].map(|form| spin(order, form, epsilon));
        norm(add(angular_momentum, scale(-1.0, paper))) / norm(angular_momentum)
    };
    assert!(gap(0, 1.0) < 1e-12, "{:e}", gap(0, 1.0));
    for p in 1..=3 {
        let gaps = [0.5, 0.25, 0.125].map(|epsilon| gap(p, epsilon));
        let order = (gaps[1] / gaps[2]).log2();
        println!("p = {p}: {order} {gaps:?}");
        assert!((order - (p + 1) as f64).abs() < 0.25, "p = {p}: {order} {gaps:?}");
    }
}

/// A wheel distinguishes the two senses of an axis: the steady spin against it is the one along the reversed wheel.
#[test]
fn steady_spins_against_a_wheel_are_those_along_the_reversed_one() {
    let spins = |angular_momentum: f64, sense: f64| {
        let wheels = vec![wheel([0.2, 1.0, 0.3], WheelSpeed::Constant { angular_momentum })];
        let assembly = Assembly { rotors: vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0)], wheels, ..bare() };
        steady_spins(&reduce(&assembly.body().unwrap(), 3).unwrap(), sense * 40.0)
    };
    let [against, reversed, along] = [spins(3.0, -1.0), spins(-3.0, 1.0), spins(3.0, 1.0)];
    for axis in 0..3 {
        let [against, reversed, along] = [against, reversed, along].map(|spins| spins[axis].unwrap());
        let spin = norm(along.omega);
        assert!((against.frequency - reversed.frequency).abs() < 1e-10 * spin, "{against:?} {reversed:?}");
        assert!((against.growth - reversed.growth).abs() < 1e-10 * spin, "{against:?} {reversed:?}");
        assert!(norm(add(against.omega, reversed.omega)) < 1e-10 * spin, "{against:?} {reversed:?}");
        assert!(norm(add(against.omega, along.omega)) > 0.01 * spin, "{against:?} {along:?}");
    }
    assert!(spins(3.0, 0.0).iter().all(Option::is_none));
}
