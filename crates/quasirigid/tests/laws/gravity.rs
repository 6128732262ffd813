//! Gravity on a body against sums over its masses, which move on exact paths. (F2)–(F4), (F11)

use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;
use quasirigid::model::force::{Force, ForceLaw, Loads, Orbit};
use quasirigid::model::{FlexibleBody, Marker, Support};
use quasirigid_math::expression::Expression;

use super::forced::{Loose, State, orbit, states};
use super::invariants::Cloud;
use crate::support::{Mass, Massive, assemblies, bodies, cases, massive, massive_points, vector};

type V = Vector3<f64>;

/// Step of sixth-order differences: in a quadratic form, whose angle doubles, they err by `2⁷ h⁶/140`.
const STEP: f64 = 0.01;
/// Remaining error of these differences, with a margin for the shape of the body, and of rounding.
const DIFFERENCES: f64 = 1e-11;

/// Loads of a potential energy: the rate at which it falls as the body rotates about each of its axes, and as each coordinate grows.
struct Slopes {
    moment: V,
    generalized: Vec<f64>,
}

/// Slopes of a function of the masses in inertial axes, as seen from the pole.
fn slopes(cloud: &Cloud, state: &State, potential: impl Fn(&[Mass]) -> f64) -> Slopes {
    let energy = |rotation: V, q: &[f64]| {
        let turn = state.turn() * Rotation3::new(rotation).matrix();
        let masses: Vec<Mass> = cloud.at(q).iter().map(|(m, u)| (*m, turn * u)).collect();
        potential(&masses)
    };
    let fall = |at: &dyn Fn(f64) -> f64| {
        let odd = |i: f64| at(-i * STEP) - at(i * STEP);
        (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * STEP)
    };
    let about = |axis: usize| fall(&|x| energy(x * V::ith(axis, 1.0), &state.q));
    let along = |j: usize| {
        fall(&|x| {
            let mut q = state.q.clone();
            q[j] += x;
            energy(V::zeros(), &q)
        })
    };
    Slopes { moment: V::from_fn(|axis, _| about(axis)), generalized: (0..state.q.len()).map(along).collect() }
}

/// Largest difference of moments and of generalised forces.
fn gap(loads: &Loads<f64>, slopes: &Slopes) -> (f64, f64) {
    let generalized = loads.generalized.iter().zip(&slopes.generalized).map(|(a, b)| (a - b).abs());
    ((V::from(loads.moment) - slopes.moment).norm(), generalized.fold(0.0, f64::max))
}

fn one(law: ForceLaw<Marker>) -> [Force<Marker>; 1] {
    [Force { name: "gravity".into(), law }]
}

fn center(masses: &[Mass]) -> V {
    masses.iter().map(|(m, r)| *m * r).sum::<V>() / masses.iter().map(|(m, _)| m).sum::<f64>()
}

/// Potential energy of uniform gravity.
fn weight(g: [f64; 3]) -> impl Fn(&[Mass]) -> f64 {
    move |masses| masses.iter().map(|(m, r)| -m * V::from(g).dot(r)).sum()
}

/// Potential energy of the attraction by the centre of an orbit to first order in size over distance, about the point
/// that follows the orbit.
fn tide(orbit: Orbit, t: f64, free: bool) -> impl Fn(&[Mass]) -> f64 {
    let R = V::from(orbit.at(t).place);
    let (n, kappa) = (R.normalize(), orbit.mu / R.norm().powi(3));
    move |masses| {
        let middle = if free { center(masses) } else { V::zeros() };
        let one = |(m, r): &Mass| {
            let d = r - middle;
            0.5 * kappa * m * (d.norm_squared() - 3.0 * n.dot(&d).powi(2))
        };
        masses.iter().map(one).sum()
    }
}

