//! Driven parts in the full system: booms run out, masses drawn in and panels turned, against closed forms of plane motions, sums over point
//! masses and balances. (T7)–(T11)

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Unit, Vector3};
use quasirigid::dynamics::{
    Forced, FullState, FullStepper, Method, Observer, Options, Outcome, PropagateError, Sample, StepperError,
    propagate_full,
};
use quasirigid::elements::{
    ApplicationPoint, Assembly, Boom, Carrier, End, HingeCoefficient, Hinged, PlaceRef, PrescribedMotion,
    Problem, Wheel, WheelSpeed,
};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{DriveFault, FlexibleBody, Rheology};
use quasirigid::modes::{EquilibriumError, RelativeEquilibrium, SpinMagnitude};
use quasirigid::reduction::{ReductionError, reduce};
use quasirigid_math::expression::Expression;
use quasirigid_math::{rotation, sym3};

use super::common::turned_axes;
use crate::support::parts;

type V = Vector3<f64>;

/// Units in which a test is repeated: metre, second and kilogram as multiples of those of the SI.
const UNITS: [[f64; 3]; 3] = [[1.0, 1.0, 1.0], [1e-3, 60.0, 1e-4], [250.0, 1e-2, 3e5]];
const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

fn law(text: &str) -> PrescribedMotion {
    PrescribedMotion::Law(Expression::parse(text, &["t"]).unwrap())
}

/// Samples of a motion with the coordinates at each and their rates.
#[derive(Default)]
struct Seen {
    samples: Vec<Sample>,
    q: Vec<Vec<f64>>,
    rate: Vec<Vec<f64>>,
}

impl Observer for Seen {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn keeps_coordinates(&self) -> bool {
        true
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        self.q.push(q.to_vec());
        self.rate.push(rate.to_vec());
    }
}

fn followed(assembly: &Assembly, omega: V, times: &[f64], method: Method) -> Seen {
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let start = FullState::at_rest(&body, omega.into(), ALIGNED);
    let options = Options { tolerance: 1e-13, method, ..Options::default() };
    let mut seen = Seen::default();
    let system = Forced { body: &body, forces: &forces };
    let run = propagate_full(system, &start, times, &options, &mut seen).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    seen
}

fn close(found: f64, known: f64, size: f64, tolerance: f64, what: &str) {
    assert!((found - known).abs() <= tolerance * size, "{what}: {found} for {known}");
}

/// A carrier that lies off the origin, with turned principal axes: the third is the axis of the plane motions.
fn hub(frame: Rotation3<f64>, [m, _, kg]: [f64; 3]) -> Carrier {
    let inertia = frame * Matrix3::from_diagonal(&V::new(7.0, 9.0, 11.0)) * frame.inverse() * (kg * m * m);
    parts::carrier(30.0 * kg, (frame * V::new(0.2, -0.1, 0.3) * m).into(), inertia.into())
}

/// Masses with places and velocities in body axes: angular velocity about the third axis at an angular momentum about the centre of mass, and
/// the energy then, with own moments of inertia (kg m²) that turn at these rates (rad/s) beside the body.
fn plane(masses: &[(f64, V, V)], own: &[[f64; 2]], mut K: impl FnMut(f64, f64) -> f64) -> (f64, f64) {
    let mass: f64 = masses.iter().map(|each| each.0).sum();
    let [center, drift] = [
        masses.iter().map(|(m, r, _)| *m * r).sum::<V>() / mass,
        masses.iter().map(|(m, _, v)| *m * v).sum::<V>() / mass,
    ];
    let (mut J, mut h) =
        (own.iter().map(|[I, _]| I).sum::<f64>(), own.iter().map(|[I, u]| I * u).sum::<f64>());
    for (m, r, v) in masses {
        J += m * (r - center).xy().norm_squared();
        h += m * (r - center).cross(&(v - drift)).z;
    }
    let omega = K(J, h);
    let moving =
        masses.iter().map(|(m, r, v)| m * (v - drift + omega * V::z().cross(&(r - center))).norm_squared());
    (omega, 0.5 * (moving.sum::<f64>() + own.iter().map(|[I, u]| I * (omega + u).powi(2)).sum::<f64>()))
}

