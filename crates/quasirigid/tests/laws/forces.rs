//! Laws of external forces: work, drag, rotated inertial axes, other units. (F1), (F5)–(F9), (F11), (F12)

use nalgebra::{Matrix3, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid::elements::{ApplicationPoint, Assembly, End};
use quasirigid::model::force::{Axes, Force, ForceLaw, KinematicState, Loads, MagneticField};
use quasirigid::model::{FlexibleBody, Marker, MotionState};
use quasirigid_math::scalar::Smooth;
use quasirigid_math::taylor::Taylor;

use super::forced::{BASE, State, forced, formula, numbers, orbit, states};
use crate::support::transform::{Units, rescaled};
use crate::support::{assemblies, cases, rotation, units, vector};

type V = Vector3<f64>;

/// Rounding of sums of some ten terms, and of differences that give velocities.
const ROUNDING: f64 = 1e-12;

fn resolved(assembly: &Assembly) -> (FlexibleBody, Vec<Force<Marker>>) {
    (assembly.body().unwrap(), assembly.forces().unwrap())
}

/// Largest differences of force, moment and generalised forces, each in its own unit.
fn gap(body: &FlexibleBody, found: &Loads<f64>, expected: &Loads<f64>, units: Units) -> f64 {
    let newton = units.factor([1, 1, -2]);
    let joule = newton * units.length;
    let force = (V::from(found.force) - V::from(expected.force)).norm() / newton;
    let moment = (V::from(found.moment) - V::from(expected.moment)).norm() / joule;
    let unit = body.coordinates().iter().map(|c| if c.unit == "m" { newton } else { joule });
    let pairs = found.generalized.iter().zip(&expected.generalized).zip(unit);
    let worst = pairs.map(|((a, b), unit)| (a - b).abs() / unit).fold(force.max(moment), f64::max);
    if (force + moment + found.generalized.iter().sum::<f64>()).is_finite() { worst } else { f64::INFINITY }
}

/// Loads of a body whose every number moves by a share `drift` of its own per unit of time.
fn drifting<T: Smooth>(
    body: &FlexibleBody,
    forces: &[Force<Marker>],
    state: &State,
    drift: &[f64],
    t: T,
) -> Loads<T> {
    let mut drift = drift.iter().cycle();
    let mut moved = |x: f64| T::from(x) + T::from(drift.next().map_or(0.0, |rate| *rate)) * t;
    let (q, rate): (Vec<T>, Vec<T>) =
        state.q.iter().zip(&state.rate).map(|(q, rate)| (moved(*q), moved(*rate))).unzip();
    let kinematics = KinematicState {
        t: T::from(state.t) + t,
        attitude: state.attitude.map(&mut moved),
        pole: state.pole.map(&mut moved),
        pole_velocity: state.velocity.map(&mut moved),
        motion: MotionState { omega: state.omega.map(&mut moved), q: &q, rate: &rate },
    };
    body.loads(forces, &kinematics)
}

/// Sizes against which the loads of one law are judged.
fn size(loads: &Loads<f64>) -> f64 {
    loads.generalized.iter().chain(&loads.force).chain(&loads.moment).fold(0.0, |size, x| size.max(x.abs()))
}

proptest! {
    #![proptest_config(cases(48))]

    /// Whatever the motion, the loads of a force at a place do the work `F·Ṙ`, with the velocity by differences.
    #[test]
    fn loads_do_the_work_of_the_force_on_its_place(
        assembly in assemblies(), numbers in numbers(), loose in states()
    ) {
        let (body, forces) = resolved(&forced(&assembly, numbers.forces(BASE, &Matrix3::identity())));
        let state = State::of(&body, &loose, 0.5);
        let turn = state.turn();
        let V_B: [f64; 3] = (turn.transpose() * V::from(state.velocity)).into();
        for force in forces {
            let loads = body.loads(std::slice::from_ref(&force), &state.kinematics());
            let power = loads.power(state.kinematics().motion, V_B);
            let omega = V::from(state.omega);
            let expected = match &force.law {
                ForceLaw::Drag { at, coefficient } => -coefficient * state.velocity(at).norm_squared(),
                ForceLaw::SpinDrag { coefficient } => -coefficient * omega.norm_squared(),
                ForceLaw::Thrust { at, force, axes, wave } => {
                    let now = (wave.frequency * state.t + wave.phase).cos() * V::from(*force);
                    let now = if *axes == Axes::Body { turn * now } else { now };
                    now.dot(&state.velocity(at))
                }
                ForceLaw::Torque { torque, axes, wave } => {
                    let now = (wave.frequency * state.t + wave.phase).cos() * V::from(*torque);
                    now.dot(&if *axes == Axes::Body { omega } else { turn * omega })
                }
                _ => continue,
            };
            let scale = size(&loads) * 10.0;
            prop_assert!((power - expected).abs() < ROUNDING * scale, "{:?}: {power} {expected}", force.law);
            if matches!(force.law, ForceLaw::Drag { .. } | ForceLaw::SpinDrag { .. }) {
                prop_assert!(power <= 0.0, "{:?} gives {power}", force.law);
            }
        }
    }

    /// A formula takes place, velocity and time of the displaced point, in inertial axes.
    #[test]
    fn a_formula_sees_where_its_place_is_and_how_it_moves(
        assembly in assemblies(), loose in states(), on_carrier in vector(), on_point in any::<bool>()
    ) {
        let force = ["1.5*x*vy - z*t", "vx^2 - 0.7*y + cos(t)", "vz*(x + 2) + 0.3*y*z"].map(formula);
        let (on, at) = if on_point { (End::Point(0), None) } else { (End::Carrier, Some(on_carrier)) };
        let law = ForceLaw::Expression { at: ApplicationPoint { on, at }, force };
        let (body, forces) = resolved(&forced(&assembly, vec![Force { name: "own".into(), law }]));
        let state = State::of(&body, &loose, 0.5);
        let at = forces[0].law.place().unwrap();
        let (R, v, t) = (state.place(at), state.velocity(at), state.t);
        let F = V::new(
            1.5 * R.x * v.y - R.z * t,
            v.x.powi(2) - 0.7 * R.y + t.cos(),
            v.z * (R.x + 2.0) + 0.3 * R.y * R.z,
        );
        let loads = body.loads(&forces, &state.kinematics());
        let F_B = state.turn().transpose() * F;
        prop_assert!((V::from(loads.force) - F_B).norm() < ROUNDING * F.norm().max(1.0));
        let V_B: [f64; 3] = (state.turn().transpose() * V::from(state.velocity)).into();
        let power = loads.power(state.kinematics().motion, V_B);
        prop_assert!((power - F.dot(&v)).abs() < ROUNDING * 10.0 * size(&loads).max(1.0), "{power} {}", F.dot(&v));
    }

    /// The dipole rotates towards the field: `−m·B` falls as the torque works. The field of a dipole is the gradient of `−b·R/R³`. (F8)
    #[test]
    fn magnetic_torque_works_as_the_energy_of_the_dipole_falls(
        assembly in assemblies(), loose in states(), moment in vector(), strength in vector(), orbit in orbit()
    ) {
        let field = |law: MagneticField| Force { name: "coil".into(), law: ForceLaw::MagneticDipole { moment, field: law } };
        let (body, _) = resolved(&assembly);
        let state = State::of(&body, &loose, 0.5);
        let R = V::from(orbit.at(state.t).place);
        let h = 2e-3 * R.norm();
        let potential = |d: V| V::from(strength).dot(&(R + d)) / (R + d).norm().powi(3);
        let B = V::from_fn(|axis, _| {
            let odd = |i: f64| potential(V::ith(axis, -i * h)) - potential(V::ith(axis, i * h));
            (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * h)
        });
        let fields = [
            (MagneticField::Uniform(strength), V::from(strength)),
            (MagneticField::Dipole { strength, rate: 0.0, orbit }, B),
        ];
        for (law, B) in fields {
            let energy = |t: f64| -(state.after(t).turn() * V::from(moment)).dot(&B);
            let dt = 2e-3;
            let odd = |i: f64| energy(-i * dt) - energy(i * dt);
            let expected = (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * dt);
            let loads = body.loads(&[field(law)], &state.kinematics());
            let power = loads.power(state.kinematics().motion, [0.0; 3]);
            // Differences of the potential over 2e-3 of the distance err by 1e-13 of it, 56 of its seventh order.
            prop_assert!((power - expected).abs() < 1e-11 * B.norm().max(1e-3 / R.norm().powi(3)), "{power} {expected}");
        }
    }

    /// Every Taylor coefficient: the series of the loads along a path gives the loads further along it.
    #[test]
    fn series_of_loads_continue_them_along_a_motion(
        assembly in assemblies(), numbers in numbers(), loose in states(), drift in vec(-1.0..1.0, 40)
    ) {
        let mut numbers = numbers;
        numbers.orbit.eccentricity *= 0.5;
        let (body, forces) = resolved(&forced(&assembly, numbers.forces(BASE, &Matrix3::identity())));
        let state = State::of(&body, &loose, 0.5);
        let h = 5e-3;
        let sum = |series: &Taylor<12>| (0..12).rev().fold(0.0, |sum, k| sum * h + series.coefficient(k));
        for force in forces {
            let one = std::slice::from_ref(&force);
            let series = drifting(&body, one, &state, &drift, Taylor::<12>::variable(0.0));
            let found = Loads {
                force: series.force.each_ref().map(sum),
                moment: series.moment.each_ref().map(sum),
                generalized: series.generalized.iter().map(sum).collect(),
            };
            let expected = drifting(&body, one, &state, &drift, h);
            let gap = gap(&body, &found, &expected, BASE);
            prop_assert!(gap < ROUNDING * size(&expected), "{:?}: {gap:e}", force.law);
        }
    }

    /// Loads are in body axes, which do not depend on the inertial ones.
    #[test]
    fn turned_inertial_axes_change_no_load(
        assembly in assemblies(), numbers in numbers(), loose in states(), R in rotation()
    ) {
        let (body, forces) = resolved(&forced(&assembly, numbers.forces(BASE, &Matrix3::identity())));
        let (_, turned) = resolved(&forced(&assembly, numbers.forces(BASE, &R)));
        let state = State::of(&body, &loose, 0.5);
        for (force, turned) in forces.into_iter().zip(turned) {
            let law = force.law.clone();
            let expected = body.loads(&[force], &state.kinematics());
            let found = body.loads(&[turned], &state.seen_from(&R).kinematics());
            let gap = gap(&body, &found, &expected, BASE);
            prop_assert!(gap < ROUNDING * size(&expected), "{law:?}: {gap:e}");
        }
    }

    /// Laws do not depend on units.
    #[test]
    fn loads_scale_with_the_units(
        assembly in assemblies(), numbers in numbers(), loose in states(), units in units()
    ) {
        let (body, forces) = resolved(&forced(&assembly, numbers.forces(BASE, &Matrix3::identity())));
        let scaled = forced(&rescaled(&assembly, units), numbers.forces(units, &Matrix3::identity()));
        let (scaled_body, scaled_forces) = resolved(&scaled);
        let state = State::of(&body, &loose, 0.5);
        let scaled_state = state.rescaled(&body, units);
        let unscale = |loads: &Loads<f64>, body: &FlexibleBody| {
            let newton = units.factor([1, 1, -2]);
            let unit = body.coordinates().iter().map(|c| if c.unit == "m" { newton } else { newton * units.length });
            Loads {
                force: loads.force.map(|x| x / newton),
                moment: loads.moment.map(|x| x / newton / units.length),
                generalized: loads.generalized.iter().zip(unit).map(|(x, unit)| x / unit).collect(),
            }
        };
        for (force, scaled_force) in forces.into_iter().zip(scaled_forces) {
            let law = force.law.clone();
            let expected = body.loads(&[force], &state.kinematics());
            let found = scaled_body.loads(&[scaled_force], &scaled_state.kinematics());
            let gap = gap(&body, &unscale(&found, &body), &expected, BASE);
            prop_assert!(gap < ROUNDING * size(&expected), "{law:?}: {gap:e}");
        }
    }

    /// Forces fixed in the body do not depend on its place, attitude or motion.
    #[test]
    fn thrust_in_body_axes_does_not_depend_on_the_attitude(
        assembly in assemblies(), numbers in numbers(), loose in states(), R in rotation(), moved in vector()
    ) {
        let (body, forces) = resolved(&forced(&assembly, numbers.forces(BASE, &Matrix3::identity())));
        let mut state = State::of(&body, &loose, 0.5);
        let fixed = |law: &ForceLaw<Marker>| {
            matches!(law, ForceLaw::Thrust { axes: Axes::Body, .. } | ForceLaw::Torque { axes: Axes::Body, .. })
        };
        let forces: Vec<_> = forces.into_iter().filter(|force| fixed(&force.law)).collect();
        let before = body.loads(&forces, &state.kinematics());
        state = state.seen_from(&R);
        (state.pole, state.velocity, state.omega) = (moved, moved, moved);
        prop_assert_eq!(before, body.loads(&forces, &state.kinematics()));
    }

    /// Forces add, and the power is the same about the pole and about the centre of mass, each with its own velocity.
    #[test]
    fn power_does_not_depend_on_the_point_it_is_counted_about(
        assembly in assemblies(), numbers in numbers(), loose in states()
    ) {
        let (body, forces) = resolved(&forced(&assembly, numbers.forces(BASE, &Matrix3::identity())));
        let state = State::of(&body, &loose, 0.5);
        let loads = body.loads(&forces, &state.kinematics());
        let sum = forces.iter().fold(Loads::none(state.q.len()), |sum, force| {
            let one = body.loads(std::slice::from_ref(force), &state.kinematics());
            let add = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + b[i]);
            Loads {
                force: add(sum.force, one.force),
                moment: add(sum.moment, one.moment),
                generalized: sum.generalized.iter().zip(&one.generalized).map(|(a, b)| a + b).collect(),
            }
        });
        prop_assert!(gap(&body, &loads, &sum, BASE) < ROUNDING * size(&loads));
        let felt = loads.about_center(&body, &state.q);
        let motion = state.kinematics().motion;
        let V_O = state.turn().transpose() * V::from(state.velocity);
        // Σ m u and its slopes: the moment and the generalised forces of uniform gravities.
        let weight = |axis: usize| {
            let g = state.turn() * V::ith(axis, 1.0);
            let law = ForceLaw::UniformGravity { acceleration: g.into() };
            body.loads(&[Force { name: "weight".into(), law }], &state.kinematics())
        };
        let weights = [0, 1, 2].map(weight);
        let s = V::new(weights[1].moment[2], -weights[0].moment[2], weights[0].moment[1]);
        let along = |axis: usize| -> f64 {
            weights[axis].generalized.iter().zip(&state.rate).map(|(slope, rate)| slope * rate).sum()
        };
        let rate = V::new(along(0), along(1), along(2));
        let drift = body.translation().map_or(V::zeros(), |per_mass| {
            per_mass * (rate + V::from(state.omega).cross(&s))
        });
        let (about_pole, about_center) =
            (loads.power(motion, V_O.into()), felt.power(motion, (V_O + drift).into()));
        prop_assert!((about_pole - about_center).abs() < ROUNDING * size(&loads), "{about_pole} {about_center}");
    }
}
