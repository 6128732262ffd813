//! Random external forces, one of every law, and random situations of a body, in any units and any inertial axes.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use proptest::array::{uniform2, uniform3, uniform4, uniform7};
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid::elements::{ApplicationPoint, Assembly, End};
use quasirigid::model::force::{Axes, Force, ForceLaw, KinematicState, MagneticField, Orbit, Wave};
use quasirigid::model::{FlexibleBody, Marker, MotionState};
use quasirigid_math::expression::Expression;

use crate::support::transform::Units;
use crate::support::{direction, vector};

type V = Vector3<f64>;

/// Base units.
pub const BASE: Units = Units { length: 1.0, mass: 1.0, time: 1.0 };

/// A body somewhere in space, on the move.
#[derive(Clone, Debug)]
pub struct State {
    pub t: f64,
    pub attitude: [f64; 4],
    pub pole: [f64; 3],
    pub velocity: [f64; 3],
    pub omega: [f64; 3],
    pub q: Vec<f64>,
    pub rate: Vec<f64>,
}

/// Numbers of a state: time, attitude, pole, velocity, spin, coordinates and rates.
pub type Loose = (f64, [f64; 4], [[f64; 3]; 3], Vec<f64>);

pub fn states() -> impl Strategy<Value = Loose> {
    let attitude = uniform4(-1.0..1.0)
        .prop_filter("an attitude", |q: &[f64; 4]| q.iter().map(|x| x * x).sum::<f64>() > 0.1);
    (-3.0..3.0, attitude, uniform3(vector()), vec(-1.0..1.0, 48))
}

impl State {
    /// State of a body, with its displacements times `amount`.
    pub fn of(
        body: &FlexibleBody,
        (t, attitude, [pole, velocity, omega], numbers): &Loose,
        amount: f64,
    ) -> Self {
        let n = body.coordinates().len();
        let norm = attitude.iter().map(|x| x * x).sum::<f64>().sqrt();
        Self {
            t: *t,
            attitude: attitude.map(|x| x / norm),
            pole: *pole,
            velocity: *velocity,
            omega: *omega,
            q: numbers[..n].iter().map(|x| amount * x).collect(),
            rate: numbers[24..24 + n].to_vec(),
        }
    }

    pub fn kinematics(&self) -> KinematicState<'_, f64> {
        KinematicState {
            t: self.t,
            attitude: self.attitude,
            pole: self.pole,
            pole_velocity: self.velocity,
            motion: MotionState { omega: self.omega, q: &self.q, rate: &self.rate },
        }
    }

    /// `R_NB`.
    pub fn turn(&self) -> Matrix3<f64> {
        let [s, x, y, z] = self.attitude;
        *UnitQuaternion::new_normalize(nalgebra::Quaternion::new(s, x, y, z)).to_rotation_matrix().matrix()
    }

    /// State a moment later by its own rates, to first order.
    pub fn after(&self, dt: f64) -> Self {
        let spin = UnitQuaternion::from_scaled_axis(dt * V::from(self.omega));
        let [s, x, y, z] = self.attitude;
        let turned = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(s, x, y, z)) * spin;
        let mut after = self.clone();
        after.attitude = [turned.w, turned.i, turned.j, turned.k];
        after.pole = (V::from(self.pole) + dt * V::from(self.velocity)).into();
        after.q.iter_mut().zip(&self.rate).for_each(|(q, rate)| *q += dt * rate);
        after
    }

    /// Place of the body in inertial axes.
    pub fn place(&self, at: &Marker) -> V {
        let moved: V = at.shapes.iter().map(|(j, H)| self.q[*j] * V::from(*H)).sum();
        V::from(self.pole) + self.turn() * (V::from(at.position) + moved)
    }

    /// Velocity of the place: sixth-order differences that err by 1e-15.
    pub fn velocity(&self, at: &Marker) -> V {
        let h = 2e-3;
        let odd = |i: f64| self.after(i * h).place(at) - self.after(-i * h).place(at);
        (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * h)
    }

    /// State seen from rotated inertial axes, in which every vector `v` is `R v`.
    pub fn seen_from(&self, R: &Matrix3<f64>) -> Self {
        let attitude = UnitQuaternion::from_matrix(&(R * self.turn()));
        let mut seen = self.clone();
        seen.attitude = [attitude.w, attitude.i, attitude.j, attitude.k];
        seen.pole = (R * V::from(self.pole)).into();
        seen.velocity = (R * V::from(self.velocity)).into();
        seen
    }

    /// State in other units.
    pub fn rescaled(&self, body: &FlexibleBody, units: Units) -> Self {
        let lengths = body.coordinates().iter().map(|c| if c.unit == "m" { units.length } else { 1.0 });
        let lengths: Vec<f64> = lengths.collect();
        let times = |x: &[f64], time: f64| x.iter().zip(&lengths).map(|(x, l)| x * l * time).collect();
        Self {
            t: units.time * self.t,
            attitude: self.attitude,
            pole: self.pole.map(|x| units.length * x),
            velocity: self.velocity.map(|x| units.factor([1, 0, -1]) * x),
            omega: self.omega.map(|x| x / units.time),
            q: times(&self.q, 1.0),
            rate: times(&self.rate, 1.0 / units.time),
        }
    }
}

/// Numbers in one force of every law, in base units.
#[derive(Clone, Debug)]
pub struct Numbers {
    vectors: [[f64; 3]; 7],
    pub orbit: Orbit,
    wave: [f64; 2],
    coefficients: [f64; 4],
    axes: [bool; 2],
}