/// A boom with its own mass and one at its tip, drawn in off the centre of mass in a plane; and the work of the drive, which is the energy
/// gained.
#[test]
fn mass_drawn_in_spins_the_body_up() {
    for units @ [m, s, kg] in UNITS {
        let frame = turned_axes();
        let direction = V::new(0.6, 0.8, 0.0);
        let root = V::new(-0.3, 0.4, 0.3) * m;
        let assembly = Assembly {
            carrier: Some(hub(frame, units)),
            booms: vec![Boom {
                name: "arm".into(),
                position: (frame * root).into(),
                direction: (frame * direction * 5.0).into(),
                mass: 4.0 * kg,
                tip_mass: 2.5 * kg,
                length: law(&format!("{m:e}*(3 - 0.2*t/{s:e} - 0.5*sin(0.3*t/{s:e}))")),
            }],
            ..Assembly::default()
        };
        let masses = |t: f64| {
            let (length, rate) =
                (m * (3.0 - 0.2 * t - 0.5 * (0.3 * t).sin()), -m / s * (0.2 + 0.15 * (0.3 * t).cos()));
            let (length, rate) = (length * direction, rate * direction);
            let gauss = [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()];
            let along = gauss.map(|share| (2.0 * kg, root + share * length, share * rate));
            let mut all =
                vec![(30.0 * kg, V::new(0.2, -0.1, 0.3) * m, V::zeros()), (2.5 * kg, root + length, rate)];
            all.extend(along);
            all
        };
        let own = [[11.0 * kg * m * m, 0.0]];
        let spin = 0.7 / s;
        let mut K = 0.0;
        let (_, first) = plane(&masses(0.0), &own, |J, h| {
            K = J * spin + h;
            spin
        });
        let times: Vec<f64> = [0.0, 1.3, 4.0, 7.7, 11.0].iter().map(|t| t * s).collect();
        for method in [Method::Explicit, Method::Implicit] {
            let seen = followed(&assembly, frame * V::z() * spin, &times, method);
            for (at, sample) in seen.samples.iter().enumerate() {
                let t = times[at] / s;
                let (omega, energy) = plane(&masses(t), &own, |J, h| (K - h) / J);
                let found = frame.inverse() * V::from(sample.omega);
                close(found.z, omega, omega, 1e-10, "spin");
                assert!(found.xy().norm() < 1e-10 * omega);
                close(sample.energy, energy, energy, 1e-10, "energy");
                close(sample.work, energy - first, energy, 1e-10, "work");
                close(seen.q[at][0], m * (3.0 - 0.2 * t - 0.5 * (0.3 * t).sin()), m, 1e-14, "length");
                assert!(sample.momentum_drift.abs() < 1e-11 && sample.energy_drift.abs() < 1e-11 * energy);
            }
            assert!(seen.samples[4].omega[2] != seen.samples[0].omega[2]);
        }
    }
}

const PANEL: [f64; 3] = [5.0, 1.4, 0.6];

/// A panel on a hinge along the third axis of a frame, in units; its own principal axis is parallel.
fn panel(frame: Rotation3<f64>, [m, _, kg]: [f64; 3], angle: PrescribedMotion) -> Hinged {
    let inertia = frame * Matrix3::from_diagonal(&V::new(0.5, 1.1, 1.6)) * frame.inverse() * (kg * m * m);
    Hinged {
        name: "panel".into(),
        mass: PANEL[0] * kg,
        center_of_mass: (frame * V::new(1.0 + PANEL[1], PANEL[2], 0.3) * m).into(),
        inertia: inertia.into(),
        hinge: (frame * V::new(1.0, 0.2, -0.4) * m).into(),
        axes: vec![(frame * V::new(0.0, 0.0, 2.0)).into()],
        stiffness: HingeCoefficient::PerAxis(vec![0.0]),
        damping: HingeCoefficient::PerAxis(vec![0.0]),
        rheology: Rheology::Elastic,
        angle: Some(angle),
        places: vec![("tip".into(), (frame * V::new(3.5, 0.9, 0.3) * m).into())],
    }
}

