//! Eddy currents: the torque in plain vectors, closed forms, and the average against the rotation itself. (F15), (F17), (A14), (A15)

use std::ops::ControlFlow;

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use quasirigid::averaging::{
    Drift, DriftLimits, DriftState, DriftStopReason, EddyTorque, FreeRotation, MeanPower, RotationState,
    SlowTorque,
};
use quasirigid::model::force::{Force, ForceLaw, MagneticField, Orbit, OrbitPoint};
use quasirigid::model::{Mode, Principal};
use quasirigid_math::rotation::normalized;
use quasirigid_math::vec3::{cross, dot};

use super::forced::{State, forced, orbit, states};
use crate::support::{assemblies, cases, parts, vector};

type V = Vector3<f64>;
type M = Matrix3<f64>;

/// Attitude at the start, as a rotation vector.
const TURN: V = V::new(0.4, -0.9, 0.7);

/// Power of a body that dissipates nothing itself.
#[derive(Debug)]
struct Rigid([f64; 3]);

impl MeanPower for Rigid {
    fn moments(&self) -> [f64; 3] {
        self.0
    }

    fn mean_power(&self, _: &FreeRotation) -> f64 {
        0.0
    }
}

/// Field of a dipole that turns about z, written here from the place and Rodrigues' formula.
fn field(strength: [f64; 3], rate: f64, orbit: &Orbit, t: f64) -> V {
    let m = nalgebra::Rotation3::from_axis_angle(&V::z_axis(), rate * t) * V::from(strength);
    let R = V::from(orbit.at(t).place);
    3.0 * R * R.dot(&m) / R.norm().powi(5) - m / R.norm().powi(3)
}

/// Symmetric matrix without negative eigenvalues: a sum of squares.
fn tensor(parts: [[f64; 3]; 3]) -> M {
    parts.into_iter().map(|part| V::from(part) * V::from(part).transpose()).sum()
}

proptest! {
    #![proptest_config(cases(64))]

    /// Worked out in inertial axes, with the tensor turned there and the rate of the field by differences: torque, its power, and the heat.
    #[test]
    fn torque_is_that_of_plain_vectors(
        assembly in assemblies(), loose in states(), parts in [vector(), vector(), vector()],
        strength in vector(), rate in -2.0..2.0, orbit in orbit(),
    ) {
        let M_B = tensor(parts);
        let law = ForceLaw::EddyCurrent {
            tensor: M_B.into(),
            decay_time: 0.0,
            field: MagneticField::Dipole { strength, rate, orbit },
        };
        let assembly = forced(&assembly, vec![Force { name: "currents".into(), law }]);
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let state = State::of(&body, &loose, 0.5);
        let loads = body.loads(&forces, &state.kinematics());
        let turn = state.turn();
        let B = field(strength, rate, &orbit, state.t);
        let apart = 1e-4 / (orbit.mean_motion() / (1.0 - orbit.eccentricity).powi(2) + rate.abs());
        let of = |steps: f64| field(strength, rate, &orbit, state.t + steps * apart);
        let change = (8.0 * (of(1.0) - of(-1.0)) - (of(2.0) - of(-2.0))) / (12.0 * apart);
        let cut = (turn * V::from(state.omega)).cross(&B) - change;
        let moment = turn * M_B * turn.transpose() * cut;
        let torque = turn.transpose() * moment.cross(&B);
        let turning = V::from(state.omega).norm() * B.norm() + change.norm();
        let size = M_B.norm() * turning * B.norm();
        // Differences of fourth order.
        prop_assert!((V::from(loads.moment) - torque).norm() <= 1e-10 * size, "{:?} {torque}", loads.moment);
        // Work on the body and on what moves the field, less the heat.
        let power = loads.power(state.kinematics().motion, [0.0; 3]);
        let heat = cut.dot(&moment);
        prop_assert!((power + moment.dot(&change) + heat).abs() <= 1e-10 * M_B.norm() * turning * turning);
        prop_assert!(heat >= 0.0, "{heat}");
        prop_assert!(loads.force == [0.0; 3] && loads.generalized.iter().all(|load| *load == 0.0));
    }
}

