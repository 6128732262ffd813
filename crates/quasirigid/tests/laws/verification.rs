//! Full against reduced: the measured orders, with and without external forces.

use std::ops::ControlFlow;

use quasirigid::dynamics::{
    Forced, Form, Options, Sample, SlowEquations, SlowState, Start, propagate_forced,
};
use quasirigid::elements::{ApplicationPoint, Assembly, End};
use quasirigid::model::Support;
use quasirigid::model::force::{Axes, Conic, Force, ForceLaw, MagneticField, Orbit, Wave};
use quasirigid::secular::MeasureError;
use quasirigid::verification::{
    AverageError, Difference, VerificationError, VerificationPlan, verify, verify_average,
};
use quasirigid_math::expression::Expression;
use quasirigid_math::rotation::turned;
use quasirigid_math::vec3::{add, norm, scale};

use crate::support::parts;
use crate::support::sprung_body;

/// Two sprung masses on a carrier, with a given support and given forces.
fn assembly(support: Support, laws: Vec<ForceLaw<ApplicationPoint>>) -> Assembly {
    let carrier =
        parts::carrier(40.0, [0.02, 0.1, 0.4], [[9.0, 0.2, 0.0], [0.2, 13.0, -0.4], [0.0, -0.4, 16.0]]);
    let masses = [
        parts::sprung(1.2, [0.8, 0.3, 0.9], [900.0, 1000.0, 800.0], [48.0, 36.0, 40.0]),
        parts::sprung(0.9, [-0.5, -0.6, 0.7], [700.0, 800.0, 1100.0], [36.0, 40.0, 48.0]),
    ];
    let forces = laws.into_iter().map(|law| Force { name: "force".into(), law }).collect();
    Assembly { support, forces, ..sprung_body(carrier, &masses) }
}

fn start(omega: [f64; 3]) -> Start {
    Start::new(omega, turned([1.0, 0.0, 0.0, 0.0], [0.3, -0.2, 0.4]))
}

/// Orders of `p = 1, 2, …`, measured in the angular-momentum form; those of the angular-velocity form are reached too.
fn orders(assembly: &Assembly, omega: [f64; 3], highest: usize, rotations: f64) -> Vec<f64> {
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let system = Forced { body: &body, forces: &forces };
    let plan = VerificationPlan {
        orders: (1..=highest).collect(),
        rotations,
        halvings: 4,
        samples: 40,
        ..VerificationPlan::default()
    };
    let verification = verify(system, &start(omega), &plan, &mut |_| ControlFlow::Continue(())).unwrap();
    for row in &verification.rows {
        println!(
            "{:?}, p = {}: {:?} {:?}",
            row.form,
            row.p,
            row.order,
            row.differences.iter().map(|d| d.omega).collect::<Vec<_>>()
        );
    }
    assert!(verification.reached());
    assert!(verification.rows.iter().any(|row| row.form == Form::AngularVelocity && row.p == highest.min(3)));
    let angular_momentum = verification.rows.iter().filter(|row| row.form == Form::AngularMomentum);
    angular_momentum.map(|row| row.order.unwrap()).collect()
}

fn assert_orders(found: &[f64]) {
    for (i, order) in found.iter().enumerate() {
        assert!((order - (i + 2) as f64).abs() < 0.15, "p = {}: {order}", i + 1);
    }
}

#[test]
fn a_heavy_body_with_a_fixed_point_reaches_its_orders() {
    let gravity = ForceLaw::UniformGravity { acceleration: [0.2, -0.1, -1.5] };
    let assembly = assembly(Support::FixedPoint { point: [0.0; 3] }, vec![gravity]);
    assert_orders(&orders(&assembly, [0.3, 0.2, 1.4], 3, 2.0));
}

/// Ten thousand times closer in time scale than a satellite, so that the gravity gradient matters within a revolution.
#[test]
fn a_body_on_an_eccentric_orbit_reaches_its_orders() {
    let orbit = Orbit {
        mu: 1.0,
        semi_major_axis: 1.0,
        eccentricity: 0.3,
        inclination: 0.5,
        raan: 0.2,
        argument_of_periapsis: 0.7,
        mean_anomaly: 0.4,
        node_rate: 0.0,
        periapsis_rate: 0.0,
    };
    let assembly = assembly(Support::Free, vec![ForceLaw::CentralGravity { orbit: orbit.into() }]);
    assert_orders(&orders(&assembly, [0.5, 0.7, 0.9], 3, 1.0));
}

