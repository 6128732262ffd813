//! Controllers in a magnetic field, against closed forms and an integration written here, about turned axes and in odd units. (Y8), (Y9)
//!
//! The numbers of the tests are of order one; the body that is followed has them in units and axes of its own.

use std::collections::VecDeque;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use proptest::prelude::*;
use quasirigid::dynamics::{Forced, FullState, Options, Outcome, Sample, propagate_controlled};
use quasirigid::elements::{Assembly, Carrier, NamedController};
use quasirigid::expression::Expression;
use quasirigid::model::control::{
    Actuator, ControlLaw, Controller, FormulaLaw, Input, LinearLaw, Measurement, Output, RelayLaw, Sampling,
};
use quasirigid::model::force::{Force, ForceLaw, MagneticField, Orbit};

use crate::support::transform::Units;
use crate::support::{cases, rotation, units};

type V = Vector3<f64>;
type M = Matrix3<f64>;
type Measured = Measurement<String, String, String>;

/// Share of the size of a motion by which numbers may differ: errors of some thousand steps of either integration.
const CLOSE: f64 = 1e-9;
/// The same where a law has corners, which the fixed steps here do not know: the square of a step.
const CLOSE_AT_CORNERS: f64 = 1e-6;
/// Step of the integration here.
const STEP: f64 = 1e-3;

const MOMENTS: [f64; 3] = [3.0, 5.0, 7.0];
const FIELD: V = V::new(0.5, -0.8, 0.6);
const OMEGA: V = V::new(0.9, -0.5, 0.7);
const PLAIN: Units = Units { length: 1.0, mass: 1.0, time: 1.0 };

fn attitude() -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(V::new(0.4, -1.1, 0.7))
}

/// Times from zero to an end, at even intervals.
fn from_start(end: f64, intervals: u32) -> Vec<f64> {
    (0..=intervals).map(|i| end * f64::from(i) / f64::from(intervals)).collect()
}

/// Axes of the followed body that are axes of the test in another order, one of them reversed.
fn permuted() -> M {
    M::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
}

/// Motion: attitude, angular velocity in body axes, place and velocity on an orbit.
#[derive(Clone, Copy, Debug)]
struct State {
    attitude: Quaternion<f64>,
    omega: V,
    place: V,
    velocity: V,
}

impl State {
    fn start() -> Self {
        Self { attitude: attitude().into_inner(), omega: OMEGA, place: V::zeros(), velocity: V::zeros() }
    }

    fn plus(&self, rate: &Self, h: f64) -> Self {
        Self {
            attitude: self.attitude + rate.attitude * h,
            omega: self.omega + rate.omega * h,
            place: self.place + rate.place * h,
            velocity: self.velocity + rate.velocity * h,
        }
    }
}

/// Rigid body in a field, by the classical method of Runge and Kutta.
struct Body {
    J: M,
    field: Source,
}

/// Field in inertial axes.
enum Source {
    Uniform(V),
    /// A dipole that turns about z at a rate, about whose centre the body moves with the gravitational parameter one.
    Dipole(V, f64),
}

impl Body {
    /// Field and its rate in inertial axes.
    fn fields(&self, t: f64, state: &State) -> [V; 2] {
        match self.field {
            Source::Uniform(field) => [field, V::zeros()],
            Source::Dipole(start, rate) => {
                let m = nalgebra::Rotation3::from_axis_angle(&V::z_axis(), rate * t) * start;
                let (turning, R, v) = (rate * V::z().cross(&m), state.place, state.velocity);
                let (r, along) = (R.norm(), m.dot(&R));
                let field = 3.0 * along * R / r.powi(5) - m / r.powi(3);
                let moved = 3.0 * (m.dot(&v) * R + along * v + R.dot(&v) * m) / r.powi(5)
                    - 15.0 * along * R.dot(&v) * R / r.powi(7);
                [field, moved + 3.0 * turning.dot(&R) * R / r.powi(5) - turning / r.powi(3)]
            }
        }
    }

    /// Field and its rate as the body sees them.
    fn sensed(&self, t: f64, state: &State) -> [V; 2] {
        let back = UnitQuaternion::new_normalize(state.attitude).inverse();
        let [field, change] = self.fields(t, state).map(|vector| back * vector);
        [field, change - state.omega.cross(&field)]
    }