fn drift(moments: [f64; 3], tensor: M, field: MagneticField) -> Drift<Rigid> {
    let torque =
        SlowTorque { eddy: Some(EddyTorque { tensor: tensor.into(), field }), ..SlowTorque::default() };
    Drift::new(Rigid(moments), &Principal { moments, axes: parts::diag([1.0; 3]) }, torque)
}

fn start(rotation_state: RotationState, angular_momentum: f64, direction: V) -> DriftState {
    DriftState {
        t: 0.0,
        rotation_state,
        angular_momentum,
        side: 1.0,
        direction: direction.normalize().into(),
        revolutions: 0.0,
    }
}

fn ended(drift: &Drift<Rigid>, start: DriftState, duration: f64) -> DriftState {
    let history = drift.follow(start, &[], &DriftLimits::until(duration), |_| ControlFlow::Continue(()));
    assert_eq!(history.ending, DriftStopReason::Finished);
    history.end
}

/// In a uniform field the part of the angular momentum along it stays, and that across it falls as `e^{−MB²t/I}`: of a sphere, and of a
/// steady spin, whose tensor is averaged about the spin.
#[test]
fn uniform_fields_leave_the_part_along_them() {
    let B = V::new(2e-3, -1e-3, 3e-3);
    let uniform = MagneticField::Uniform(B.into());
    let [I1, I2, I3] = [2.0, 3.0, 4.0];
    let wide = M::from_diagonal(&V::new(100.0, 300.0, 50.0));
    let cases = [
        ([2.0; 3], M::from_diagonal_element(200.0), Mode::ShortAxis, 100.0),
        ([I1, I2, I3], M::from_diagonal_element(400.0), Mode::ShortAxis, 100.0),
        ([I1, I2, I3], wide, Mode::ShortAxis, 200.0 / I3),
        ([I1, I2, I3], wide, Mode::LongAxis, 175.0 / I1),
    ];
    for (moments, tensor, mode, per_field) in cases {
        let along = B.normalize();
        for u in [V::new(1.0, 2.0, 0.0), along, V::new(-3.0, 1.0, 0.2)] {
            let u = u.normalize();
            let t = 1.3 / (per_field * B.norm_squared());
            let end = ended(&drift(moments, tensor, uniform), start(RotationState::steady(mode), 5.0, u), t);
            let kept = u.dot(&along) * along;
            let K = 5.0 * (kept + (u - kept) * (-1.3f64).exp());
            let found = end.angular_momentum * V::from(end.direction);
            assert!((found - K).norm() < 1e-9 * 5.0, "{moments:?} {mode:?}: {found} {K}");
        }
    }
}

/// The field of a dipole that turns about z, and its rate, by its derivative.
fn field_with_rate(strength: [f64; 3], rate: f64, orbit: &Orbit, t: f64) -> [[f64; 3]; 2] {
    let (sin, cos) = (rate * t).sin_cos();
    let [x, y, z] = strength;
    let m = [cos * x - sin * y, sin * x + cos * y, z];
    let turned = [-rate * m[1], rate * m[0], 0.0];
    let OrbitPoint { place: R, velocity: v, .. } = orbit.at(t);
    let square = dot(R, R);
    let (cube, fifth) = (square * square.sqrt(), square * square * square.sqrt());
    let (along, outward) = (dot(R, m), dot(R, v));
    let change = dot(v, m) + dot(R, turned) - 5.0 * along * outward / square;
    let mut fields = [[0.0; 3]; 2];
    for i in 0..3 {
        fields[0][i] = 3.0 * R[i] * along / fifth - m[i] / cube;
        fields[1][i] = 3.0 * (v[i] * along + R[i] * change + m[i] * outward) / fifth - turned[i] / cube;
    }
    fields
}

/// The derivative is that of differences of the field.
#[test]
fn the_rate_of_the_field_is_its_derivative() {
    let orbit = slow_orbit(0.03, 0.1);
    let (strength, rate, t, apart) = ([0.3, -0.2, 0.9], 0.02, 40.0, 1e-2);
    let [B, change] = field_with_rate(strength, rate, &orbit, t).map(V::from);
    let of = |t: f64| field(strength, rate, &orbit, t);
    assert!((B - of(t)).norm() < 1e-14 * B.norm());
    let difference = (of(t + apart) - of(t - apart)) / (2.0 * apart);
    assert!((change - difference).norm() < 1e-6 * change.norm(), "{change} {difference}");
}