/// Opening by 90 degrees in free space: the spin by the conserved angular momentum, the attitude by a quadrature of it.
#[test]
fn a_panel_that_opens_turns_the_body_back() {
    for units @ [m, s, kg] in UNITS {
        let frame = turned_axes();
        let opening = law(&format!("{:e}*(1 - cos({:e}*t))", PI / 4.0, PI / 8.0 / s));
        let assembly = Assembly {
            carrier: Some(hub(frame, units)),
            hinged: vec![panel(frame, units, opening)],
            ..Assembly::default()
        };
        let moved = |t: f64| {
            let (angle, rate) =
                (PI / 4.0 * (1.0 - (PI / 8.0 * t).cos()), PI * PI / 32.0 * (PI / 8.0 * t).sin());
            let hinge = V::new(1.0, 0.2, 0.3) * m;
            let arm =
                Rotation3::from_axis_angle(&V::z_axis(), angle) * V::new(PANEL[1], PANEL[2] - 0.2, 0.0) * m;
            let masses = [
                (30.0 * kg, V::new(0.2, -0.1, 0.3) * m, V::zeros()),
                (PANEL[0] * kg, hinge + arm, rate / s * V::z().cross(&arm)),
            ];
            (masses, [[11.0 * kg * m * m, 0.0], [1.6 * kg * m * m, rate / s]])
        };
        for spin in [0.05 / s, -0.9 / s] {
            let mut K = 0.0;
            let (masses, own) = moved(0.0);
            let (_, first) = plane(&masses, &own, |J, h| {
                K = J * spin + h;
                spin
            });
            let rate = |t: f64| {
                let (masses, own) = moved(t);
                plane(&masses, &own, |J, h| (K - h) / J)
            };
            let times: Vec<f64> = (0..=8).map(|i| f64::from(i) * s).collect();
            let seen = followed(&assembly, frame * V::z() * spin, &times, Method::Automatic);
            let mut turned = 0.0;
            for (at, sample) in seen.samples.iter().enumerate() {
                let t = at as f64;
                let (omega, energy) = rate(t);
                if at > 0 {
                    turned += s * simpson(|t| rate(t).0, t - 1.0, t);
                }
                close((frame.inverse() * V::from(sample.omega)).z, omega, spin.abs(), 1e-9, "spin");
                close(sample.energy, energy, energy, 1e-9, "energy");
                close(sample.work, energy - first, energy.max(first), 1e-9, "work");
                let known = Rotation3::from_axis_angle(&Unit::new_normalize(frame * V::z()), turned);
                let x = rotation::to_inertial(sample.attitude, [1.0, 0.0, 0.0]);
                assert!((V::from(x) - known * V::x()).norm() < 1e-9, "attitude at {t}");
            }
            let [last] = *seen.q.last().unwrap().as_slice() else { panic!() };
            close(last, PI / 2.0, 1.0, 1e-14, "angle");
        }
    }
}

