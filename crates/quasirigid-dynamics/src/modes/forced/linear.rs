//! Linear model of the small motions about a steady state, between inputs and outputs, as a state space.
//! Loads of the inputs and motions of the places are those of the full system; the equations are those of the modes.
//! Equations (M7), (M16) and (M17), docs/theory/15-modes.md.

use nalgebra::{DMatrix, DVector};
use thiserror::Error;

use super::error::SteadyError;
use super::frame_rotation::effective;
use super::slopes::{DISPLACED, Instant, OMEGA, Slopes, THETA, VELOCITY};
use super::state::SteadyState;
use super::system::System;
use crate::math::vec3::cross;
use crate::model::force::{Axes, Force, ForceLaw, Wave};
use crate::model::{FlexibleBody, Marker, Support};

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
    /// Torque of a motor between the carrier and a rotor (N·m).
    Motor {
        /// Cyclic coordinate of the rotor.
        coordinate: usize,
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
    /// Rate of an internal coordinate (m/s, rad/s), such as the speed of a rotor relative to the carrier.
    Speed {
        /// Coordinate.
        coordinate: usize,
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
}

/// Error of a linear model.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LinearError {
    /// A material or a liquid answers with a memory, which no state of the model has.
    #[error(
        "{what} answers with a memory that has no states here: no linear model; give a material a Kelvin–Voigt damping, or leave the liquid out"
    )]
    Memory {
        /// Material or liquid, in words.
        what: String,
    },
    /// An output is the acceleration of a place, on a support that moves.
    #[error("the support of the body moves: the acceleration of a place is no output")]
    Driven,
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
}

impl LinearModel {
    /// Linear model about a steady state. (M16), (M17)
    ///
    /// # Errors
    /// [`LinearError`]: materials and liquids with a memory, accelerations on a support that moves, a state beyond the range of the body.
    pub fn about(
        body: &FlexibleBody,
        forces: &[Force<Marker>],
        equilibrium: SteadyState,
        inputs: &[LinearInput],
        outputs: &[LinearOutput],
    ) -> Result<Self, LinearError> {
        if let Some(liquid) = body.memories().first() {
            let name = body.coordinates()[liquid.coordinates.start].part();
            return Err(LinearError::Memory { what: format!("the liquid {name:?}") });
        }
        if !body.viscoelastic().is_empty() {
            return Err(LinearError::Memory { what: "a material".into() });
        }
        let (forces, followed) = effective(body, forces);
        let instant = equilibrium.at(0.0);
        let system = System::about(body, Slopes::of(body, &forces, &instant), &instant, followed);
        let small = SmallMotions::new(body, &instant, system, followed, inputs)?;
        let rows: Vec<_> = outputs.iter().map(|output| small.output(output)).collect::<Result<_, _>>()?;
        let (C, D) = rows.into_iter().unzip();
        Ok(Self { equilibrium, states: small.states(), A: listed(&small.A), B: listed(&small.B), C, D })
    }
}

fn listed(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// Small motions with their inputs. States: `θ`, elastic displacements, `δω`, rates of all coordinates, and `δv` where that is followed.
struct SmallMotions<'a> {
    body: &'a FlexibleBody,
    instant: &'a Instant,
    system: System,
    followed: bool,
    A: DMatrix<f64>,
    B: DMatrix<f64>,
    /// Forces of the inputs on the body (N), a column each.
    pushes: DMatrix<f64>,
}

/// A row of an output: by the states, by the inputs.
type Row = (DVector<f64>, DVector<f64>);

impl<'a> SmallMotions<'a> {
    fn new(
        body: &'a FlexibleBody,
        instant: &'a Instant,
        system: System,
        followed: bool,
        inputs: &[LinearInput],
    ) -> Result<Self, SteadyError> {
        let (moving, held) = (system.mass.nrows(), 3 + body.elastic());
        let size = held + moving;
        let loads = inputs.iter().map(|input| loads(body, instant, input));
        let loads =
            DMatrix::from_columns(&loads.collect::<Vec<_>>()).resize_vertically(6 + instant.q.len(), 0.0);
        let factor = system.mass.clone().cholesky().ok_or(SteadyError::BeyondRange)?;
        let mut A = DMatrix::zeros(size, size);
        A.view_mut((0, 0), (3, 3)).copy_from(&-system.turning());
        (0..held).for_each(|i| A[(i, held + i)] = 1.0);
        A.view_mut((held, 0), (moving, held)).copy_from(&-factor.solve(&system.stiffness));
        A.view_mut((held, held), (moving, moving)).copy_from(&-factor.solve(&system.rate));
        let mut B = DMatrix::zeros(size, inputs.len());
        B.view_mut((held, 0), (moving, inputs.len()))
            .copy_from(&factor.solve(&loads.rows(0, moving).into_owned()));
        let pushes = loads.rows(3 + instant.q.len(), 3).into_owned();
        Ok(Self { body, instant, system, followed, A, B, pushes })
    }

    fn states(&self) -> Vec<LinearState> {
        let n = self.instant.q.len();
        let velocities = if self.followed { 3 } else { 0 };
        (0..3)
            .map(LinearState::Attitude)
            .chain((0..self.body.elastic()).map(LinearState::Coordinate))
            .chain((0..3).map(LinearState::Rate))
            .chain((0..n).map(LinearState::Speed))
            .chain((0..velocities).map(LinearState::Velocity))
            .collect()
    }

    /// Place of the angular velocity among the states; the rates of coordinates follow.
    fn rates(&self) -> usize {
        3 + self.body.elastic()
    }

    fn none(&self) -> Row {
        (DVector::zeros(self.A.ncols()), DVector::zeros(self.B.ncols()))
    }

