//! Controllers against closed forms and exact recursions, about turned axes and in odd units. (Y1) to (Y5), (T4)

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use proptest::prelude::*;
use quasirigid::dynamics::{
    Forced, FullState, Options, Outcome, Sample, propagate_controlled, propagate_full,
};
use quasirigid::elements::{Assembly, Carrier, NamedController, Wheel, WheelSpeed};
use quasirigid::expression::Expression;
use quasirigid::model::control::{
    Actuator, ControlLaw, Controller, FormulaLaw, Input, LinearLaw, Measurement, Output, Pid, RelayLaw,
    Sampling,
};
use quasirigid::model::force::{Axes, Force, ForceLaw};
use quasirigid::problems::ring_of_points;
use quasirigid_math::rotation::{ALIGNED, product, turned};

use super::wobbler::times_to;
use crate::support::rotors::flywheel;
use crate::support::transform::Units;
use crate::support::{cases, rotation, units};

/// Share of the size of a motion by which numbers may differ: that of the errors of some thousand steps at the tolerance of the runs.
const CLOSE: f64 = 1e-9;

/// A rigid body that turns about one of its principal axes, in axes and units of its own.
struct Plant {
    assembly: Assembly,
    axis: Vector3<f64>,
    target: [f64; 4],
    /// Moment of inertia about the axis.
    J: f64,
    time: f64,
}

/// Angle and rate at the start, in radians and per unit of time.
const START: [f64; 2] = [0.9, -0.35];

impl Plant {
    fn new(R: &Matrix3<f64>, units: Units) -> Self {
        let unit = units.factor([2, 1, 0]);
        let J = R * Matrix3::from_diagonal(&Vector3::new(3.0, 5.0, 7.0)) * R.transpose() * unit;
        let carrier =
            Carrier { mass: units.mass, center_of_mass: [0.3 * units.length; 3], inertia: J.into() };
        Self {
            assembly: Assembly { carrier: Some(carrier), ..Assembly::default() },
            axis: R.column(1).into(),
            target: turned(ALIGNED, [0.4, -1.1, 0.7]),
            J: 5.0 * unit,
            time: units.time,
        }
    }

    /// PID on the attitude and, with a derivative, the rate, its gains in units of the inertia and the time.
    fn controller(&self, pid: &Pid, sampling: Option<Sampling>) -> NamedController {
        let errors = (0..3).map(|axis| Measurement::Attitude { target: self.target, axis });
        let rates = (0..3).map(|axis| Measurement::Rate { axis });
        let gain = |list: &[f64], power: i32| {
            list.iter().map(|gain| gain * self.J * self.time.powi(power)).collect::<Vec<_>>()
        };
        let scaled = Pid {
            proportional: gain(&pid.proportional, -2),
            integral: gain(&pid.integral, -3),
            derivative: gain(&pid.derivative, -1),
            filter: pid.filter.map(|time| self.time * time),
            ..pid.clone()
        };
        let law = scaled.law(sampling.map(|sampling| sampling.period));
        Controller {
            name: "acs".into(),
            inputs: errors.chain(rates).map(measured).collect(),
            start: vec![0.0; law.A.len()],
            law: ControlLaw::Linear(law),
            outputs: (0..3).map(|axis| Output { to: Actuator::Torque { axis }, limit: None }).collect(),
            sampling,
        }
    }

    /// Angles and rates (per unit of time) about the axis at times in units.
    fn follow(&self, times: &[f64]) -> Vec<[f64; 2]> {
        let built = self.assembly.build().unwrap();
        let system = Forced { body: &built.body, forces: &built.forces };
        let [angle, rate] = START;
        let attitude = product(self.target, turned(ALIGNED, (angle * self.axis).into()));
        let start = FullState::at_rest(&built.body, (rate / self.time * self.axis).into(), attitude);
        let times: Vec<f64> = times.iter().map(|t| self.time * t).collect();
        let mut samples: Vec<Sample> = Vec::new();
        let options = Options { tolerance: 1e-13, ..Options::default() };
        let run =
            propagate_controlled(system, &built.controls, &start, &times, &options, &mut samples).unwrap();
        assert_eq!(run.outcome, Outcome::Finished);
        // a fast filter does not shorten the steps (T4)
        assert!(run.work.steps < 10_000, "{:?}", run.work);
        let energy = self.J / self.time.powi(2);
        assert!(run.last.energy_drift.abs() < CLOSE * energy, "{:e}", run.last.energy_drift / energy);
        samples.iter().map(|sample| self.state(sample)).collect()
    }