fn simpson(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let steps = 400;
    let h = (to - from) / f64::from(steps);
    let weight = |i: i32| {
        if i == 0 || i == steps {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    (0..=steps).map(|i| weight(i) * f(from + h * f64::from(i))).sum::<f64>() * h / 3.0
}

/// At the end of a run at a constant rate the part stops at once: the momentum goes through, the energy falls by the work of the stop.
#[test]
fn a_corner_of_a_law_is_a_blow_of_the_drive() {
    let (frame, units) = (turned_axes(), UNITS[0]);
    let with = |angle: &str| Assembly {
        carrier: Some(hub(frame, units)),
        hinged: vec![panel(frame, units, law(angle))],
        ..Assembly::default()
    };
    let spin = frame * V::new(0.3, -0.2, 0.6);
    let times: Vec<f64> = (0..=40).map(|i| 0.25 * f64::from(i)).collect();
    let seen = followed(&with("0.2*min(t, 5) + 0*t"), spin, &times, Method::Automatic);
    let largest = seen.samples.iter().map(|sample| sample.energy).fold(0.0, f64::max);
    for sample in &seen.samples {
        assert!(sample.energy_drift.abs() < 1e-11 * largest, "{} {:e}", sample.t, sample.energy_drift);
    }
    let until = followed(&with("0.2*t"), spin, &times, Method::Automatic);
    close(seen.samples[20].energy, until.samples[20].energy, largest, 1e-11, "before the corner");
    assert_eq!(seen.rate[20][0], 0.2);
    assert_eq!(seen.rate[21][0], 0.0);
    // after the stop the body is rigid: its spin follows from the momentum, and its energy stays
    let rigid = with("1 + 0*t").body().unwrap();
    let J = Matrix3::from(sym3::rows(rigid.full_inertia_at(&[1.0])));
    for sample in &seen.samples[21..] {
        let omega = J.try_inverse().unwrap() * V::from(sample.angular_momentum);
        assert!((omega - V::from(sample.omega)).norm() < 1e-10 * omega.norm());
        close(sample.energy, 0.5 * omega.dot(&V::from(sample.angular_momentum)), largest, 1e-11, "rigid");
    }
    let blow = seen.samples[21].work - seen.samples[20].work;
    assert!(blow.abs() > 1e-3 * largest, "{blow}");
}

/// A hub with two driven panels about skew axes, a boom, a panel on a spring with a damper, and a sprung point.
fn ensemble(frame: Rotation3<f64>) -> Assembly {
    let first = Hinged {
        axes: vec![(frame * V::new(0.3, 1.0, 0.2)).into()],
        ..panel(frame, UNITS[0], law("0.8*sin(0.4*t + 0.3)"))
    };
    let second = Hinged {
        name: "wing".into(),
        hinge: (frame * V::new(-1.0, 0.1, 0.2)).into(),
        center_of_mass: (frame * V::new(-2.1, 0.5, 0.4)).into(),
        axes: vec![(frame * V::new(-0.5, 0.4, 1.0)).into()],
        ..panel(frame, UNITS[0], law("0.25*t - 0.02*t*t"))
    };
    let sprung = Hinged {
        name: "whip".into(),
        hinge: (frame * V::new(0.1, -1.0, 0.0)).into(),
        center_of_mass: (frame * V::new(0.2, -2.0, 0.3)).into(),
        axes: vec![(frame * V::new(1.0, 0.2, -0.3)).into()],
        stiffness: HingeCoefficient::PerAxis(vec![14.0]),
        damping: HingeCoefficient::PerAxis(vec![0.9]),
        angle: None,
        ..panel(frame, UNITS[0], law("t"))
    };
    let boom = Boom {
        name: "boom".into(),
        position: (frame * V::new(0.2, 0.9, 0.5)).into(),
        direction: (frame * V::new(0.2, 1.0, 0.4)).into(),
        mass: 1.5,
        tip_mass: 0.8,
        length: law("1.5 + 0.3*t - 0.2*cos(0.7*t)"),
    };
    Assembly {
        carrier: Some(hub(frame, UNITS[0])),
        points: vec![parts::line_point(
            "bob",
            0.7,
            (frame * V::new(0.4, 0.3, -0.8)).into(),
            (frame * V::new(0.5, 0.1, 1.0)).into(),
        )],
        springs: vec![parts::spring(End::Point(0), End::Carrier, parts::isotropic(25.0, 0.4))],
        hinged: vec![first, second, sprung],
        booms: vec![boom],
        ..Assembly::default()
    }
}

const SPIN: [f64; 3] = [0.5, -0.35, 0.4];

/// Momentum and energy with all of it, from the loads along the way and from the state.
#[test]
fn a_tumbling_body_keeps_its_balances() {
    let frame = turned_axes();
    let times: Vec<f64> = (0..=20).map(f64::from).collect();
    for method in [Method::Explicit, Method::Implicit] {
        let seen = followed(&ensemble(frame), frame * V::from(SPIN), &times, method);
        let largest = seen.samples.iter().map(|sample| sample.energy).fold(0.0, f64::max);
        let last = seen.samples.last().unwrap();
        for sample in &seen.samples {
            assert!(sample.momentum_drift.abs() < 1e-10, "{:e}", sample.momentum_drift);
            assert!(sample.energy_drift.abs() < 1e-10 * largest, "{:e}", sample.energy_drift);
        }
        assert!(last.dissipated > 1e-3 * largest && last.work.abs() > 1e-2 * largest);
    }
    // the same numbers in other axes
    let upright = followed(&ensemble(Rotation3::identity()), V::from(SPIN), &times, Method::Automatic);
    let turned = followed(&ensemble(frame), frame * V::from(SPIN), &times, Method::Automatic);
    for (one, other) in upright.samples.iter().zip(&turned.samples) {
        assert!((frame * V::from(one.omega) - V::from(other.omega)).norm() < 1e-9);
        close(one.work, other.work, one.energy, 1e-9, "work in turned axes");
    }
}

/// Point masses with the inertia of a rigid body: two on each principal axis through the centre of mass.
fn grains(mass: f64, center: V, inertia: Matrix3<f64>) -> Vec<(f64, V)> {
    let eigen = inertia.symmetric_eigen();
    let trace = eigen.eigenvalues.sum();
    let pair = |axis: usize| {
        let second = 0.5 * trace - eigen.eigenvalues[axis];
        let arm = (3.0 * second.max(0.0) / mass).sqrt() * eigen.eigenvectors.column(axis);
        [(mass / 6.0, center + arm), (mass / 6.0, center - arm)]
    };
    (0..3).flat_map(pair).collect()
}

/// Places (m) of all point masses of the ensemble at coordinates in the program's order: bob, three hinges, boom.
fn places(assembly: &Assembly, q: &[f64]) -> Vec<(f64, V)> {
    let carrier = assembly.carrier.as_ref().unwrap();
    let mut all = grains(carrier.mass, carrier.center_of_mass.into(), carrier.inertia.into());
    let bob = &assembly.points[0];
    let quasirigid::elements::PointMotion::Line(line) = bob.motion else { panic!() };
    all.push((bob.mass, V::from(bob.position) + q[0] * V::from(line).normalize()));
    for (part, angle) in assembly.hinged.iter().zip(&q[1..]) {
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(part.axes[0].into()), *angle);
        let hinge = V::from(part.hinge);
        let own = grains(part.mass, part.center_of_mass.into(), part.inertia.into());
        all.extend(own.into_iter().map(|(m, p)| (m, hinge + turn * (p - hinge))));
    }
    let boom = &assembly.booms[0];
    let (root, along) = (V::from(boom.position), q[4] * V::from(boom.direction).normalize());
    for share in [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()] {
        all.push((0.5 * boom.mass, root + share * along));
    }
    all.push((boom.tip_mass, root + along));
    all
}

/// Angular acceleration and accelerations of the free coordinates by Newton and Euler for point masses, whose velocities and accelerations
/// relative to the body are differences of their places along the motion of the coordinates.
fn accelerations(assembly: &Assembly, omega: V, [q, rate, driven]: [&[f64]; 3]) -> DVector<f64> {
    let residual = |x: &[f64]| -> DVector<f64> {
        let second = [x[3], driven[0], driven[1], x[4], driven[2]];
        let step = 1e-3;
        let at = |t: f64| {
            let moved: Vec<f64> = (0..5).map(|j| q[j] + rate[j] * t + 0.5 * second[j] * t * t).collect();
            places(assembly, &moved)
        };
        let path = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| at(k * step));
        let still = &path[2];
        let mass: f64 = still.iter().map(|each| each.0).sum();
        let sum = |weights: [f64; 5], i: usize| (0..5).map(|k| weights[k] * path[k][i].1).sum::<V>();
        let center = still.iter().map(|(m, p)| *m * p).sum::<V>() / mass;
        let turning = V::new(x[0], x[1], x[2]);
        let absolute: Vec<V> = (0..still.len())
            .map(|i| {
                let p = still[i].1 - center;
                let v = sum([1.0, -8.0, 0.0, 8.0, -1.0], i) / (12.0 * step);
                let a = sum([-1.0, 16.0, -30.0, 16.0, -1.0], i) / (12.0 * step * step);
                a + 2.0 * omega.cross(&v) + turning.cross(&p) + omega.cross(&omega.cross(&p))
            })
            .collect();
        let mean = still.iter().zip(&absolute).map(|((m, _), a)| *m * a).sum::<V>() / mass;
        let moment: V =
            still.iter().zip(&absolute).map(|((m, p), a)| *m * (p - center).cross(&(a - mean))).sum();
        let along = |j: usize| {
            let at = |t: f64| {
                let mut moved = q.to_vec();
                moved[j] += t;
                places(assembly, &moved)
            };
            let (up, down) = (at(step), at(-step));
            let (far, low) = (at(2.0 * step), at(-2.0 * step));
            (0..still.len())
                .map(|i| {
                    let slope = (8.0 * (up[i].1 - down[i].1) - (far[i].1 - low[i].1)) / (12.0 * step);
                    still[i].0 * slope.dot(&(absolute[i] - mean))
                })
                .sum::<f64>()
        };
        let bob = along(0) + 25.0 * q[0] + 0.4 * rate[0];
        let whip = along(3) + 14.0 * q[3] + 0.9 * rate[3];
        DVector::from_vec(vec![moment.x, moment.y, moment.z, bob, whip])
    };
    let zero = residual(&[0.0; 5]);
    let column = |j: usize| {
        let mut unit = [0.0; 5];
        unit[j] = 1.0;
        residual(&unit) - &zero
    };
    let matrix = DMatrix::from_columns(&(0..5).map(column).collect::<Vec<_>>());
    -matrix.lu().solve(&zero).unwrap()
}