/// The same past the periapsis of a hyperbola, and the lower orders past that of a parabola and of an ellipse that is nearly one, in the plane of no
/// axis.
#[test]
fn a_body_on_a_flyby_reaches_its_orders() {
    for (eccentricity, highest) in [(2.5, 3), (1.0, 2), (1.0 - 1e-8, 2)] {
        let conic = Conic {
            mu: 1.0,
            periapsis_distance: 0.9,
            eccentricity,
            inclination: 0.5,
            raan: 0.2,
            argument_of_periapsis: 0.7,
            time_of_periapsis: 1.3,
        };
        let assembly = assembly(Support::Free, vec![ForceLaw::CentralGravity { orbit: conic.into() }]);
        assert_orders(&orders(&assembly, [0.5, 0.7, 0.9], highest, 1.0));
    }
}

/// Drag, thrusters on a mass and on the carrier, torques, a dipole, eddy currents and a formula at once, on a body in flight.
#[test]
fn every_other_force_reaches_its_orders() {
    let tip = ApplicationPoint { on: End::Point(0), at: None };
    let nose = ApplicationPoint { on: End::Carrier, at: Some([0.3, -0.2, 0.5]) };
    let slow = Wave { frequency: 0.7, phase: 0.4 };
    let formula = ["-0.3*vx + 0.2*sin(0.5*t)", "0.1*x*vz - 0.2*y", "exp(-0.1*t)*cos(0.2*z)"];
    let laws = vec![
        ForceLaw::Drag { at: tip, coefficient: 0.4 },
        ForceLaw::SpinDrag { coefficient: 0.3 },
        ForceLaw::Torque { torque: [0.5, -0.4, 0.3], axes: Axes::Inertial, wave: slow },
        ForceLaw::Torque { torque: [-0.2, 0.3, 0.4], axes: Axes::Body, wave: Wave::default() },
        ForceLaw::Thrust { at: nose, force: [0.4, 0.5, -0.3], axes: Axes::Body, wave: slow },
        ForceLaw::MagneticDipole { moment: [0.3, 0.2, -0.4], field: MagneticField::Uniform([0.5, 0.1, 0.6]) },
        ForceLaw::EddyCurrent {
            tensor: [[0.4, 0.1, 0.0], [0.1, 0.3, -0.1], [0.0, -0.1, 0.5]],
            decay_time: 0.0,
            field: MagneticField::Uniform([0.5, -0.4, 0.6]),
        },
        ForceLaw::Expression { at: tip, force: formula.map(|text| parsed(text, &PLACE_AND_TIME)) },
    ];
    assert_orders(&orders(&assembly(Support::Free, laws), [0.5, 0.7, 0.9], 3, 1.0));
}

/// The pole is shaken along a path that is given.
#[test]
fn a_body_on_a_driven_pole_reaches_its_orders() {
    let acceleration = ["0.8*cos(0.9*t)", "0.3 - 0.1*t", "-0.5*sin(0.6*t)"].map(|text| parsed(text, &["t"]));
    let support = Support::Prescribed {
        point: [0.05, -0.1, 0.2],
        acceleration,
        velocity: [0.3, 0.0, -0.2],
        position: [1.0, 2.0, 3.0],
    };
    assert_orders(&orders(&assembly(support, Vec::new()), [0.3, 0.2, 1.1], 3, 1.0));
}

const PLACE_AND_TIME: [&str; 7] = ["x", "y", "z", "vx", "vy", "vz", "t"];

fn parsed(text: &str, variables: &[&str]) -> Expression {
    Expression::parse(text, variables).unwrap()
}

