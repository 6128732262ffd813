//! Reduced equations step by step, under a torque that is held over each step: for hardware loops and other integrators' loops.
//! The energy form, (R16) and (R22), docs/theory/03-reduction.md.

use super::form::{AngularMomentumForm, Equations, error_scale};
use super::run::{PropagateError, Start, check as check_start};
use super::start::start;
use super::stepper::{MOST_SUBSTEPS, StepStatus, StepperError, check};
use crate::math::ode::{Dop853, Solver, System};
use crate::math::rotation;
use crate::math::simd::{Arithmetic, Unfused};
use crate::math::vec3::norm;
use crate::model::{EnergyMotion, Form, Principal, ReducedBody};

/// Reduced body that is moved step by step under a torque on the carrier, held over each step.
///
/// `K̇ = K × ω + M` with the energy form (R22): how the torque itself bends the body is left out, as in exported equations. Without a torque
/// the steps are those of [`propagate`](super::propagate).
///
/// ```
/// use quasirigid::dynamics::{ReducedStepper, StepStatus};
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let reduced = reduce(&ring_of_points(4).body()?, 3)?;
/// let mut body = ReducedStepper::new(&reduced, Start::new([0.1, 0.0, 1.0], ALIGNED), 1e-10)?;
/// for _ in 0..100 {
///     let torque = body.omega().map(|rate| -0.2 * rate);
///     assert_eq!(body.step(torque, 0.01)?, StepStatus::Holds);
/// }
/// assert!((body.time() - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ReducedStepper {
    solver: Dop853<Held, State, Unfused>,
    body: ReducedBody,
    tolerance: f64,
    /// Spins (rad/s) below which the equations hold, and from which they fail.
    range: [f64; 2],
    /// Least moment of inertia (kg·m²).
    least: f64,
    torque: [f64; 3],
}

/// Angular momentum and attitude, each in four components.
type State = [f64; 8];

/// The equations with the torque that is held.
#[derive(Clone, Debug)]
struct Held {
    form: AngularMomentumForm,
    torque: [f64; 3],
}

impl System<State> for Held {
    #[inline(always)]
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &State, rate: &mut State) {
        let [x, y, z, _, attitude @ ..] = *y;
        let EnergyMotion { omega, rate: moved, .. } = self.form.under::<A>([x, y, z], self.torque);
        let [s, i, j, k] = rotation::rate(attitude, omega);
        *rate = [moved[0], moved[1], moved[2], 0.0, s, i, j, k];
    }
}

impl ReducedStepper {
    /// Starts at a state, with an error allowed per step relative to the angular momentum and in radians (1e-15 to 1e-2).
    ///
    /// # Errors
    /// [`PropagateError`]: an attitude, an angular velocity or a tolerance that is none.
    pub fn new(body: &ReducedBody, initial: Start, tolerance: f64) -> Result<Self, PropagateError> {
        let y = packed(body, initial, tolerance)?;
        let held = Held { form: AngularMomentumForm::new(body), torque: [0.0; 3] };
        Ok(Self {
            solver: Dop853::new(held, 0.0, y, allowed(body, y, tolerance)),
            body: body.clone(),
            tolerance,
            range: [f64::INFINITY; 2],
            least: Principal::compute(body.J).moments[0],
            torque: [0.0; 3],
        })
    }

    /// The same with the spins (rad/s) below which the equations hold, and from which they fail.
    #[must_use]
    pub fn within(self, range: [f64; 2]) -> Self {
        Self { range, ..self }
    }

    /// Puts the body into another state; the time goes on.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn place(&mut self, at: Start) -> Result<(), PropagateError> {
        let y = packed(&self.body, at, self.tolerance)?;
        let held = self.solver.system().clone();
        self.solver = Dop853::new(held, self.solver.t(), y, allowed(&self.body, y, self.tolerance));
        Ok(())
    }

    /// Moves the body by a time (s) under a torque on it (N·m, body axes).
    ///
    /// # Errors
    /// [`StepperError`]; the state is then that of the last step of the integrator.
    pub fn step(&mut self, torque: [f64; 3], dt: f64) -> Result<StepStatus, StepperError> {
        check(torque, dt)?;
        if torque != self.torque {
            self.torque = torque;
            self.solver.system_mut().torque = torque;
            let (t, y) = (self.solver.t(), *self.solver.y());
            self.solver.rewind(t, y);
        }
        let end = self.solver.t() + dt;
        for _ in 0..MOST_SUBSTEPS {
            self.solver.step(end)?;
            if self.solver.t() >= end {
                return Ok(self.status());
            }
        }
        Err(StepperError::Long { dt })
    }

    /// By the spin and, as the square of one, the angular acceleration of the torque.
    fn status(&self) -> StepStatus {
        let turn = (norm(self.torque) / self.least).sqrt();
        let spin = norm(self.omega()).max(turn);
        match self.range {
            [holds, _] if spin < holds => StepStatus::Holds,
            [_, fails] if spin < fails => StepStatus::Marginal,
            _ => StepStatus::Fails,
        }
    }

    /// Time (s) since the start.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.solver.t()
    }

    /// Angular velocity (rad/s), body axes, under the torque of the last step.
    #[must_use]
    pub fn omega(&self) -> [f64; 3] {
        let held = self.solver.system();
        held.form.under::<Unfused>(self.angular_momentum(), held.torque).omega
    }

    /// Angular momentum (N·m·s), body axes.
    #[must_use]
    pub fn angular_momentum(&self) -> [f64; 3] {
        let y = self.solver.y();
        [y[0], y[1], y[2]]
    }

    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    #[must_use]
    pub fn attitude(&self) -> [f64; 4] {
        let y = self.solver.y();
        rotation::normalized([y[4], y[5], y[6], y[7]])
    }

    /// Energy (J), without that of wheels.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.solver.system().form.energy(self.angular_momentum())
    }
}

fn packed(body: &ReducedBody, initial: Start, tolerance: f64) -> Result<State, PropagateError> {
    let options = super::run::Options { tolerance, ..Default::default() };
    check_start(norm(initial.omega), initial.attitude, &[], &options)?;
    let K = if initial.omega == [0.0; 3] {
        body.wheels()
    } else {
        start(body, initial.omega, Form::AngularMomentum).ok_or(PropagateError::NoAngularMomentum)?
    };
    let [s, i, j, k] = initial.attitude;
    Ok([K[0], K[1], K[2], 0.0, s, i, j, k])
}

/// Errors allowed at a state: of a body at rest those of one that turns by a radian a second.
fn allowed(body: &ReducedBody, [x, y, z, ..]: State, tolerance: f64) -> State {
    let [xx, yy, zz, ..] = body.J;
    let size = error_scale(Form::AngularMomentum, [x, y, z], [0.0; 3]);
    let first = tolerance * if size > 0.0 { size } else { (xx + yy + zz) / 3.0 };
    [first, first, first, f64::INFINITY, tolerance, tolerance, tolerance, tolerance]
}