    fn rate(&self, t: f64, state: &State, moment: &dyn Fn([V; 2]) -> V) -> State {
        let sensed = self.sensed(t, state);
        let torque = moment(sensed).cross(&sensed[0]);
        let gyroscopic = (self.J * state.omega).cross(&state.omega);
        let r = state.place.norm();
        State {
            attitude: state.attitude * Quaternion::from_imag(0.5 * state.omega),
            omega: self.J.try_inverse().unwrap() * (gyroscopic + torque),
            place: state.velocity,
            velocity: if r > 0.0 { -state.place / r.powi(3) } else { V::zeros() },
        }
    }

    fn follow(&self, mut state: State, [from, to]: [f64; 2], moment: &dyn Fn([V; 2]) -> V) -> State {
        let steps = ((to - from) / STEP).ceil().max(1.0);
        let h = (to - from) / steps;
        for step in 0..steps as usize {
            let t = from + h * step as f64;
            let k1 = self.rate(t, &state, moment);
            let k2 = self.rate(t + 0.5 * h, &state.plus(&k1, 0.5 * h), moment);
            let k3 = self.rate(t + 0.5 * h, &state.plus(&k2, 0.5 * h), moment);
            let k4 = self.rate(t + h, &state.plus(&k3, h), moment);
            for (rate, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                state = state.plus(&rate, weight * h / 6.0);
            }
        }
        state
    }

    /// Motion at times under a continuous law.
    fn continuous(&self, mut state: State, times: &[f64], moment: &dyn Fn([V; 2]) -> V) -> Vec<State> {
        let mut from = 0.0;
        let mut reach = |t: f64| {
            if t > from {
                state = self.follow(state, [from, t], moment);
                from = t;
            }
            state
        };
        times.iter().map(|t| reach(*t)).collect()
    }

    /// Motion at the samples of a law of a period and a delay.
    fn sampled(
        &self,
        mut state: State,
        samples: usize,
        [period, delay]: [f64; 2],
        law: &dyn Fn([V; 2]) -> V,
    ) -> Vec<State> {
        let (mut held, mut waiting, mut found) = (V::zeros(), VecDeque::new(), Vec::new());
        for sample in 0..samples {
            found.push(state);
            let (mut t, next) = (period * sample as f64, period * (sample + 1) as f64);
            waiting.push_back((t + delay, law(self.sensed(t, &state))));
            while waiting.front().is_some_and(|(time, _)| *time < next - 1e-9) {
                let (time, moment) = waiting.pop_front().unwrap();
                if time > t + 1e-9 {
                    state = self.follow(state, [t, time], &|_| held);
                    t = time;
                }
                held = moment;
            }
            state = self.follow(state, [t, next], &|_| held);
        }
        found
    }
}

/// The body that is followed: in units, and in body axes turned by a rotation.
struct Plant {
    R: M,
    units: Units,
    assembly: Assembly,
}

impl Plant {
    fn new(J: M, R: &M, units: Units) -> Self {
        let inertia = R * J * R.transpose() * units.factor([2, 1, 0]);
        let carrier =
            Carrier { mass: units.mass, center_of_mass: [0.3 * units.length; 3], inertia: inertia.into() };
        let uniform = MagneticField::Uniform((FIELD * units.factor([0, 1, -2])).into());
        let assembly =
            Assembly { carrier: Some(carrier), magnetic_field: Some(uniform), ..Assembly::default() };
        Self { R: *R, units, assembly }
    }

    /// `m = −k Ḃ`, its gain and limit in the units of the test.
    fn b_dot(&self, gain: f64, limit: Option<f64>, sampling: Option<[f64; 2]>) -> NamedController {
        let k = gain * self.units.factor([2, -1, 3]);
        let row = |i: usize| (0..3).map(|j| if i == j { -k } else { 0.0 }).collect();
        let law = LinearLaw { C: vec![Vec::new(); 3], D: (0..3).map(row).collect(), ..LinearLaw::default() };
        self.coils(ControlLaw::Linear(law), 3, limit, sampling)
    }