/// The angular-velocity form (3.1)–(3.4) and the angular-momentum form differ by the order that they both leave out.
#[test]
fn the_papers_form_under_forces_agrees_with_the_momentum_form() {
    let gravity = ForceLaw::UniformGravity { acceleration: [0.2, -0.1, -1.5] };
    let assembly = assembly(Support::FixedPoint { point: [0.0; 3] }, vec![gravity]);
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    for order in 1..=3 {
        let gaps = [0.5, 0.25].map(|epsilon| {
            let body = body.stiffened(epsilon).unwrap();
            let system = Forced { body: &body, forces: &forces };
            let Start { omega, attitude, place, velocity } = start([0.3, 0.2, 1.4]);
            let still = SlowState { angular_momentum: [0.0; 3], attitude, place, velocity };
            let state = still.with_spin(system, order, omega).unwrap();
            let end = |form| {
                let options = Options { form, tolerance: 1e-12, ..Options::default() };
                propagate_forced(
                    SlowEquations::series(system, order),
                    &state,
                    &[4.0],
                    &options,
                    &mut Vec::new(),
                )
                .unwrap()
                .last
                .omega
            };
            norm(add(end(Form::AngularMomentum), scale(-1.0, end(Form::AngularVelocity))))
        });
        let measured = (gaps[0] / gaps[1]).log2();
        println!("p = {order}: {gaps:?} {measured:.3}");
        assert!(gaps[0] < 1e-10 || measured > order as f64 + 0.7, "p = {order}: {measured:.3}");
    }
}

/// The mean power of the average tends to that of the full system as `ε²`: the polhode of the deformed body, and terms two orders up.
#[test]
fn averages_tend_to_the_full_system() {
    for (omega, p) in [([0.1, 0.05, 0.9], 3), ([0.8, 0.1, 0.05], 3), ([0.1, 0.3, 0.6], 5)] {
        let body = assembly(Support::Free, Vec::new()).body().unwrap();
        let system = Forced::not(&body);
        let found =
            verify_average(system, &start(omega), p, 3, u64::MAX, &mut || ControlFlow::Continue(())).unwrap();
        assert_eq!((found.errors.len(), found.expected), (4, 2));
        let order = found.order.unwrap();
        println!("{omega:?}: {:?} {order:.4}", found.errors);
        assert!(found.reached() && (order - 2.0).abs() < 1e-3, "{found:?}");
    }
}

/// A body without an average is refused, and a request to end is obeyed.
#[test]
fn averages_that_there_are_none_of_are_refused() {
    let refused = |assembly: &Assembly, omega: [f64; 3]| {
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let system = Forced { body: &body, forces: &forces };
        verify_average(system, &start(omega), 3, 2, u64::MAX, &mut || ControlFlow::Continue(())).unwrap_err()
    };
    let gravity = ForceLaw::UniformGravity { acceleration: [0.0, 0.0, -1.0] };
    let held = assembly(Support::FixedPoint { point: [0.0; 3] }, vec![gravity]);
    assert!(matches!(refused(&held, [0.3, 0.2, 1.4]), AverageError::NotFree));
    let body = assembly(Support::Free, Vec::new()).body().unwrap();
    let found = verify_average(Forced::not(&body), &start([0.1, 0.05, 0.9]), 3, 2, u64::MAX, &mut || {
        ControlFlow::Break(())
    });
    assert!(matches!(found, Err(AverageError::Measure(MeasureError::Interrupted))), "{found:?}");
}

/// Its rotations would last for ever.
#[test]
fn a_body_at_rest_is_refused() {
    let body = assembly(Support::Free, Vec::new()).body().unwrap();
    let found = verify(Forced::not(&body), &start([0.0; 3]), &VerificationPlan::default(), &mut |_| {
        ControlFlow::Continue(())
    });
    assert!(matches!(found, Err(VerificationError::AtRest)), "{found:?}");
}

/// Histories differ by the largest difference of each kind: the spin relative to the fastest, an angle, an energy.
#[test]
fn differences_of_histories_are_the_largest_of_each_kind() {
    let turn = |angle: f64| [(0.5 * angle).cos(), 0.0, (0.5 * angle).sin(), 0.0];
    let sample =
        |omega, angle, dissipated| Sample { omega, attitude: turn(angle), dissipated, ..Sample::default() };
    let full = [sample([0.0, 0.0, 4.0], 0.1, 2.0), sample([0.0, 3.0, 0.0], 0.2, 5.0)];
    let reduced = [sample([0.0, 1.0, 4.0], 0.4, 2.5), sample([0.0, 2.5, 0.0], 0.3, 4.25)];
    let found = Difference::between(&full, &reduced);
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    close(found.omega, 0.25);
    close(found.attitude, 0.3);
    close(found.dissipated, 0.75);
    close(found.dissipation, 5.0);
    assert!(Difference::between(&full, &reduced[..1]).dissipated.is_nan());
}