#[test]
fn accelerations_are_those_of_point_masses() {
    let frame = turned_axes();
    let assembly = ensemble(frame);
    let (middle, step) = (3.2, 2e-3);
    let times: Vec<f64> = (-2..=2).map(|k| middle + f64::from(k) * step).collect();
    let seen = followed(&assembly, frame * V::from(SPIN), &times, Method::Explicit);
    let slope =
        |values: [f64; 5]| (values[0] - 8.0 * values[1] + 8.0 * values[3] - values[4]) / (12.0 * step);
    let of = |value: &dyn Fn(usize) -> f64| slope([0, 1, 2, 3, 4].map(value));
    let found = [
        of(&|k| seen.samples[k].omega[0]),
        of(&|k| seen.samples[k].omega[1]),
        of(&|k| seen.samples[k].omega[2]),
        of(&|k| seen.rate[k][0]),
        of(&|k| seen.rate[k][3]),
    ];
    let t = middle;
    let driven = [-0.8 * 0.16 * (0.4 * t + 0.3).sin(), -0.04, 0.2 * 0.49 * (0.7 * t).cos()];
    let omega = V::from(seen.samples[2].omega);
    let known = accelerations(&assembly, omega, [&seen.q[2], &seen.rate[2], &driven]);
    for (at, found) in found.iter().enumerate() {
        close(*found, known[at], known.amax(), 1e-7, &format!("acceleration {at}"));
    }
}