/// A body, whether its centre of mass falls, its masses and a state of it.
fn at_rest(massive: &Massive, loose: &Loose, amount: f64) -> (FlexibleBody, bool, Cloud, State) {
    let body = massive.assembly.body().unwrap();
    let state = State::of(&body, loose, amount);
    let (free, cloud) = (body.translation().is_some(), Cloud::of(massive, &body));
    (body, free, cloud, state)
}

proptest! {
    #![proptest_config(cases(32))]

    /// Straight paths, for which the program is exact.
    #[test]
    fn gravity_on_points_has_a_potential(
        massive in massive_points(), held in any::<bool>(), point in vector(), g in vector(), orbit in orbit(),
        loose in states()
    ) {
        let mut massive = massive;
        if held {
            massive.assembly.support = Support::FixedPoint { point };
        }
        let (body, free, cloud, state) = at_rest(&massive, &loose, 1.0);
        let uniform = body.loads(&one(ForceLaw::UniformGravity { acceleration: g }), &state.kinematics());
        let central = body.loads(&one(ForceLaw::CentralGravity { orbit: orbit.into() }), &state.kinematics());
        let (mass, J) = (body.invariants().mass, body.invariants().J[0] + body.invariants().J[1]);
        let (moment, generalized) = gap(&uniform, &slopes(&cloud, &state, weight(g)));
        prop_assert!(moment.max(generalized) < DIFFERENCES * mass, "{moment:e} {generalized:e}");
        let size = (J + mass) * orbit.mu / orbit.at(state.t).radius.powi(3);
        let (moment, generalized) = gap(&central, &slopes(&cloud, &state, tide(orbit, state.t, free)));
        prop_assert!(moment.max(generalized) < DIFFERENCES * size, "{moment:e} {generalized:e} of {size}");
        prop_assert_eq!(central.force, [0.0; 3]);
        let g_B = state.turn().transpose() * V::from(g);
        prop_assert!((V::from(uniform.force) - mass * g_B).norm() < 1e-14 * mass);
    }

    /// Appendages on hinges of one, two and three axes, turned by up to a radian about each: exact rotations, for which the program is exact.
    /// (I12)
    #[test]
    fn gravity_on_hinges_has_a_potential(
        massive in massive().prop_filter("a hinge", |m| !m.appendages.is_empty()), g in vector(), orbit in orbit(),
        loose in states()
    ) {
        let (body, free, cloud, state) = at_rest(&massive, &loose, 1.0);
        let uniform = body.loads(&one(ForceLaw::UniformGravity { acceleration: g }), &state.kinematics());
        let central = body.loads(&one(ForceLaw::CentralGravity { orbit: orbit.into() }), &state.kinematics());
        let masses = cloud.at(&state.q);
        let mass: f64 = masses.iter().map(|(m, r)| m * (1.0 + r.norm())).sum();
        let J: f64 = masses.iter().map(|(m, r)| m * r.norm_squared()).sum();
        let (moment, generalized) = gap(&uniform, &slopes(&cloud, &state, weight(g)));
        prop_assert!(moment.max(generalized) < DIFFERENCES * mass, "{moment:e} {generalized:e} of {mass}");
        let size = (J + mass) * orbit.mu / orbit.at(state.t).radius.powi(3);
        let (moment, generalized) = gap(&central, &slopes(&cloud, &state, tide(orbit, state.t, free)));
        prop_assert!(moment.max(generalized) < DIFFERENCES * size, "{moment:e} {generalized:e} of {size}");
    }

    /// The gravity gradient is the attraction of the centre less that of the point on the orbit, to first order in size over distance: the
    /// neglected part halves when the distance doubles. (F4)
    #[test]
    fn gravity_gradient_is_the_sum_of_central_attractions(
        massive in massive_points(), held in any::<bool>(), point in vector(), orbit in orbit(), loose in states()
    ) {
        let mut massive = massive;
        if held {
            massive.assembly.support = Support::FixedPoint { point };
        }
        let (body, free, cloud, state) = at_rest(&massive, &loose, 0.3);
        let masses = cloud.at(&state.q);
        let middle = if free { center(&masses) } else { V::zeros() };
        let largest: f64 = masses.iter().map(|(m, u)| m * (u - middle).norm_squared()).sum();
        let error = |distance: f64| {
            let orbit = Orbit { semi_major_axis: distance, ..orbit };
            let R = state.turn().transpose() * V::from(orbit.at(state.t).place);
            let pull = |d: V| -orbit.mu * (R + d) / (R + d).norm().powi(3);
            let moment: V =
                masses.iter().map(|(m, u)| *m * (u - middle).cross(&(pull(u - middle) - pull(V::zeros())))).sum();
            let loads = body.loads(&one(ForceLaw::CentralGravity { orbit: orbit.into() }), &state.kinematics());
            let kappa = orbit.mu / R.norm().powi(3);
            (moment - V::from(loads.moment)).norm() / (kappa * largest) * (R.norm() / distance)
        };
        let (near, far) = (error(1e4), error(2e4));
        // Masses within 4 m of the middle, radii from 500 m; the next order is smaller by their ratio.
        prop_assert!(near < 4e-3, "{near:e}");
        prop_assert!((far / near - 0.5).abs() < 0.02 || near < 1e-8, "{near:e} {far:e}");
    }

    /// A free body does not feel uniform gravity, in any units. (F11)
    #[test]
    fn a_free_body_does_not_feel_uniform_gravity(assembly in bodies(), g in vector(), loose in states()) {
        let mut assembly = assembly;
        assembly.support = Support::Free;
        let body = assembly.body().unwrap();
        let state = State::of(&body, &loose, 0.5);
        let loads = body.loads(&one(ForceLaw::UniformGravity { acceleration: g }), &state.kinematics());
        let felt = loads.about_center(&body, &state.q);
        let rounding = 1e-15 * V::from(g).norm();
        let invariants = body.invariants();
        let mut slopes: Vec<f64> = invariants.S.iter().map(|S| V::from(*S).norm()).collect();
        for (j, k, pair) in invariants.pairs.iter() {
            slopes[j] += V::from(pair.S2).norm() * state.q[k].abs();
        }
        let moment: f64 = slopes.iter().zip(&state.q).map(|(slope, q)| slope * q.abs()).sum();
        prop_assert!(V::from(felt.moment).norm() <= 4.0 * rounding * moment, "{felt:?}");
        for (Q, slope) in felt.generalized.iter().zip(slopes) {
            prop_assert!(Q.abs() <= 8.0 * rounding * slope, "{Q:e} of {slope:e}");
        }
        prop_assert_eq!(felt.force, loads.force);
    }

    /// A driven pole acts as a uniform gravity that is opposite to its acceleration. (F2)
    #[test]
    fn a_driven_pole_is_a_gravity_that_points_back(
        assembly in assemblies(), point in vector(), g in vector(), loose in states()
    ) {
        let held = |support: Support| {
            let mut assembly = assembly.clone();
            assembly.support = support;
            assembly.body().unwrap()
        };
        let fixed = held(Support::FixedPoint { point });
        let acceleration = g.map(|a| Expression::parse(&format!("{:e} * t", -a), &["t"]).unwrap());
        let driven = held(Support::Prescribed { point, acceleration, velocity: [0.0; 3], position: [0.0; 3] });
        let state = State::of(&fixed, &loose, 0.5);
        let weight = one(ForceLaw::UniformGravity { acceleration: g.map(|a| a * state.t) });
        let loads = driven.loads(&[], &state.kinematics());
        prop_assert_eq!(&loads, &fixed.loads(&weight, &state.kinematics()));
        prop_assert_eq!(&loads.about_center(&driven, &state.q), &loads);
        prop_assert_eq!(driven.mass_matrix(), fixed.mass_matrix());
    }
}