/// Rotation in plain vectors: angular momentum in inertial axes and attitude, by the classical method of Runge and Kutta.
struct Turning<'a> {
    moments: [f64; 3],
    tensor: [[f64; 3]; 3],
    /// Field and its rate at a time.
    fields: &'a dyn Fn(f64) -> [[f64; 3]; 2],
    K: [f64; 3],
    attitude: [f64; 4],
    /// Time of the end of the last step, with field and rate there.
    last: Option<(f64, [[f64; 3]; 2])>,
}

/// `K + h dK`, `q + h dq`.
fn moved(K: [f64; 3], q: [f64; 4], h: f64, rate: &([f64; 3], [f64; 4])) -> ([f64; 3], [f64; 4]) {
    let (mut K, mut q) = (K, q);
    (0..3).for_each(|i| K[i] += h * rate.0[i]);
    (0..4).for_each(|i| q[i] += h * rate.1[i]);
    (K, q)
}

/// Components in the axes of a unit quaternion, or with the opposite sign of its vector in those from which it turns.
fn seen([s, x, y, z]: [f64; 4], sign: f64, vector: [f64; 3]) -> [f64; 3] {
    let axis = [-sign * x, -sign * y, -sign * z];
    let once = cross(axis, vector);
    let twice = cross(axis, once);
    let mut seen = vector;
    (0..3).for_each(|i| seen[i] += 2.0 * (s * once[i] + twice[i]));
    seen
}

impl Turning<'_> {
    fn omega(&self, K: [f64; 3], attitude: [f64; 4]) -> [f64; 3] {
        let [x, y, z] = seen(attitude, 1.0, K);
        [x / self.moments[0], y / self.moments[1], z / self.moments[2]]
    }

    fn rate(&self, [B, change]: [[f64; 3]; 2], K: [f64; 3], attitude: [f64; 4]) -> ([f64; 3], [f64; 4]) {
        let turn = normalized(attitude);
        let omega = self.omega(K, turn);
        let B_B = seen(turn, 1.0, B);
        let (cut, change) = (cross(omega, B_B), seen(turn, 1.0, change));
        let mut moment = [0.0; 3];
        for i in 0..3 {
            for k in 0..3 {
                moment[i] += self.tensor[i][k] * (cut[k] - change[k]);
            }
        }
        let [s, x, y, z] = attitude;
        let [u, v, w] = omega;
        let turning =
            [-x * u - y * v - z * w, s * u + y * w - z * v, s * v + z * u - x * w, s * w + x * v - y * u];
        (seen(turn, -1.0, cross(moment, B_B)), turning.map(|part| 0.5 * part))
    }

    fn step(&mut self, t: f64, h: f64) {
        let first = match self.last {
            Some((end, fields)) if (t - end).abs() < 1e-6 * h => fields,
            _ => (self.fields)(t),
        };
        let (middle, end) = ((self.fields)(t + 0.5 * h), (self.fields)(t + h));
        let k1 = self.rate(first, self.K, self.attitude);
        let (K, q) = moved(self.K, self.attitude, 0.5 * h, &k1);
        let k2 = self.rate(middle, K, q);
        let (K, q) = moved(self.K, self.attitude, 0.5 * h, &k2);
        let k3 = self.rate(middle, K, q);
        let (K, q) = moved(self.K, self.attitude, h, &k3);
        let k4 = self.rate(end, K, q);
        for (rate, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            (self.K, self.attitude) = moved(self.K, self.attitude, weight * h / 6.0, &rate);
        }
        self.attitude = normalized(self.attitude);
        self.last = Some((t + h, end));
    }

    fn energy(&self) -> f64 {
        let omega = self.omega(self.K, self.attitude);
        0.5 * (0..3).map(|i| self.moments[i] * omega[i] * omega[i]).sum::<f64>()
    }
}

fn words(turn: UnitQuaternion<f64>) -> [f64; 4] {
    [turn.w, turn.i, turn.j, turn.k]
}

fn slow_orbit(n: f64, precession: f64) -> Orbit {
    Orbit {
        mu: n * n,
        semi_major_axis: 1.0,
        eccentricity: 0.2,
        inclination: 1.9,
        raan: 0.4,
        argument_of_periapsis: 0.8,
        mean_anomaly: 0.3,
        node_rate: precession * n,
        periapsis_rate: -precession * n,
    }
}