    /// Law from the rates of the field to the moments of coils.
    fn coils(
        &self,
        law: ControlLaw,
        inputs: usize,
        limit: Option<f64>,
        sampling: Option<[f64; 2]>,
    ) -> NamedController {
        let limit = limit.map(|limit| limit * self.units.factor([2, 0, 0]));
        let sampling = sampling.map(|[period, delay]| Sampling {
            period: period * self.units.time,
            delay: delay * self.units.time,
            seed: 0,
        });
        Controller {
            name: "coils".into(),
            inputs: (0..inputs).map(|i| input(Measurement::FieldRate { axis: i % 3 })).collect(),
            start: vec![0.0; law.states()],
            law,
            outputs: (0..3).map(|axis| Output { to: Actuator::Moment { axis }, limit }).collect(),
            sampling,
        }
    }

    fn samples(&self, times: &[f64]) -> Vec<Sample> {
        let built = self.assembly.build().unwrap();
        let system = Forced { body: &built.body, forces: &built.forces };
        let turned = attitude() * UnitQuaternion::from_matrix(&self.R).inverse();
        let [x, y, z, w] = turned.into_inner().coords.into();
        let omega = self.R * OMEGA / self.units.time;
        let start = FullState::at_rest(&built.body, omega.into(), [w, x, y, z]);
        let times: Vec<f64> = times.iter().map(|t| self.units.time * t).collect();
        let mut samples: Vec<Sample> = Vec::new();
        let options = Options { tolerance: 1e-13, ..Options::default() };
        let run =
            propagate_controlled(system, &built.controls, &start, &times, &options, &mut samples).unwrap();
        assert_eq!(run.outcome, Outcome::Finished);
        let energy = self.units.factor([2, 1, -2]);
        let drift = run.last.energy_drift / energy;
        assert!(drift.abs() < CLOSE, "{drift:e}");
        samples
    }

    /// Angular velocities in body axes and units of the test.
    fn follow(&self, times: &[f64]) -> Vec<V> {
        self.rates(&self.samples(times))
    }

    fn rates(&self, samples: &[Sample]) -> Vec<V> {
        let omega = |sample: &Sample| self.R.transpose() * V::from(sample.omega) * self.units.time;
        samples.iter().map(omega).collect()
    }
}

fn input(of: Measured) -> Input<String, String, String> {
    Input { of, reference: 0.0, deadband: 0.0, quantum: 0.0, noise: 0.0 }
}

fn assert_close(found: &[V], expected: &[State], close: f64) {
    assert_eq!(found.len(), expected.len());
    for (i, (found, known)) in found.iter().zip(expected).enumerate() {
        let gap = (found - known.omega).norm();
        assert!(gap < close, "{i}: {found} {} {gap:e}", known.omega);
    }
}