/// A boom that jerks out within milliseconds and shakes, with a peak of 9 kJ; panels with corners at the start and at the same moments.
#[test]
fn work_of_fast_drives_is_followed() {
    let mut jerk = ensemble(turned_axes());
    jerk.booms[0].length = law("1.5 + 0.2*exp(-((t-5.3)/0.002)^2) + 0.01*sin(40*t)");
    jerk.hinged[0].angle = Some(law("abs(t - 3) + 0.3*min(t, 7)"));
    jerk.hinged[1].angle = Some(law("0.1*max(0, t) - 0.1*max(0, t - 7)"));
    for method in [Method::Explicit, Method::Implicit] {
        let seen = followed(&jerk, SPIN.into(), &[0.0, 2.0, 4.0, 6.0, 8.0], method);
        for sample in &seen.samples {
            assert!(sample.energy_drift.abs() < 1e-9 * 9e3, "{:e}", sample.energy_drift);
        }
    }
}

/// What acts beside drives: a force on a driven panel, a torque, a motor of a wheel whose speed changes.
#[test]
fn drives_work_beside_forces_and_motors() {
    let frame = turned_axes();
    let tip = ApplicationPoint { on: End::Hinged(PlaceRef { hinged: 0, place: 0 }), at: None };
    let wave = Wave::default();
    let push = ForceLaw::Thrust { at: tip, force: [0.4, -0.3, 0.2], axes: Axes::Inertial, wave };
    let torque = ForceLaw::Torque { torque: [0.1, 0.3, -0.2], axes: Axes::Body, wave };
    let speed = Expression::parse("20*t + 3*sin(2*t)", &["t"]).unwrap();
    let assembly = Assembly {
        forces: vec![Force { name: "push".into(), law: push }, Force { name: "jet".into(), law: torque }],
        wheels: vec![Wheel {
            name: "wheel".into(),
            axis: [0.3, 0.5, 1.0],
            speed: WheelSpeed::Prescribed { inertia: 0.02, speed },
        }],
        ..ensemble(frame)
    };
    let times: Vec<f64> = (0..=10).map(f64::from).collect();
    let seen = followed(&assembly, frame * V::from(SPIN), &times, Method::Automatic);
    let largest = seen.samples.iter().map(|sample| sample.energy).fold(0.0, f64::max);
    for sample in &seen.samples {
        assert!(sample.momentum_drift.abs() < 1e-10 && sample.energy_drift.abs() < 1e-10 * largest);
    }
}