/// Relative differences of angular momentum, energy and direction between the average and the rotation itself, where orbit and decay are
/// slower than the spin by this factor, and by its square; with the changes themselves.
fn gaps(weakness: f64, omega: V, [rate, precession]: [f64; 2]) -> [f64; 3] {
    let moments = [2.0, 3.0, 4.0];
    let tensor = tensor([[0.9, 0.3, -0.2], [0.1, 0.8, 0.5], [-0.4, 0.2, 1.4]]);
    let n = 0.06 / weakness;
    let orbit = slow_orbit(n, precession / weakness);
    let strength: [f64; 3] = (0.05 / weakness * V::new(0.3, -0.2, 0.9)).into();
    let rate = rate * n;
    let law = MagneticField::Dipole { strength, rate, orbit };
    let of_time = |t: f64| field_with_rate(strength, rate, &orbit, t);
    let turned = UnitQuaternion::from_scaled_axis(TURN);
    let K = turned * V::from(moments).component_mul(&omega);
    let attitude = words(turned);
    let mut body =
        Turning { moments, tensor: tensor.into(), fields: &of_time, K: K.into(), attitude, last: None };
    let orbits = 10.0 * weakness;
    let duration = orbits.round() * orbit.period();
    let motion = FreeRotation::through(moments, omega.into()).unwrap();
    let from = start(RotationState::from_motion(&motion).unwrap(), K.norm(), K);
    let end = ended(&drift(moments, tensor, law), from, duration);
    let steps = (duration * omega.norm() / 0.1).ceil();
    for i in 0..steps as u64 {
        body.step(i as f64 * duration / steps, duration / steps);
    }
    let reached =
        FreeRotation::at_logit(moments, end.angular_momentum, end.rotation_state.mode, end.rotation_state.xi);
    let (direction, turned) = (V::from(end.direction), V::from(body.K));
    println!(
        "weaker by {weakness}: {:.0} revolutions, G {:.4} {:.6} {:.6}, E {:.4} {:.6} {:.6}, turned {:.4} {:.4} rad",
        end.revolutions,
        K.norm(),
        turned.norm(),
        end.angular_momentum,
        motion.energy(),
        body.energy(),
        reached.energy(),
        K.angle(&turned),
        K.angle(&direction)
    );
    [
        (turned.norm() / end.angular_momentum - 1.0).abs(),
        (body.energy() / reached.energy() - 1.0).abs(),
        turned.angle(&direction),
    ]
}

/// A tumbling body with a tensor of its own in a dipole's field along an eccentric orbit: the slower the orbit and the decay, the nearer the
/// average. The second passes from the long-axis to the short-axis mode, where the average is least accurate; the dipole of the third turns, twice
/// in five orbits, so that it ends in the phase in which it began, where the average has no error of first order; the orbit of the fourth precesses
/// as slowly as the body is braked, node and periapsis once round.
#[test]
fn average_is_that_of_the_rotation() {
    let cases = [
        (V::new(0.5, 0.3, 0.9), [0.0; 2], 1e-3),
        (V::new(1.1, 0.2, 0.3), [0.0; 2], 0.02),
        (V::new(0.3, 0.4, 0.9), [0.4, 0.0], 4e-3),
        (V::new(0.3, 0.4, 0.9), [0.0, 0.1], 4e-3),
    ];
    for (omega, rates, tolerance) in cases {
        let [strong, weak] = [2.0, 8.0].map(|weakness| gaps(weakness, omega, rates));
        println!("{strong:?} {weak:?}");
        assert!(weak.iter().all(|gap| *gap < tolerance), "{strong:?} {weak:?}");
        assert!(weak.iter().sum::<f64>() < 0.5 * strong.iter().sum::<f64>(), "{strong:?} {weak:?}");
    }
}