    fn state(&self, sample: &Sample) -> [f64; 2] {
        let [s, x, y, z] = self.target;
        let [s, x, y, z] = product([s, -x, -y, -z], sample.attitude);
        let angle = 2.0 * Vector3::new(x, y, z).dot(&self.axis).atan2(s);
        let off = Vector3::from(sample.omega) - self.axis * Vector3::from(sample.omega).dot(&self.axis);
        assert!(off.norm() * self.time < CLOSE);
        [angle, Vector3::from(sample.omega).dot(&self.axis) * self.time]
    }
}

fn measured<P, C, W>(of: Measurement<P, C, W>) -> Input<P, C, W> {
    Input { of, reference: 0.0, deadband: 0.0, quantum: 0.0, noise: 0.0 }
}

fn pid(gains: [f64; 3], filter: Option<f64>) -> Pid {
    let [proportional, integral, derivative] = gains.map(|gain| vec![gain; 3]);
    Pid {
        proportional,
        integral,
        derivative,
        signs: vec![1.0; 3],
        has_rates: true,
        filter,
        anti_windup: None,
    }
}

fn assert_close(found: &[[f64; 2]], expected: impl Iterator<Item = [f64; 2]>) {
    let mut count = 0;
    for ([angle, rate], [known_angle, known_rate]) in found.iter().zip(expected) {
        assert!((angle - known_angle).abs() < CLOSE, "{count}: {angle} {known_angle}");
        assert!((rate - known_rate).abs() < CLOSE, "{count}: {rate} {known_rate}");
        count += 1;
    }
    assert_eq!(count, found.len());
}

/// Motion of a damped oscillator from [`START`].
fn oscillator(t: f64, [stiffness, damping]: [f64; 2]) -> [f64; 2] {
    let [angle, rate] = START;
    let (decay, frequency) = (0.5 * damping, (stiffness - 0.25 * damping * damping).sqrt());
    let lead = (rate + decay * angle) / frequency;
    let ((sin, cos), fall) = ((frequency * t).sin_cos(), (-decay * t).exp());
    let at = fall * (angle * cos + lead * sin);
    [at, fall * frequency * (lead * cos - angle * sin) - decay * at]
}