#[test]
fn two_booms_in_one_place_are_one() {
    let frame = turned_axes();
    let one = ensemble(frame);
    let half = |name: &str| {
        let boom = one.booms[0].clone();
        Boom { name: name.into(), mass: 0.5 * boom.mass, tip_mass: 0.5 * boom.tip_mass, ..boom }
    };
    let two = Assembly { booms: vec![half("left"), half("right")], ..one.clone() };
    let times = [0.0, 3.0, 9.0];
    let [one, two] = [one, two].map(|body| followed(&body, frame * V::from(SPIN), &times, Method::Automatic));
    for (a, b) in one.samples.iter().zip(&two.samples) {
        assert!((V::from(a.omega) - V::from(b.omega)).norm() < 1e-10);
        close(a.work, b.work, a.energy, 1e-10, "work");
    }
}

/// A part at a constant place is part of the rigid body there, in numbers of its own and by a formula without the time.
#[test]
fn locked_parts_are_rigid() {
    let frame = turned_axes();
    let lock = |angle: PrescribedMotion, length: PrescribedMotion| {
        let mut body = ensemble(frame);
        body.hinged.truncate(1);
        body.points.clear();
        body.springs.clear();
        body.hinged[0].angle = Some(angle);
        body.booms[0].length = length;
        body
    };
    let locked = lock(PrescribedMotion::Constant(1.1), law("4/2")).body().unwrap();
    assert_eq!((locked.coordinates().len(), locked.drives().len()), (0, 0));
    let driven = lock(law("1.1 + 0*t"), law("2 + 0*t")).body().unwrap();
    assert_eq!(driven.drives().len(), 2);
    // about the centre of mass of each: that of the driven body is displaced from its pole
    let J = Matrix3::from(sym3::rows(driven.full_inertia_at(&[1.1, 2.0])));
    let known = Matrix3::from(locked.inertia());
    assert!((J - known).amax() < 1e-13 * known.amax(), "{J} {known}");
    assert!(reduce(&locked, 3).is_ok());
}