/// A ball in a field that turns along its orbit comes to a spin of about twice the orbital rate: `dK/dt = −(M/I) N K + M L` is linear, and 1.8
/// times the orbital rate ends it on a circular polar orbit. The rotation itself comes there, too.
#[test]
fn a_slow_spin_locks_to_the_turning_field() {
    let n = 0.7;
    let polar = Orbit {
        mu: n * n,
        semi_major_axis: 1.0,
        eccentricity: 0.0,
        inclination: 0.5 * std::f64::consts::PI,
        raan: 0.9,
        argument_of_periapsis: 0.0,
        mean_anomaly: 0.3,
        node_rate: 0.0,
        periapsis_rate: 0.0,
    };
    let (I, conductor) = (3.0, 40.0);
    let normal = V::new(0.9f64.sin(), -0.9f64.cos(), 0.0);
    let aslant = Orbit { eccentricity: 0.3, inclination: 1.1, argument_of_periapsis: 0.5, ..polar };
    for (orbit, rate, direction) in [
        (polar, 0.0, V::new(0.2, -0.5, 1.0)),
        (polar, 0.0, -normal + 0.1 * V::z()),
        (aslant, 0.13, V::new(0.2, 0.7, -0.4)),
    ] {
        let strength = [0.0, if rate == 0.0 { 0.0 } else { 0.004 }, 0.015];
        let law = MagneticField::Dipole { strength, rate, orbit };
        let square = M::from(law.mean_square());
        let N = M::identity() * square.trace() - square;
        let L = V::from(law.mean_twist());
        let locked = I * N.try_inverse().unwrap() * L;
        if rate == 0.0 {
            assert!((locked / I - 1.8 * n * normal).norm() < 1e-12 * n, "{locked}");
        }
        let K = 4.0 * I * n * direction.normalize();
        let decay = N.symmetric_eigen();
        for share in [0.4, 1.5, 6.0] {
            let t = share * I / (conductor * decay.eigenvalues.min());
            let left = decay.eigenvalues.map(|value| (-conductor * value * t / I).exp());
            let turned = decay.eigenvectors * M::from_diagonal(&left) * decay.eigenvectors.transpose();
            let known = locked + turned * (K - locked);
            let drift = drift([I; 3], M::identity() * conductor, law);
            let end = ended(&drift, start(RotationState::steady(Mode::ShortAxis), K.norm(), K), t);
            let found = end.angular_momentum * V::from(end.direction);
            assert!((found - known).norm() < 1e-7 * K.norm(), "{share}: {found} {known}");
        }
        let of_time = |t: f64| field_with_rate(strength, rate, &orbit, t);
        let mut body = Turning {
            moments: [I; 3],
            tensor: parts::diag([conductor; 3]),
            fields: &of_time,
            K: K.into(),
            attitude: words(UnitQuaternion::from_scaled_axis(TURN)),
            last: None,
        };
        let duration = 8.0 * I / (conductor * decay.eigenvalues.min());
        let steps = (duration * 4.0 * n / 0.1).ceil();
        let (mut mean, mut counted) = (V::zeros(), 0.0);
        for i in 0..steps as u64 {
            body.step(i as f64 * duration / steps, duration / steps);
            if i as f64 > 0.8 * steps {
                (mean, counted) = (mean + V::from(body.K), counted + 1.0);
            }
        }
        let gap = (mean / counted - locked).norm() / locked.norm();
        println!("locked within {gap:e} of {locked}");
        // The decay takes a hundredth of the orbital rate.
        assert!(gap < 0.02, "{mean} {counted} {locked}");
    }
}

/// The same field from several forces is one with the sum of the tensors; another field, or a window, has no average here.
#[test]
fn currents_in_one_field_are_summed() {
    let force = |tensor: f64, field: MagneticField| Force {
        name: format!("of {tensor}"),
        law: ForceLaw::EddyCurrent {
            tensor: M::from_diagonal_element(tensor).into(),
            decay_time: 0.0,
            field,
        },
    };
    let uniform = MagneticField::Uniform([0.0, 0.0, 1.0]);
    let other = MagneticField::Uniform([0.0, 1.0, 0.0]);
    let sum = SlowTorque::from_forces(&[force(1.0, uniform), force(2.0, uniform)]).unwrap();
    assert_eq!(sum.eddy, Some(EddyTorque { tensor: M::from_diagonal_element(3.0).into(), field: uniform }));
    let none = [force(0.0, uniform), force(3.0, MagneticField::Uniform([0.0; 3]))];
    assert!(SlowTorque::from_forces(&none).unwrap().is_zero());
    let refused = SlowTorque::from_forces(&[force(1.0, uniform), force(2.0, other)]).unwrap_err();
    assert_eq!(refused.name, "of 2");
}
