//! State space of the small motions: loads of the inputs, motions of the outputs.
//! Loads and motions of places are those of the full system.
//! Equations (M16), (M17) and (M21), docs/theory/15-modes.md.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::lag::Lag;
use super::{LinearError, LinearInput, LinearOutput, LinearState};
use crate::math::rotation::to_inertial;
use crate::math::vec3::{cross, scale};
use crate::model::force::{Axes, Force, ForceLaw, Loads, Wave};
use crate::model::{FlexibleBody, Marker, Support};
use crate::modes::forced::error::SteadyError;
use crate::modes::forced::slopes::{DISPLACED, Instant, OMEGA, THETA, VELOCITY};
use crate::modes::forced::system::System;

/// Small motions with their inputs. States: `θ`, elastic displacements, `δω`, rates of all coordinates, `δv` where that is followed,
/// lagging displacements of the materials, angular momenta of the wheels that inputs turn.
pub(super) struct SmallMotions<'a> {
    body: &'a FlexibleBody,
    instant: &'a Instant,
    system: System,
    followed: bool,
    lags: &'a [Lag],
    /// Numbers and axes of the inputs that turn wheels.
    wheels: Vec<(usize, [f64; 3])>,
    pub A: DMatrix<f64>,
    pub B: DMatrix<f64>,
    /// Forces of the inputs on the body (N), a column each.
    pushes: DMatrix<f64>,
    /// Accelerations of the pole by the inputs, a column each.
    driven: DMatrix<f64>,
}

/// A row of an output: by the states, by the inputs.
type Row = (DVector<f64>, DVector<f64>);

impl<'a> SmallMotions<'a> {
    pub fn new(
        body: &'a FlexibleBody,
        instant: &'a Instant,
        system: System,
        followed: bool,
        inputs: &[LinearInput],
        lags: &'a [Lag],
    ) -> Result<Self, SteadyError> {
        let (moving, held) = (system.mass.nrows(), 3 + body.elastic());
        let lagging = lags.iter().map(Lag::states).sum::<usize>();
        let wheels: Vec<_> = inputs.iter().enumerate().filter_map(wheel).collect();
        let size = held + moving + lagging + wheels.len();
        let loads = inputs.iter().map(|input| loads(body, instant, input));
        let loads =
            DMatrix::from_columns(&loads.collect::<Vec<_>>()).resize_vertically(6 + instant.q.len(), 0.0);
        let factor = system.mass.clone().cholesky().ok_or(SteadyError::BeyondRange)?;
        let mut A = DMatrix::zeros(size, size);
        A.view_mut((0, 0), (3, 3)).copy_from(&-system.turning());
        (0..held).for_each(|i| A[(i, held + i)] = 1.0);
        let mut forces = DMatrix::zeros(moving, size); // on the left-hand side
        forces.view_mut((0, 0), (moving, held)).copy_from(&system.stiffness);
        forces.view_mut((0, held), (moving, moving)).copy_from(&system.rate);
        let mut next = held + moving;
        for lag in lags {
            lag.pull(&mut forces, held);
            lag.follow(&mut A, &mut forces, next);
            next += lag.states();
        }
        for (_, axis) in &wheels {
            let turned = cross(system.omega, *axis);
            (0..3).for_each(|k| forces[(k, next)] = turned[k]);
            next += 1;
        }
        A.view_mut((held, 0), (moving, size)).copy_from(&-factor.solve(&forces));
        let mut B = DMatrix::zeros(size, inputs.len());
        B.view_mut((held, 0), (moving, inputs.len()))
            .copy_from(&factor.solve(&loads.rows(0, moving).into_owned()));
        for (place, (input, _)) in wheels.iter().enumerate() {
            B[(held + moving + lagging + place, *input)] = 1.0;
        }
        let pushes = loads.rows(3 + instant.q.len(), 3).into_owned();
        let mut driven = DMatrix::zeros(3, inputs.len());
        for (column, input) in inputs.iter().enumerate() {
            if let LinearInput::Acceleration { axis } = input {
                driven[(*axis, column)] = 1.0;
            }
        }
        Ok(Self { body, instant, system, followed, lags, wheels, A, B, pushes, driven })
    }

