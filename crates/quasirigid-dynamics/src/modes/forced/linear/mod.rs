//! Linear model of the small motions about a steady state, between inputs and outputs, as a state space.
//! The equations are those of the modes; materials and liquids, which answer with a memory there, have states here, and the error of that
//! is told.
//! Equations (M7) and (M16), (M17) and (M21), docs/theory/15-modes.md.

mod accuracy;
mod lag;
mod small_motions;
mod truncated;

use std::ops::Range;

use nalgebra::DMatrix;
use thiserror::Error;

pub use accuracy::LinearAccuracy;
pub use truncated::TruncatedLinearModel;

use self::lag::Lag;
use self::small_motions::SmallMotions;
use super::error::SteadyError;
use super::frame_rotation::effective;
use super::slopes::Slopes;
use super::state::SteadyState;
use super::system::System;
use crate::math::state_space::TruncationError;
use crate::model::force::Force;
use crate::model::{FlexibleBody, Marker, RationalModulus};

/// Input of a linear model.
#[derive(Clone, Debug, PartialEq)]
pub enum LinearInput {
    /// Torque on the carrier about a body axis (N·m).
    Torque {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Force at a place along a body axis (N).
    Force {
        /// Place.
        at: Marker,
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Torque of a motor between the carrier and a rotor, or in an axis of a hinge (N·m).
    Motor {
        /// Coordinate of the rotor or of the axis.
        coordinate: usize,
    },
    /// Acceleration of the pole, which the support prescribes, along a body axis (m/s²).
    Acceleration {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Torque of the motor of a momentum wheel on the wheel (N·m), whose angular momentum is then a state.
    Wheel {
        /// Axis of the wheel, a unit vector, body axes.
        axis: [f64; 3],
    },
}

/// Output of a linear model: the difference from the steady state, in body axes.
#[derive(Clone, Debug, PartialEq)]
pub enum LinearOutput {
    /// Angular velocity of the carrier about a body axis (rad/s).
    Rate {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Small rotation of the carrier about a body axis (rad).
    Attitude {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Angular momentum about the centre of mass of a free body, about the pole of any other (N·m·s).
    Momentum {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Displacement of a place relative to the carrier (m).
    Displacement {
        /// Place.
        at: Marker,
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Inertial acceleration of a place (m/s²).
    Acceleration {
        /// Place.
        at: Marker,
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Internal coordinate (m, rad).
    Coordinate {
        /// Elastic coordinate.
        coordinate: usize,
    },
    /// Angular momentum of some coordinates by their rates, relative to the carrier (N·m·s), such as that of a liquid.
    Internal {
        /// Coordinates.
        coordinates: Range<usize>,
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Rate of an internal coordinate (m/s, rad/s), such as the speed of a rotor relative to the carrier.
    Speed {
        /// Coordinate.
        coordinate: usize,
    },
    /// Angular momentum of a wheel relative to the carrier about its axis (N·m·s).
    Wheel {
        /// Number of the input of its torque, from 0.
        input: usize,
    },
}

/// State of a linear model: the difference from the steady state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearState {
    /// Small rotation of the carrier about a body axis (rad).
    Attitude(usize),
    /// Elastic coordinate (m, rad).
    Coordinate(usize),
    /// Angular velocity of the carrier about a body axis (rad/s).
    Rate(usize),
    /// Rate of a coordinate (m/s, rad/s).
    Speed(usize),
    /// Velocity of the centre of mass of a free body under drag, along a body axis (m/s).
    Velocity(usize),
    /// Displacement that a Maxwell element of a material has flowed, in units of the root of its energy (J^½).
    Lag {
        /// Material, from 0.
        material: usize,
        /// Maxwell element of the material, from 0.
        element: usize,
        /// Direction of strain, from 0.
        direction: usize,
    },
    /// Angular momentum of a wheel relative to the carrier about its axis (N·m·s), by the number of its input, from 0.
    Wheel(usize),
    /// State of a truncated model, from 0, without a meaning of its own.
    Truncated(usize),
}

/// Error of a linear model.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LinearError {
    /// The materials need more states than are worked with.
    #[error(
        "the materials need {states} states, more than {MOST_STATES}; give a narrower band of frequencies, or fewer elements"
    )]
    States {
        /// States needed.
        states: usize,
    },
    /// An output is the acceleration of a place, on a support that moves.
    #[error("the support of the body moves: the acceleration of a place is no output")]
    Driven,
    /// An input is the acceleration of the pole of a free body.
    #[error(
        "the acceleration of a free body follows from the forces on it and is no input; give force.x, or a [support] that holds a point"
    )]
    Free,
    /// The number of states of a truncated model.
    #[error(transparent)]
    Truncation(#[from] TruncationError),
    /// The steady state.
    #[error(transparent)]
    Steady(#[from] SteadyError),
}

/// Linear model `ẋ = A x + B u`, `y = C x + D u` of the small motions about a steady state. (M16)
#[derive(Clone, Debug, PartialEq)]
pub struct LinearModel {
    /// The steady state.
    pub equilibrium: SteadyState,
    /// Meaning of each state.
    pub states: Vec<LinearState>,
    /// Rows of `A`, one for each state.
    pub A: Vec<Vec<f64>>,
    /// Rows of `B`, one for each state; columns as the inputs.
    pub B: Vec<Vec<f64>>,
    /// Rows of `C`, one for each output.
    pub C: Vec<Vec<f64>>,
    /// Rows of `D`, one for each output; columns as the inputs.
    pub D: Vec<Vec<f64>>,
    /// Error by the states that stand for memories; none where nothing has a memory.
    pub accuracy: Option<LinearAccuracy>,
}

/// States of materials that are worked with.
const MOST_STATES: usize = 4000;

impl LinearModel {
    /// Linear model about a steady state; memories are met over a band of frequencies (rad/s), by default that of the body's own rates.
    /// (M16), (M17), (M21)
    ///
    /// # Errors
    /// [`LinearError`]: materials of too many states, accelerations of places on a support that moves, an acceleration of a free body as
    /// input, a state beyond the range of the body.
    pub fn about(
        body: &FlexibleBody,
        forces: &[Force<Marker>],
        equilibrium: SteadyState,
        inputs: &[LinearInput],
        outputs: &[LinearOutput],
        band: Option<[f64; 2]>,
    ) -> Result<Self, LinearError> {
        if body.translation().is_some()
            && inputs.iter().any(|input| matches!(input, LinearInput::Acceleration { .. }))
        {
            return Err(LinearError::Free);
        }
        let (forces, followed) = effective(body, forces);
        let instant = equilibrium.at(0.0);
        let system = System::about(body, Slopes::of(body, &forces, &instant), &instant, followed);
        let remembers = !body.viscoelastic().is_empty() || !body.memories().is_empty();
        let band = match band.filter(|_| remembers) {
            None if remembers => Some(accuracy::own_rates(body, &equilibrium).map_err(SteadyError::from)?),
            asked => asked,
        };
        let modulus =
            |band| body.viscoelastic().iter().map(move |part| RationalModulus::of(&part.rheology, band));
        let moduli: Vec<_> = band.into_iter().flat_map(modulus).collect();
        let lags: Vec<_> =
            body.viscoelastic().iter().zip(&moduli).map(|(part, own)| Lag::of(part, own)).collect();
        let states = lags.iter().map(Lag::states).sum();
        if states > MOST_STATES {
            return Err(LinearError::States { states });
        }
        let compared = |band| LinearAccuracy::compute(body, &equilibrium, &system, (&moduli, followed), band);
        let accuracy = band.map(compared);
        let small = SmallMotions::new(body, &instant, system, followed, inputs, &lags)?;
        let rows: Vec<_> = outputs.iter().map(|output| small.output(output)).collect::<Result<_, _>>()?;
        let (C, D) = rows.into_iter().unzip();
        Ok(Self {
            equilibrium,
            states: small.states(),
            A: listed(&small.A),
            B: listed(&small.B),
            C,
            D,
            accuracy,
        })
    }
}

fn listed(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}