proptest! {
    #![proptest_config(cases(6))]

    /// `θ̈ + k_D θ̇ + k_P θ = 0`.
    #[test]
    fn proportional_and_derivative_action_is_the_second_order_equation(R in rotation(), units in units()) {
        let mut plant = Plant::new(&R, units);
        plant.assembly.controllers = vec![plant.controller(&pid([1.3, 0.0, 0.4], None), None)];
        let times = times_to(12.0, 25);
        assert_close(&plant.follow(&times), times.iter().map(|t| oscillator(*t, [1.3, 0.4])));
    }

    /// The same torque from the motor of a wheel that turns already: its reaction turns the body.
    #[test]
    fn a_wheel_turns_the_body_by_its_reaction(R in rotation(), units in units()) {
        let mut plant = Plant::new(&R, units);
        let along = plant.axis * 3.0;
        let momentum = 0.8 * plant.J / plant.time;
        let speed = WheelSpeed::Constant { angular_momentum: momentum };
        plant.assembly.wheels = vec![Wheel { name: "w".into(), axis: along.into(), speed }];
        let attitude = plant.controller(&pid([1.3, 0.0, 0.4], None), None);
        let ControlLaw::Linear(law) = attitude.law else { panic!("a PID law is linear") };
        // torque on the wheel: minus that on the body, along the axis
        let along = |rows: &[Vec<f64>]| {
            let sum = |j: usize| (0..3).map(|i| -plant.axis[i] * rows[i][j]).sum();
            vec![(0..6).map(sum).collect::<Vec<f64>>()]
        };
        let law = LinearLaw { D: along(&law.D), C: vec![Vec::new()], ..LinearLaw::default() };
        let outputs = vec![Output { to: Actuator::Wheel { wheel: "w".into() }, limit: None }];
        plant.assembly.controllers = vec![Controller { law: ControlLaw::Linear(law), outputs, ..attitude }];
        let times = times_to(12.0, 25);
        assert_close(&plant.follow(&times), times.iter().map(|t| oscillator(*t, [1.3, 0.4])));
    }

    /// With an integral and a filtered derivative, against the exponential of the matrix of angle, rate, integral and filter.
    #[test]
    fn integral_and_filter_are_the_exponential_of_their_matrix(R in rotation(), units in units()) {
        for tau in [0.2, 1e-6] {
            let mut plant = Plant::new(&R, units);
            plant.assembly.controllers = vec![plant.controller(&pid([1.3, 0.15, 0.7], Some(tau)), None)];
            let A = DMatrix::from_row_slice(4, 4, &[
                0.0, 1.0, 0.0, 0.0,
                -1.3, 0.0, -0.15, -0.7,
                1.0, 0.0, 0.0, 0.0,
                0.0, 1.0 / tau, 0.0, -1.0 / tau,
            ]);
            let start = DVector::from_column_slice(&[START[0], START[1], 0.0, 0.0]);
            let times = times_to(12.0, 13);
            let known = times.iter().map(|t| (&A * *t).exp() * &start).map(|state| [state[0], state[1]]);
            assert_close(&plant.follow(&times), known);
        }
    }

    /// Held torques of a sampled PID law with a filter, and a delay within a period, of whole periods, and of some more.
    #[test]
    fn sampled_laws_are_their_recursion(R in rotation(), units in units()) {
        let ([kp, ki, kd], tau, period) = ([1.3, 0.15, 0.7], 0.2, 0.1);
        for delay in [0.0, 0.04, 0.1, 0.23] {
            let mut plant = Plant::new(&R, units);
            let sampling = Sampling { period: period * units.time, delay: delay * units.time, seed: 0 };
            plant.assembly.controllers = vec![plant.controller(&pid([kp, ki, kd], Some(tau)), Some(sampling))];
            let times = times_to(6.0, 38);
            let (mut integral, mut filtered, mut held) = (0.0, 0.0, Vec::new());
            let keep = (-period / tau).exp();
            for sample in 0..61 {
                let t = period * f64::from(sample);
                let [angle, rate] = pushed(&held, t);
                held.push((t + delay, -(kp * angle + ki * integral + kd * filtered)));
                integral += period * angle;
                filtered = keep * filtered + (1.0 - keep) * rate;
            }
            assert_close(&plant.follow(&times), times.iter().map(|t| pushed(&held, *t)));
        }
    }
}

/// Angle and rate at a time under accelerations that hold from their times on.
fn pushed(held: &[(f64, f64)], t: f64) -> [f64; 2] {
    let acting = held.iter().filter(|(from, _)| *from < t);
    let ends = held.iter().skip(1).map(|(from, _)| *from).chain([f64::INFINITY]);
    let [angle, rate] = START;
    acting.zip(ends).fold([angle + rate * t, rate], |[angle, rate], ((from, push), to)| {
        let lasted = to.min(t) - from;
        [angle + push * lasted * (t - from - 0.5 * lasted), rate + push * lasted]
    })
}

