//! Controllers on a body: measurements of a state, and commands to the carrier, to the motors of wheels and to coils. (Y2) to (Y4), (Y8)

use super::noise::normal;
use super::{Actuator, ControlState, Controller, HysteresisRod, Input, Sampling, SensedField, SensedOrbit};
use crate::Marker;
use crate::force::{MagneticField, SunPath, Trajectory};
use crate::math::rotation::Turn;
use crate::math::vec3::{add, scale};

/// Controller on a body: places as markers, internal coordinates and wheels of [`Controls`] by index.
pub type BodyController = Controller<Marker, usize, usize>;

/// Controllers of a body, with the wheels that they measure or command, and hysteresis rods. (Y4), (Y11)
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Controls {
    /// Controllers.
    pub controllers: Vec<BodyController>,
    /// Wheels.
    pub wheels: Vec<ControlledWheel>,
    /// Hysteresis rods.
    pub rods: Vec<HysteresisRod>,
    /// Magnetic field that controllers and rods sense and act by; none where none does. (Y8)
    pub field: Option<MagneticField>,
    /// Orbit relative to which controllers measure; none where none does. (Y12)
    pub orbit: Option<Trajectory>,
    /// Where the Sun stands; none where no controller senses it. (Y12)
    pub sun: Option<SunPath>,
}

/// Wheel whose motor a controller may command.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlledWheel {
    /// Name.
    pub name: String,
    /// Axis, a unit vector, body axes.
    pub axis: [f64; 3],
    /// Angular momentum relative to the carrier at the start (N·m·s): that of [`FlexibleBody::wheels`](crate::FlexibleBody::wheels), to
    /// which controllers add.
    pub angular_momentum: f64,
}

/// Commands of controllers at a state. (Y4)
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Commands {
    /// Torque on the carrier (N·m), body axes, without the reactions of wheels.
    pub torque: [f64; 3],
    /// Torque of each wheel's motor on the wheel (N·m).
    pub motors: Vec<f64>,
    /// Magnetic dipole moment of the coils (A·m²), body axes.
    pub moment: [f64; 3],
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl Controls {
    /// None.
    pub const NONE: &'static Self = &Self {
        controllers: Vec::new(),
        wheels: Vec::new(),
        rods: Vec::new(),
        field: None,
        orbit: None,
        sun: None,
    };

    /// Whether there is no controller and no rod.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.controllers.is_empty() && self.rods.is_empty()
    }

    /// No command.
    #[must_use]
    pub fn silence(&self) -> Commands {
        Commands { torque: [0.0; 3], motors: vec![0.0; self.wheels.len()], moment: [0.0; 3] }
    }

    /// Names and units of what histories tell of controllers: `wheel.NAME.momentum`, then of each controller the commands that act, such as
    /// `CONTROLLER.torque.x`, and its states, `CONTROLLER.state.1` in units of its own.
    #[must_use]
    pub fn channels(&self) -> Vec<(String, &'static str)> {
        let wheel = |wheel: &ControlledWheel| (format!("wheel.{}.momentum", wheel.name), "N m s");
        let commanded = |to: &Actuator<usize>| match to {
            Actuator::Torque { axis } => (format!("torque.{}", AXES[*axis]), "N m"),
            Actuator::Wheel { wheel } => (format!("wheel.{}.torque", self.wheels[*wheel].name), "N m"),
            Actuator::Moment { axis } => (format!("moment.{}", AXES[*axis]), "A m^2"),
        };
        let mut channels: Vec<_> = self.wheels.iter().map(wheel).collect();
        for controller in &self.controllers {
            let name = &controller.name;
            let outputs = controller.outputs.iter().map(|output| commanded(&output.to));
            channels.extend(outputs.map(|(channel, unit)| (format!("{name}.{channel}"), unit)));
            channels.extend((1..=controller.start.len()).map(|state| (format!("{name}.state.{state}"), "1")));
        }
        channels
    }

    /// Magnetic field at a time (s), an attitude and an angular velocity of the carrier (rad/s, body axes); zero without one. (Y8)
    #[must_use]
    pub fn sensed(&self, t: f64, attitude: [f64; 4], omega: [f64; 3]) -> SensedField {
        self.field.map_or_else(SensedField::default, |field| SensedField::of(&field, t, attitude, omega))
    }

    /// Motion relative to the orbital frame at a time (s), an attitude and an angular velocity of the carrier (rad/s, body axes); zero
    /// without an orbit. (Y12)
    #[must_use]
    pub fn relative_to_orbit(&self, t: f64, attitude: [f64; 4], omega: [f64; 3]) -> SensedOrbit {
        self.orbit
            .as_ref()
            .map_or_else(SensedOrbit::default, |path| SensedOrbit::of(path, t, attitude, omega))
    }

    /// Unit vector to the Sun (body axes) at a time (s) and an attitude; zero without one. (Y12)
    #[must_use]
    pub fn toward_sun(&self, t: f64, attitude: [f64; 4]) -> [f64; 3] {
        self.sun.as_ref().map_or([0.0; 3], |sun| Turn::of(attitude).to_body(sun.at(t).0))
    }

    /// Angular momentum (N·m·s, body axes) of values about the axes of the wheels, or torque.
    #[must_use]
    pub fn about_axes(&self, values: &[f64]) -> [f64; 3] {
        self.wheels
            .iter()
            .zip(values)
            .fold([0.0; 3], |sum, (wheel, value)| add(sum, scale(*value, wheel.axis)))
    }
}