    /// A state as an output.
    fn state(&self, place: usize) -> Row {
        let (mut by_state, by_input) = self.none();
        by_state[place] = 1.0;
        (by_state, by_input)
    }

    fn output(&self, output: &LinearOutput) -> Result<(Vec<f64>, Vec<f64>), LinearError> {
        let (by_state, by_input) = match output {
            LinearOutput::Rate { axis } => self.state(self.rates() + axis),
            LinearOutput::Attitude { axis } => self.state(*axis),
            LinearOutput::Coordinate { coordinate } => self.state(3 + coordinate),
            LinearOutput::Speed { coordinate } => self.state(self.rates() + 3 + coordinate),
            LinearOutput::Momentum { axis } => self.momentum(*axis),
            LinearOutput::Displacement { at, axis } => self.displacement(at, *axis),
            LinearOutput::Acceleration { at, axis } => self.acceleration(at, *axis)?,
        };
        Ok((by_state.iter().copied().collect(), by_input.iter().copied().collect()))
    }

    /// `δK = J_s δω + H δq̇ + U δq`. (M2)
    fn momentum(&self, axis: usize) -> Row {
        let (mut by_state, by_input) = self.none();
        let (rates, n) = (self.rates(), self.instant.q.len());
        (0..3 + n).for_each(|k| by_state[rates + k] = self.system.mass[(axis, k)]);
        let slopes = self.system.coefficients.slopes.iter().take(self.body.elastic());
        slopes.enumerate().for_each(|(j, U)| by_state[3 + j] = U[axis]);
        (by_state, by_input)
    }

    fn displacement(&self, at: &Marker, axis: usize) -> Row {
        let (mut by_state, by_input) = self.none();
        let slopes = at.displacement_slopes(&self.instant.q);
        (0..self.body.elastic()).for_each(|j| by_state[3 + j] = slopes[j][axis]);
        (by_state, by_input)
    }

    /// Acceleration of the centre of mass or pole, and of the place relative to it. (M17)
    fn acceleration(&self, at: &Marker, axis: usize) -> Result<Row, LinearError> {
        let (mut by_state, mut by_input) = self.center_acceleration(axis)?;
        let omega = self.instant.omega;
        let (arm, slopes) = self.body.position_of(at, &self.instant.q);
        let (held, n) = (self.rates(), self.instant.q.len());
        let along = |vector: [f64; 3]| vector[axis];
        let mut accelerated = vec![0.0; 3 + n]; // by δω̇ and δq̈
        for k in 0..3 {
            let mut unit = [0.0; 3];
            unit[k] = 1.0;
            accelerated[k] = along(cross(unit, arm));
            by_state[held + k] +=
                along(cross(unit, cross(omega, arm))) + along(cross(omega, cross(unit, arm)));
        }
        for (j, slope) in slopes.iter().enumerate() {
            accelerated[3 + j] = slope[axis];
            by_state[held + 3 + j] += 2.0 * along(cross(omega, *slope));
            if j < self.body.elastic() {
                by_state[3 + j] += along(cross(omega, cross(omega, *slope)));
            }
        }
        for (k, weight) in accelerated.iter().enumerate() {
            by_state += *weight * self.A.row(held + k).transpose();
            by_input += *weight * self.B.row(held + k).transpose();
        }
        Ok((by_state, by_input))
    }

    /// Acceleration of the centre of mass of a free body by the forces; none of a point that is held. (M17)
    fn center_acceleration(&self, axis: usize) -> Result<Row, LinearError> {
        let (mut by_state, mut by_input) = self.none();
        let Some(per_mass) = self.body.translation() else {
            return match self.body.support() {
                Support::Prescribed { acceleration, .. }
                    if acceleration.iter().any(|a| a.value(&[0.0]) != 0.0) =>
                {
                    Err(LinearError::Driven)
                }
                _ => Ok((by_state, by_input)),
            };
        };
        let (held, n, elastic) = (self.rates(), self.instant.q.len(), self.body.elastic());
        let by = self.system.slopes.by.row(3 + n + axis);
        for k in 0..3 {
            by_state[k] += per_mass * by[THETA + k];
            by_state[held + k] += per_mass * by[OMEGA + k];
            if self.followed {
                by_state[held + 3 + n + k] += per_mass * by[VELOCITY + k];
            }
        }
        (0..elastic).for_each(|j| by_state[3 + j] += per_mass * by[DISPLACED + j]);
        (0..n).for_each(|j| by_state[held + 3 + j] += per_mass * by[DISPLACED + elastic + j]);
        by_input += per_mass * self.pushes.row(axis).transpose();
        Ok((by_state, by_input))
    }
}

/// Loads of a unit of an input: moment, generalised forces, force.
fn loads(body: &FlexibleBody, instant: &Instant, input: &LinearInput) -> DVector<f64> {
    let n = instant.q.len();
    let mut column = DVector::zeros(6 + n);
    match input {
        LinearInput::Torque { axis } => column[*axis] = 1.0,
        LinearInput::Motor { coordinate } => column[3 + coordinate] = 1.0,
        LinearInput::Force { at, axis } => {
            let mut force = [0.0; 3];
            force[*axis] = 1.0;
            let wave = Wave { frequency: 0.0, phase: 0.0 };
            let law = ForceLaw::Thrust { at: at.clone(), force, axes: Axes::Body, wave };
            let push = Force { name: String::new(), law };
            let [with, without] = [&[push][..], &[]].map(|forces| instant.loads(body, forces));
            let rows = |loads: &crate::model::force::Loads<f64>| {
                let rows = loads.moment.iter().chain(&loads.generalized).chain(&loads.force);
                DVector::from_iterator(6 + n, rows.copied())
            };
            column = rows(&with) - rows(&without);
        }
    }
    column
}