#[test]
fn answers_about_rest_and_steady_spins_are_refused() {
    let assembly = ensemble(turned_axes());
    let body = assembly.body().unwrap();
    let Err(ReductionError::Driven { coordinates }) = reduce(&body, 3) else { panic!() };
    assert!(coordinates.contains("\"panel\" about axis 1") && coordinates.contains("\"boom\" length"));
    let spin = RelativeEquilibrium::near(&body, [0.0, 0.0, 1.0], SpinMagnitude::Rate(1.0));
    assert!(matches!(spin, Err(EquilibriumError::Driven { .. })));
    let system = Forced::not(&body);
    let settled = quasirigid::dynamics::Start::new([0.1, 0.0, 1.0], ALIGNED).settled(system, 3);
    assert!(settled.is_err());
    let refused = |angle: &str| {
        let mut assembly = ensemble(turned_axes());
        assembly.hinged[1].angle = Some(law(angle));
        let body = assembly.body().unwrap();
        let start = FullState::at_rest(&body, SPIN, ALIGNED);
        propagate_full(Forced::not(&body), &start, &[0.0, 9.0], &Options::default(), &mut Seen::default())
            .unwrap_err()
    };
    let PropagateError::Drive { coordinate: 2, fault } = refused("0.3*step(t - 4)") else { panic!() };
    assert!(matches!(fault, DriveFault::Jump { t, .. } if (t - 4.0).abs() < 1e-12));
    assert!(matches!(refused("sqrt(t)"), PropagateError::Drive { fault: DriveFault::NoValue { .. }, .. }));
}

#[test]
fn drives_that_mean_nothing_are_refused() {
    let problem = |change: &dyn Fn(&mut Assembly)| {
        let mut assembly = ensemble(turned_axes());
        change(&mut assembly);
        let error = assembly.check().into_iter().next().unwrap();
        assert_eq!(assembly.body().unwrap_err().field, error.field);
        (error.field.key(), error.problem)
    };
    let two = problem(&|body| body.hinged[0].axes.push([1.0, 0.0, 0.0]));
    assert_eq!(two, ("angle", Problem::DrivenAxes { count: 2 }));
    let spring = problem(&|body| body.hinged[0].damping = HingeCoefficient::PerAxis(vec![1e-9]));
    assert_eq!(spring, ("damping", Problem::DrivenSpring));
    let empty = problem(&|body| (body.booms[0].mass, body.booms[0].tip_mass) = (0.0, 0.0));
    assert!(matches!(empty, ("mass", Problem::NotAMass { .. })));
    let nowhere = problem(&|body| body.booms[0].length = law("ln(t - 1)"));
    assert!(matches!(nowhere, ("length", Problem::NotFinite { .. })));
    let negative = problem(&|body| body.booms[0].mass = -1.0);
    assert_eq!(negative.0, "mass");
}

/// Step by step under no torque, as in one go; a law with a corner is refused there.
#[test]
fn steppers_take_smooth_laws() {
    let assembly = ensemble(turned_axes());
    let body = assembly.body().unwrap();
    let start = FullState::at_rest(&body, SPIN, ALIGNED);
    let options = Options { tolerance: 1e-12, ..Options::default() };
    let mut stepper = FullStepper::new(Forced::not(&body), &start, options).unwrap();
    let seen = followed(&assembly, SPIN.into(), &[0.0, 2.0, 4.0], Method::Automatic);
    for (known, q) in seen.samples[1..].iter().zip(&seen.q[1..]) {
        for _ in 0..20 {
            stepper.step([0.0; 3], 0.1).unwrap();
        }
        let state = stepper.state();
        assert!((V::from(state.omega) - V::from(known.omega)).norm() < 1e-10);
        assert!(state.q.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-10));
    }
    let mut cornered = assembly.clone();
    cornered.booms[0].length = law("1 + min(t, 3)");
    let body: FlexibleBody = cornered.body().unwrap();
    let refused = FullStepper::new(Forced::not(&body), &start, Options::default()).err();
    assert!(matches!(refused, Some(StepperError::Cornered { name }) if name == "boom"));
}