proptest! {
    #![proptest_config(cases(6))]

    /// The torque on a ball is `−kB²` times the angular velocity across the field: that falls as `e^{−kB²t/J}`, and that along it stays.
    #[test]
    fn a_ball_loses_the_spin_across_the_field_alone(R in rotation(), units in units()) {
        let (J, gain) = (4.0, 1.7);
        let mut plant = Plant::new(M::from_diagonal_element(J), &R, units);
        plant.assembly.controllers = vec![plant.b_dot(gain, None, None)];
        let times = from_start(12.0, 24);
        let start = attitude() * OMEGA;
        let along = FIELD * (FIELD.dot(&start) / FIELD.norm_squared());
        for (t, sample) in times.iter().zip(plant.samples(&times)) {
            let [w, x, y, z] = sample.attitude;
            let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
            let found = turn * V::from(sample.omega) * units.time;
            let known = along + (start - along) * (-gain * FIELD.norm_squared() / J * t).exp();
            prop_assert!((found - known).norm() < CLOSE, "{t}: {found} {known}");
        }
    }

    /// Any body, and the law of its energy, `dE/dt = −k |Ḃ|²`.
    #[test]
    fn energy_falls_by_the_gain_and_the_square_of_the_rate(R in rotation(), units in units()) {
        let gain = 1.7;
        let body = Body { J: M::from_diagonal(&MOMENTS.into()), field: Source::Uniform(FIELD) };
        let mut plant = Plant::new(body.J, &R, units);
        plant.assembly.controllers = vec![plant.b_dot(gain, None, None)];
        let duration = 8.0;
        let times = from_start(duration, 4000);
        let expected = body.continuous(State::start(), &times, &|[_, rate]| -gain * rate);
        let samples = plant.samples(&times);
        assert_close(&plant.rates(&samples), &expected, CLOSE);
        let lost = |sample: &Sample| {
            let [w, x, y, z] = sample.attitude;
            let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
            let omega = turn * V::from(sample.omega) * units.time;
            gain * omega.cross(&FIELD).norm_squared()
        };
        // by Simpson's rule
        let last = samples.len() - 1;
        let weight = |i: usize| if i == 0 || i == last { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
        let h = duration / last as f64;
        let sum: f64 = samples.iter().enumerate().map(|(i, sample)| weight(i) * lost(sample)).sum();
        let unit = units.factor([2, 1, -2]);
        let gone = (samples[0].energy - samples[last].energy) / unit;
        prop_assert!((gone - h / 3.0 * sum).abs() < CLOSE, "{gone} {}", h / 3.0 * sum);
        prop_assert!(gone > 0.5, "{gone}");
    }
}

/// Moments at their limit, on each axis alone.
#[test]
fn saturated_coils_brake_by_their_limit() {
    let (gain, limit) = (4.0, 0.9);
    let body = Body { J: M::from_diagonal(&MOMENTS.into()), field: Source::Uniform(FIELD) };
    for units in [PLAIN, Units { length: 3e-4, mass: 2e3, time: 70.0 }] {
        let mut plant = Plant::new(body.J, &permuted(), units);
        plant.assembly.controllers = vec![plant.b_dot(gain, Some(limit), None)];
        let times = from_start(12.0, 12);
        let law = |[_, rate]: [V; 2]| rate.map(|rate| (-gain * rate).clamp(-limit, limit));
        let expected = body.continuous(State::start(), &times, &law);
        assert_close(&plant.follow(&times), &expected, CLOSE_AT_CORNERS);
    }
}

/// Held moments, at and below their limit, of rates that are rounded, with a delay within a period, of whole periods, and of some more.
#[test]
fn sampled_coils_hold_their_moments() {
    let (gain, limit, quantum, period) = (4.0, 0.9, 0.03, 0.2);
    let body = Body { J: M::from_diagonal(&MOMENTS.into()), field: Source::Uniform(FIELD) };
    for (delay, quantum) in [(0.0, 0.0), (0.07, quantum), (0.2, quantum), (0.53, 0.0)] {
        for units in [PLAIN, Units { length: 3e-4, mass: 2e3, time: 70.0 }] {
            let mut plant = Plant::new(body.J, &permuted(), units);
            let mut controller = plant.b_dot(gain, Some(limit), Some([period, delay]));
            controller.inputs.iter_mut().for_each(|input| input.quantum = quantum * units.factor([0, 1, -3]));
            plant.assembly.controllers = vec![controller];
            let law = |[_, rate]: [V; 2]| {
                let seen =
                    rate.map(|rate| if quantum > 0.0 { quantum * (rate / quantum).round() } else { rate });
                seen.map(|rate| (-gain * rate).clamp(-limit, limit))
            };
            let expected = body.sampled(State::start(), 61, [period, delay], &law);
            assert_close(&plant.follow(&from_start(12.0, 60)), &expected, CLOSE);
        }
    }
}

/// Moments of one size by the sign of the rate at samples.
#[test]
fn bang_bang_coils_switch_by_the_sign_of_the_rate() {
    let (moment, period) = (0.8, 0.2);
    let body = Body { J: M::from_diagonal(&MOMENTS.into()), field: Source::Uniform(FIELD) };
    let mut plant = Plant::new(body.J, &permuted(), PLAIN);
    let law = RelayLaw { levels: vec![moment; 3], lead: 0.0, on: vec![0.0; 3], off: vec![0.0; 3], least: 1 };
    plant.assembly.controllers =
        vec![plant.coils(ControlLaw::Relay(law), 6, Some(moment), Some([period, 0.0]))];
    let law = |[_, rate]: [V; 2]| rate.map(|rate| -moment * rate.signum());
    let expected = body.sampled(State::start(), 61, [period, 0.0], &law);
    assert_close(&plant.follow(&from_start(12.0, 60)), &expected, CLOSE);
    assert!(expected[60].omega.norm() < 0.7 * OMEGA.norm(), "{}", expected[60].omega);
}

/// On an eccentric orbit through the field of a dipole that turns, which gives the body work at last: a body that hangs still is turned.
#[test]
fn coils_act_in_the_field_of_a_dipole_along_an_orbit() {
    let orbit = Orbit {
        mu: 1.0,
        semi_major_axis: 1.0,
        eccentricity: 0.2,
        inclination: 1.1,
        raan: 0.4,
        argument_of_periapsis: -0.7,
        mean_anomaly: 2.0,
        node_rate: 0.0,
        periapsis_rate: 0.0,
    };
    let (strength, rate, gain) = (V::new(0.2, -0.3, 0.9), 0.6, 1.3);
    let body = Body { J: M::from_diagonal(&MOMENTS.into()), field: Source::Dipole(strength, rate) };
    let passage = orbit.at(0.0);
    let start = State { place: passage.place.into(), velocity: passage.velocity.into(), ..State::start() };
    let mut plant = Plant::new(body.J, &permuted(), PLAIN);
    plant.assembly.magnetic_field = Some(MagneticField::Dipole { strength: strength.into(), rate, orbit });
    let times = from_start(10.0, 10);
    plant.assembly.controllers = vec![plant.b_dot(gain, None, None)];
    let expected = body.continuous(start, &times, &|[_, rate]| -gain * rate);
    assert_close(&plant.follow(&times), &expected, CLOSE);
    plant.assembly.controllers = vec![plant.b_dot(gain, None, Some([0.25, 0.1]))];
    let expected = body.sampled(start, 41, [0.25, 0.1], &|[_, rate]| -gain * rate);
    assert_close(&plant.follow(&from_start(10.0, 40)), &expected, CLOSE);
}

/// A moment by formulas is that of a magnet, `m × B`; and a torque by the field that is sensed is, too.
#[test]
fn moments_and_sensed_fields_are_those_of_a_magnet() {
    let units = Units { length: 0.2, mass: 30.0, time: 5.0 };
    let moment = V::new(0.7, -0.4, 1.1) * units.factor([2, 0, 0]);
    let mut plant = Plant::new(M::from_diagonal(&MOMENTS.into()), &permuted(), units);
    let times = from_start(10.0, 10);
    let field = plant.assembly.magnetic_field.unwrap();
    let law = ForceLaw::MagneticDipole { moment: moment.into(), field };
    plant.assembly.forces = vec![Force { name: "magnet".into(), law }];
    let expected: Vec<State> =
        plant.follow(&times).into_iter().map(|omega| State { omega, ..State::start() }).collect();
    plant.assembly.forces.clear();
    let outputs = |to: fn(usize) -> Actuator<String>| {
        (0..3).map(|axis| Output { to: to(axis), limit: None }).collect::<Vec<_>>()
    };
    let constant = |value: f64| Expression::parse(&format!("{value:?}"), &[]).unwrap();
    let formulas =
        FormulaLaw { states: Vec::new(), outputs: moment.iter().map(|part| constant(*part)).collect() };
    let coil = Controller {
        name: "coil".into(),
        inputs: Vec::new(),
        law: ControlLaw::Formulas(formulas),
        outputs: outputs(|axis| Actuator::Moment { axis }),
        start: Vec::new(),
        sampling: None,
    };
    let cross = moment.cross_matrix();
    let D = cross.row_iter().map(|row| row.iter().copied().collect()).collect();
    let by_field = Controller {
        inputs: (0..3).map(|axis| input(Measurement::Field { axis })).collect(),
        law: ControlLaw::Linear(LinearLaw { C: vec![Vec::new(); 3], D, ..LinearLaw::default() }),
        outputs: outputs(|axis| Actuator::Torque { axis }),
        ..coil.clone()
    };
    for controller in [coil, by_field] {
        plant.assembly.controllers = vec![controller];
        assert_close(&plant.follow(&times), &expected, CLOSE);
    }
}

/// A controller in a field needs one, by its own problem, and the field has to be one.
#[test]
fn a_controller_without_a_field_is_refused() {
    let mut plant = Plant::new(M::identity(), &M::identity(), PLAIN);
    plant.assembly.controllers = vec![plant.b_dot(1.0, None, None)];
    plant.assembly.magnetic_field = None;
    for errors in [plant.assembly.check(), vec![plant.assembly.build().unwrap_err()]] {
        assert!(errors[0].to_string().contains("it needs a magnetic field"), "{errors:?}");
    }
    plant.assembly.magnetic_field = Some(MagneticField::Uniform([0.0, f64::NAN, 0.0]));
    assert_eq!(plant.assembly.check().len(), 1);
    assert!(plant.assembly.build().is_err());
}