pub fn numbers() -> impl Strategy<Value = Numbers> {
    let wave = uniform2(-3.0..3.0);
    let axes = uniform2(any::<bool>());
    (uniform7(direction()), orbit(), wave, uniform4(0.1..2.0), axes).prop_map(
        |(vectors, orbit, wave, coefficients, axes)| Numbers { vectors, orbit, wave, coefficients, axes },
    )
}

/// An orbit as large as the body, so that nothing about it is negligible.
pub fn orbit() -> impl Strategy<Value = Orbit> {
    (0.0..0.95, uniform7(0.2..3.0)).prop_map(|(eccentricity, x)| Orbit {
        mu: x[0],
        semi_major_axis: x[1] + 1.0,
        eccentricity,
        inclination: x[2],
        raan: 2.0 * x[3],
        argument_of_periapsis: 2.0 * x[4],
        mean_anomaly: 2.0 * x[5],
        node_rate: 0.0,
        periapsis_rate: 0.0,
    })
}

impl Numbers {
    /// Forces in other units and seen from inertial axes in which every vector `v` is `R v`.
    pub fn forces(&self, units: Units, R: &Matrix3<f64>) -> Vec<Force<ApplicationPoint>> {
        let [g, on_carrier, torque, thrust, moment, field, dipole] = self.vectors;
        let [k, spin, drag, pull] = self.coefficients;
        let times = |v: [f64; 3], factor: f64| v.map(|x| factor * x);
        let turned = |v: [f64; 3]| -> [f64; 3] { (R * V::from(v)).into() };
        let fixed =
            |v: [f64; 3], body: bool| if body { (v, Axes::Body) } else { (turned(v), Axes::Inertial) };
        let carrier = ApplicationPoint { on: End::Carrier, at: Some(times(on_carrier, units.length)) };
        let point = ApplicationPoint { on: End::Point(0), at: None };
        let (torque, torque_axes) = fixed(torque, self.axes[0]);
        let (thrust, thrust_axes) = fixed(thrust, self.axes[1]);
        let orbit = seen_from(self.orbit, R, units);
        let [frequency, phase] = self.wave;
        let wave = Wave { frequency: frequency / units.time, phase };
        let newton = units.factor([1, 1, -2]);
        let drag_unit = units.factor([0, 1, -1]);
        let uniform = MagneticField::Uniform(times(turned(field), units.length * newton));
        let strength = times(turned(dipole), units.length.powi(4) * newton);
        let conducting = spin * units.factor([2, 1, -1]) / (units.length * newton).powi(2);
        let tensor =
            (conducting * (Matrix3::identity() + V::from(moment) * V::from(moment).transpose())).into();
        let central = ["x", "y", "z"].map(|axis| {
            let (k, c) = (k * units.factor([-1, 1, -2]), pull * drag_unit);
            formula(&format!("-{k:e} * {axis} * sqrt(x^2 + y^2 + z^2) - {c:e} * v{axis}"))
        });
        let laws = [
            ForceLaw::UniformGravity { acceleration: times(turned(g), units.factor([1, 0, -2])) },
            ForceLaw::CentralGravity { orbit: orbit.into() },
            ForceLaw::Drag { at: carrier, coefficient: drag * drag_unit },
            ForceLaw::Drag { at: point, coefficient: drag * drag_unit },
            ForceLaw::SpinDrag { coefficient: spin * units.factor([2, 1, -1]) },
            ForceLaw::Torque { torque: times(torque, units.length * newton), axes: torque_axes, wave },
            ForceLaw::Thrust { at: carrier, force: times(thrust, newton), axes: thrust_axes, wave },
            ForceLaw::Thrust { at: point, force: times(thrust, newton), axes: thrust_axes, wave },
            ForceLaw::MagneticDipole { moment, field: uniform },
            ForceLaw::MagneticDipole { moment, field: MagneticField::Dipole { strength, rate: 0.0, orbit } },
            ForceLaw::EddyCurrent { tensor, decay_time: 0.0, field: uniform },
            ForceLaw::EddyCurrent {
                tensor,
                decay_time: 0.0,
                field: MagneticField::Dipole { strength, rate: 0.0, orbit },
            },
            ForceLaw::Expression { at: carrier, force: central.clone() },
            ForceLaw::Expression { at: point, force: central },
        ];
        laws.into_iter().map(|law| Force { name: "force".into(), law }).collect()
    }
}

/// A formula of place, velocity and time.
pub fn formula(text: &str) -> Expression {
    let names = ["x", "y", "z", "vx", "vy", "vz", "t", "wx", "wy", "wz", "qw", "qx", "qy", "qz"];
    Expression::parse(text, &names).unwrap()
}

/// The body with these forces.
pub fn forced(assembly: &Assembly, forces: Vec<Force<ApplicationPoint>>) -> Assembly {
    Assembly { forces, ..assembly.clone() }
}

/// Orbit whose plane and periapsis are rotated, in other units. The elements are read off the rotated axes.
fn seen_from(orbit: Orbit, R: &Matrix3<f64>, units: Units) -> Orbit {
    let about = |axis: V, angle: f64| *Rotation3::new(angle * axis).matrix();
    let axes = R
        * about(V::z(), orbit.raan)
        * about(V::x(), orbit.inclination)
        * about(V::z(), orbit.argument_of_periapsis);
    let (P, Q, W) = (axes.column(0), axes.column(1), axes.column(2));
    Orbit {
        mu: orbit.mu * units.factor([3, 0, -2]),
        semi_major_axis: orbit.semi_major_axis * units.length,
        inclination: W[0].hypot(W[1]).atan2(W[2]),
        raan: W[0].atan2(-W[1]),
        argument_of_periapsis: P[2].atan2(Q[2]),
        ..orbit
    }
}