/// A sampled law that measures the speed of a rotor with friction, not of the carrier that it turns: exact recursion by the exponential of
/// the matrix of the body over a period. The carrier has `(J − I) ω̇ = τ + cΩ`, the rotor `Ω̇ = −cΩ/I − ω̇`.
#[test]
fn a_sampled_law_on_a_rotor_is_its_recursion() {
    let R = *nalgebra::Rotation3::from_euler_angles(0.5, -0.8, 1.9).matrix();
    let mut plant = Plant::new(&R, Units { length: 1.0, mass: 1.0, time: 1.0 });
    let (J, I, c, period) = (plant.J, 0.7, 0.4, 0.25);
    plant.assembly.rotors = vec![flywheel(plant.axis.into(), I, c)];
    let rate = [[0.6, 0.2], [0.0, 0.8]];
    let from = [0.3, 0.5];
    let gains = [-0.9, 0.7];
    let along = |axis: usize| Output { to: Actuator::Torque { axis }, limit: None };
    plant.assembly.controllers = vec![Controller {
        name: "damper".into(),
        inputs: vec![measured(Measurement::Speed { coordinate: "flywheel".into() })],
        law: ControlLaw::Linear(LinearLaw {
            A: rate.map(|row| row.to_vec()).to_vec(),
            B: from.map(|entry| vec![entry]).to_vec(),
            C: (0..3).map(|i| gains.map(|gain| gain * plant.axis[i]).to_vec()).collect(),
            D: (0..3).map(|i| vec![0.2 * plant.axis[i]]).collect(),
            E: vec![Vec::new(); 2],
        }),
        outputs: (0..3).map(along).collect(),
        start: vec![0.1, -0.2],
        sampling: Some(Sampling { period, delay: 0.0, seed: 0 }),
    }];
    let found = plant.follow(&times_to(10.0, 40));
    let A = DMatrix::from_row_slice(
        4,
        4,
        &[
            0.0,
            1.0,
            0.0,
            0.0,
            0.0,
            0.0,
            c / (J - I),
            1.0 / (J - I),
            0.0,
            0.0,
            -c / I - c / (J - I),
            -1.0 / (J - I),
            0.0,
            0.0,
            0.0,
            0.0,
        ],
    );
    let over_a_period = (A * period).exp();
    let mut state = DVector::from_column_slice(&[START[0], START[1], 0.0, 0.0]);
    let mut z = [0.1, -0.2];
    let mut known = Vec::new();
    for _ in &found {
        let y = state[2];
        state[3] = gains[0] * z[0] + gains[1] * z[1] + 0.2 * y;
        z = std::array::from_fn(|i| rate[i][0] * z[0] + rate[i][1] * z[1] + from[i] * y);
        state = &over_a_period * state;
        known.push([state[0], state[1]]);
    }
    assert_close(&found, known.into_iter());
}

/// A pair of thrusters with deadband, hysteresis and least time, against a recursion of its own: in the limit cycle of single pulses the rate
/// is `±M t_on/2J`, and a pulse every `t_on + 2θ/Ω`.
#[test]
fn thrusters_end_in_a_limit_cycle_of_single_pulses() {
    let R = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    let mut plant = Plant::new(&R, Units { length: 1.0, mass: 1.0, time: 1.0 });
    let (on, off, lead, period, least) = (1.1, 0.95, 0.4, 0.25, 2);
    let cycle_rate = START[1].abs();
    let push = 2.0 * cycle_rate / (period * f64::from(least));
    let law = RelayLaw { levels: vec![push * plant.J], lead, on: vec![on], off: vec![off], least };
    let attitude = Measurement::Attitude { target: plant.target, axis: 2 };
    plant.assembly.controllers = vec![Controller {
        name: "jets".into(),
        inputs: [attitude, Measurement::Rate { axis: 2 }].map(measured).to_vec(),
        law: ControlLaw::Relay(law),
        outputs: vec![Output { to: Actuator::Torque { axis: 2 }, limit: None }],
        start: vec![0.0; 2],
        sampling: Some(Sampling { period, delay: 0.0, seed: 0 }),
    }];
    let times = times_to(60.0, 481);
    let found = plant.follow(&times);
    let (mut held, mut fires, mut since, mut pulses) = (Vec::new(), 0.0, 0, Vec::new());
    for sample in 0..240 {
        let t = period * f64::from(sample);
        let [angle, rate] = pushed(&held, t);
        let error = angle + lead * rate;
        since += 1;
        if fires == 0.0 && error.abs() > on {
            (fires, since) = (-error.signum(), 0);
            pulses.push((t, angle.abs()));
        } else if fires != 0.0 && since >= least && -fires * error <= off {
            fires = 0.0;
        }
        held.push((t, push * fires));
    }
    assert_close(&found, times.iter().map(|t| pushed(&held, *t)));
    assert!(pulses.len() >= 8, "{pulses:?}");
    for pair in pulses.windows(2) {
        let [(before, from), (now, to)] = [pair[0], pair[1]];
        let expected = period * f64::from(least) + (from + to) / cycle_rate;
        assert!((now - before - expected).abs() < CLOSE, "{pulses:?}");
    }
    let coasting = found.iter().filter(|[_, rate]| (rate.abs() - cycle_rate).abs() < CLOSE).count();
    assert!(coasting > found.len() * 4 / 5, "{coasting}");
}