    pub fn states(&self) -> Vec<LinearState> {
        let n = self.instant.q.len();
        let velocities = if self.followed { 3 } else { 0 };
        (0..3)
            .map(LinearState::Attitude)
            .chain((0..self.body.elastic()).map(LinearState::Coordinate))
            .chain((0..3).map(LinearState::Rate))
            .chain((0..n).map(LinearState::Speed))
            .chain((0..velocities).map(LinearState::Velocity))
            .chain(self.lags.iter().enumerate().flat_map(|(material, lag)| lag.named(material)))
            .chain(self.wheels.iter().map(|(input, _)| LinearState::Wheel(*input)))
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

    /// Place of the angular momentum of the wheel that an input turns.
    fn wheel(&self, input: usize) -> Option<usize> {
        let place = self.wheels.iter().position(|(own, _)| *own == input)?;
        Some(self.A.nrows() - self.wheels.len() + place)
    }

    pub fn output(&self, output: &LinearOutput) -> Result<(Vec<f64>, Vec<f64>), LinearError> {
        let (by_state, by_input) = match output {
            LinearOutput::Rate { axis } => self.state(self.rates() + axis),
            LinearOutput::Attitude { axis } => self.state(*axis),
            LinearOutput::Coordinate { coordinate } => self.state(3 + coordinate),
            LinearOutput::Speed { coordinate } => self.state(self.rates() + 3 + coordinate),
            LinearOutput::Wheel { input } => {
                self.wheel(*input).map_or_else(|| self.none(), |place| self.state(place))
            }
            LinearOutput::Momentum { axis } => self.momentum(*axis),
            LinearOutput::Internal { coordinates, axis } => self.internal(coordinates, *axis),
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
        for (input, direction) in &self.wheels {
            self.wheel(*input).into_iter().for_each(|place| by_state[place] = direction[axis]);
        }
        (by_state, by_input)
    }

    /// `H δq̇` of some coordinates. (M2)
    fn internal(&self, coordinates: &Range<usize>, axis: usize) -> Row {
        let (mut by_state, by_input) = self.none();
        let rates = self.rates();
        coordinates.clone().for_each(|j| by_state[rates + 3 + j] = self.system.mass[(axis, 3 + j)]);
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

    /// Acceleration of the centre of mass of a free body by the forces, of a point on a support by the inputs. (M17)
    fn center_acceleration(&self, axis: usize) -> Result<Row, LinearError> {
        let (mut by_state, mut by_input) = self.none();
        let Some(per_mass) = self.body.translation() else {
            return match self.body.support() {
                Support::Prescribed { acceleration, .. }
                    if acceleration.iter().any(|a| a.value(&[0.0]) != 0.0) =>
                {
                    Err(LinearError::Driven)
                }
                _ => Ok((by_state, self.driven.row(axis).transpose())),
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

/// Number and axis of an input that turns a wheel.
fn wheel((number, input): (usize, &LinearInput)) -> Option<(usize, [f64; 3])> {
    match input {
        LinearInput::Wheel { axis } => Some((number, *axis)),
        _ => None,
    }
}

/// Loads of a unit of an input: moment, generalised forces, force.
fn loads(body: &FlexibleBody, instant: &Instant, input: &LinearInput) -> DVector<f64> {
    let n = instant.q.len();
    let mut column = DVector::zeros(6 + n);
    let along = |axis: usize| {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        unit
    };
    match input {
        LinearInput::Torque { axis } => column[*axis] = 1.0,
        LinearInput::Motor { coordinate } => column[3 + coordinate] = 1.0,
        LinearInput::Wheel { axis } => (0..3).for_each(|k| column[k] = -axis[k]),
        LinearInput::Force { at, axis } => {
            let wave = Wave { frequency: 0.0, phase: 0.0 };
            let law = ForceLaw::Thrust { at: at.clone(), force: along(*axis), axes: Axes::Body, wave };
            column = of_law(body, instant, law);
        }
        LinearInput::Acceleration { axis } => {
            let acceleration = scale(-1.0, to_inertial(instant.attitude, along(*axis)));
            column = of_law(body, instant, ForceLaw::UniformGravity { acceleration });
        }
    }
    column
}

/// Loads of a force, in the same order.
fn of_law(body: &FlexibleBody, instant: &Instant, law: ForceLaw<Marker>) -> DVector<f64> {
    let push = Force { name: String::new(), law };
    let [with, without] = [&[push][..], &[]].map(|forces| instant.loads(body, forces));
    let rows = |loads: &Loads<f64>| {
        let rows = loads.moment.iter().chain(&loads.generalized).chain(&loads.force);
        DVector::from_iterator(6 + instant.q.len(), rows.copied())
    };
    rows(&with) - rows(&without)
}
