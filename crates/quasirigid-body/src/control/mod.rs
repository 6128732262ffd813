//! Controllers of the attitude: what they measure, laws with states of their own, what they command; continuous or sampled.
//! Equations (Y1) to (Y12), docs/theory/20-control.md.

mod bound;
mod law;
mod measurement;
mod noise;
mod pid;
mod problem;
mod relay;
mod rod;
mod sensed_field;
mod sensed_orbit;

pub use bound::{BodyController, Commands, ControlledWheel, Controls};
pub use law::{ControlLaw, FormulaLaw, LinearLaw};
pub use measurement::{ControlState, Measurement};
pub use pid::Pid;
pub use problem::ControlProblem;
pub use relay::RelayLaw;
pub use rod::{HysteresisLoop, HysteresisRod, demagnetization_of_spheroid};
pub use sensed_field::SensedField;
pub use sensed_orbit::SensedOrbit;

/// Controller: measurements, a law with states, and commands to actuators. (Y1)
///
/// `P` describes places, `C` internal coordinates and `W` wheels: names in an assembly, markers and indices on a body.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Controller<P, C, W> {
    /// Name, for messages.
    pub name: String,
    /// What it measures, in the order of the inputs of the law.
    pub inputs: Vec<Input<P, C, W>>,
    /// Law.
    pub law: ControlLaw,
    /// What it commands, in the order of the outputs of the law.
    pub outputs: Vec<Output<W>>,
    /// States of the law at the start.
    pub start: Vec<f64>,
    /// Sampling; none of a continuous controller.
    pub sampling: Option<Sampling>,
}

/// Input of a controller: the measured value less a reference, rounded, with a dead zone. (Y2)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Input<P, C, W> {
    /// What is measured.
    pub of: Measurement<P, C, W>,
    /// Value that counts as zero, in the unit of the measurement.
    pub reference: f64,
    /// Half the width of the dead zone about zero, in the unit of the measurement.
    pub deadband: f64,
    /// Step of the rounding of the sensor, in the unit of the measurement; zero of one that does not round. Sampled controllers alone.
    pub quantum: f64,
    /// Standard deviation of the noise of a sample, in the unit of the measurement. Sampled controllers alone.
    pub noise: f64,
}

/// Output of a controller.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Output<W> {
    /// What is commanded.
    pub to: Actuator<W>,
    /// Largest size of the command (N·m, of a dipole moment A·m²), at which the actuator saturates; none without a limit.
    pub limit: Option<f64>,
}

/// Actuator of a controller.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum Actuator<W> {
    /// Torque on the carrier about a body axis (N·m).
    Torque {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Torque of the motor of a momentum wheel on the wheel (N·m): the rate of its angular momentum relative to the carrier. (Y4)
    Wheel {
        /// The wheel.
        wheel: W,
    },
    /// Magnetic dipole moment of a coil on the carrier along a body axis (A·m²). (Y8)
    Moment {
        /// Body axis, 0 to 2.
        axis: usize,
    },
}

/// Sampling of a controller: it measures at `t = k T`, and holds its commands from `t = k T + d` on. (Y3)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Period `T` (s).
    pub period: f64,
    /// Delay `d` (s) from a measurement to its command.
    pub delay: f64,
    /// Seed of the noise of the sensors.
    pub seed: u64,
}

impl<P, C, W> Controller<P, C, W> {
    /// Controller with its places, coordinates and wheels mapped to another description.
    ///
    /// # Errors
    /// The first error of a map.
    pub fn try_map<Q, D, V, E>(
        &self,
        place: impl Fn(&P) -> Result<Q, E>,
        coordinate: impl Fn(&C) -> Result<D, E>,
        wheel: impl Fn(&W) -> Result<V, E>,
    ) -> Result<Controller<Q, D, V>, E> {
        let input = |input: &Input<P, C, W>| {
            let of = input.of.try_map(&place, &coordinate, &wheel)?;
            let Input { reference, deadband, quantum, noise, .. } = *input;
            Ok(Input { of, reference, deadband, quantum, noise })
        };
        let output = |output: &Output<W>| {
            let to = match &output.to {
                Actuator::Torque { axis } => Actuator::Torque { axis: *axis },
                Actuator::Wheel { wheel: own } => Actuator::Wheel { wheel: wheel(own)? },
                Actuator::Moment { axis } => Actuator::Moment { axis: *axis },
            };
            Ok(Output { to, limit: output.limit })
        };
        Ok(Controller {
            name: self.name.clone(),
            inputs: self.inputs.iter().map(input).collect::<Result<_, E>>()?,
            law: self.law.clone(),
            outputs: self.outputs.iter().map(output).collect::<Result<_, E>>()?,
            start: self.start.clone(),
            sampling: self.sampling,
        })
    }

    /// Whether it senses a magnetic field or acts by one.
    #[must_use]
    pub fn is_magnetic(&self) -> bool {
        self.inputs.iter().any(|input| input.of.is_of_field())
            || self.outputs.iter().any(|output| matches!(output.to, Actuator::Moment { .. }))
    }

    /// Whether it senses the Sun. (Y12)
    #[must_use]
    pub fn sees_the_sun(&self) -> bool {
        self.inputs.iter().any(|input| input.of.is_of_sun())
    }

    /// Whether it measures relative to an orbit. (Y12)
    #[must_use]
    pub fn is_relative_to_orbit(&self) -> bool {
        self.inputs.iter().any(|input| input.of.is_of_orbit())
    }
}

impl Sampling {
    /// Samples that wait for their commands when the next is measured, and the time (s) after a sample at which the first of them acts.
    #[must_use]
    pub fn queue(&self) -> (usize, f64) {
        let whole = (self.delay / self.period * (1.0 + ROUNDING)).floor();
        let rest = (self.delay - whole * self.period).max(0.0);
        let late = rest > ROUNDING * self.delay;
        (whole as usize + usize::from(late), if late { rest } else { 0.0 })
    }
}

/// Relative distance of a delay from whole periods that counts as none.
const ROUNDING: f64 = 1e-12;