/// A law without states by formulas of rates, attitude and time is the force with these formulas, on a flexible body.
#[test]
fn a_law_without_states_is_a_torque_by_formulas() {
    let texts = ["-0.02*wx + 0.01*qy", "0.03*sin(0.7*t) - 0.01*wy*abs(wy)", "-0.02*wz + 0.005*qw*qz"];
    let mut assembly = ring_of_points(3);
    let names = ["x", "y", "z", "vx", "vy", "vz", "t", "wx", "wy", "wz", "qw", "qx", "qy", "qz"];
    let torque = texts.map(|text| Expression::parse(text, &names).unwrap());
    let law = ForceLaw::TorqueExpression { torque, axes: Axes::Body };
    assembly.forces = vec![Force { name: "law".into(), law }];
    let inputs = (0..3).map(|axis| Measurement::Rate { axis });
    let inputs = [Measurement::Time].into_iter().chain(inputs);
    let inputs = inputs.chain((0..4).map(|component| Measurement::Quaternion { component }));
    let torque = texts.map(|text| Expression::parse(text, &names[6..]).unwrap());
    let controller = Controller {
        name: "law".into(),
        inputs: inputs.map(measured).collect(),
        law: ControlLaw::Formulas(FormulaLaw { states: Vec::new(), outputs: torque.to_vec() }),
        outputs: (0..3).map(|axis| Output { to: Actuator::Torque { axis }, limit: None }).collect(),
        start: Vec::new(),
        sampling: None,
    };
    let controlled = Assembly { forces: Vec::new(), controllers: vec![controller], ..assembly.clone() };
    let (times, options) = (times_to(20.0, 21), Options { tolerance: 1e-12, ..Options::default() });
    let [forced, controlled] = [assembly, controlled].map(|assembly| {
        let built = assembly.build().unwrap();
        let system = Forced { body: &built.body, forces: &built.forces };
        let start = FullState::at_rest(&built.body, [0.1, -0.3, 0.5], turned(ALIGNED, [0.3, 0.1, -0.9]));
        let mut samples: Vec<Sample> = Vec::new();
        let run = if built.controls.is_empty() {
            propagate_full(system, &start, &times, &options, &mut samples)
        } else {
            propagate_controlled(system, &built.controls, &start, &times, &options, &mut samples)
        };
        assert_eq!(run.unwrap().outcome, Outcome::Finished);
        samples
    });
    for (a, b) in forced.iter().zip(&controlled) {
        let gap = (Vector3::from(a.omega) - Vector3::from(b.omega)).norm();
        assert!(gap < 1e-9, "{}: {gap:e}", a.t);
        assert!((a.work - b.work).abs() < 1e-9 && (a.energy - b.energy).abs() < 1e-9);
    }
    assert!((forced[20].energy - forced[0].energy).abs() > 1e-2);
}