impl Commands {
    /// Adds the values of a controller's outputs.
    pub fn add(&mut self, controller: &BodyController, values: &[f64]) {
        for (output, value) in controller.outputs.iter().zip(values) {
            match output.to {
                Actuator::Torque { axis } => self.torque[axis] += value,
                Actuator::Wheel { wheel } => self.motors[wheel] += value,
                Actuator::Moment { axis } => self.moment[axis] += value,
            }
        }
    }
}

impl BodyController {
    /// Inputs of the law at a state; of a sample with the errors of the sensors, from its number and the index of the controller. (Y2)
    #[must_use]
    pub fn inputs(&self, state: &ControlState, sample: Option<(usize, u64)>) -> Vec<f64> {
        let input = |(index, input): (usize, &Input<Marker, usize, usize>)| {
            let mut value = input.of.value(state);
            if let (Some((controller, number)), Some(Sampling { seed, .. })) = (sample, self.sampling) {
                if input.noise > 0.0 {
                    value += input.noise * normal(seed, [controller, index], number);
                }
                if input.quantum > 0.0 {
                    value = input.quantum * (value / input.quantum).round();
                }
            }
            let error = value - input.reference;
            error - error.clamp(-input.deadband, input.deadband)
        };
        self.inputs.iter().enumerate().map(input).collect()
    }

    /// Values of the outputs, limited, and the rates of the states, or their next values. (Y1)
    #[must_use]
    pub fn act(&self, inputs: &[f64], states: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let demanded = self.law.outputs(inputs, states);
        let limited: Vec<f64> = demanded
            .iter()
            .zip(&self.outputs)
            .map(|(v, output)| output.limit.map_or(*v, |limit| v.clamp(-limit, limit)))
            .collect();
        let excess: Vec<f64> = limited.iter().zip(&demanded).map(|(limited, v)| limited - v).collect();
        let advance = self.law.advance(inputs, states, &excess);
        (limited, advance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MotionState;
    use crate::control::{ControlLaw, Measurement, Output, Pid};

    fn controller(pid: &Pid, limit: Option<f64>) -> BodyController {
        let axis = 1;
        let input = Input {
            of: Measurement::Rate { axis },
            reference: 0.2,
            deadband: 0.05,
            quantum: 0.0,
            noise: 0.0,
        };
        Controller {
            name: String::new(),
            inputs: vec![input],
            law: ControlLaw::Linear(pid.law(None)),
            outputs: vec![Output { to: Actuator::Torque { axis }, limit }],
            start: vec![0.0; 2],
            sampling: None,
        }
    }

    /// Each of the parts of (Y5) by hand: dead zone, gains, filter, limit, and an integral that is taken back beyond the limit alone.
    #[test]
    fn a_pid_law_is_its_formula() {
        let pid = Pid {
            proportional: vec![3.0],
            integral: vec![0.7],
            derivative: vec![1.9],
            signs: vec![1.0],
            has_rates: false,
            filter: Some(0.4),
            anti_windup: Some(2.5),
        };
        let omega = [9.0, 0.2 + 0.05 + 0.31, -4.0];
        let state = ControlState {
            t: 0.0,
            attitude: [1.0, 0.0, 0.0, 0.0],
            motion: MotionState { omega, q: &[], rate: &[] },
            wheels: &[],
            field: SensedField::default(),
            orbit: SensedOrbit::default(),
            sun: [0.0; 3],
        };
        let (e, z, f) = (0.31_f64, 1.3, 0.17);
        let demanded = -(3.0 * e + 0.7 * z + 1.9 * (e - f) / 0.4);
        for limit in [None, Some(1.1)] {
            let controller = controller(&pid, limit);
            assert_eq!(controller.problem(), None);
            let inputs = controller.inputs(&state, None);
            assert!((inputs[0] - e).abs() < 1e-15);
            let (found, rates) = controller.act(&inputs, &[z, f]);
            let limited = limit.map_or(demanded, |limit| demanded.max(-limit));
            let windup = (-demanded + limited) / (0.7 * 2.5);
            let close =
                |found: f64, expected: f64| assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            close(found[0], limited);
            close(rates[0], e - windup);
            close(rates[1], (e - f) / 0.4);
        }
    }
}
