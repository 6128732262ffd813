//! The full system step by step, under a torque that is held over each step: for hardware loops and other integrators' loops. (T1)

use super::drives::Drives;
use super::propagate::{check_drives, check_state, sizes};
use super::solver::FullSolver;
use super::start::FullState;
use super::system::FullSystem;
use crate::dynamics::external::Forced;
use crate::dynamics::layout::{Layout, MOMENTUM, PLACE, VELOCITY, attitude, triple};
use crate::dynamics::run::{Options, PropagateError, check as check_start};
use crate::dynamics::scale::Scales;
use crate::dynamics::stepper::{MOST_SUBSTEPS, StepStatus, StepperError, check};
use crate::math::ode::Solver;
use crate::math::rotation;
use crate::math::vec3::{add, norm, scale};
use crate::model::Kinetics;
use crate::model::control::Controls;
use crate::model::force::{ForceLaw, TIME};

/// Body with all its internal coordinates that is moved step by step under a torque on the carrier, held over each step.
///
/// The numbers are those of [`propagate_full`](super::propagate_full) under the same torque. Forces of the model act beside it.
pub struct FullStepper<'a> {
    solver: FullSolver<'a>,
    system: Forced<'a>,
    layout: Layout,
    kinetics: Kinetics<'a>,
    drives: Option<Drives<'a>>,
    options: Options,
}

impl std::fmt::Debug for FullStepper<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FullStepper").field("t", &self.time()).field("y", self.solver.y()).finish()
    }
}

impl<'a> FullStepper<'a> {
    /// Starts at a state; of the options tolerance, method and rounding count. A body at rest has the errors of one that turns by a radian a
    /// second.
    ///
    /// # Errors
    /// [`StepperError::Start`] for a state that is none, [`StepperError::Timed`] for forces that change at given times.
    pub fn new(system: Forced<'a>, initial: &FullState, options: Options) -> Result<Self, StepperError> {
        let timed = |law: &ForceLaw<_>| {
            matches!(
                law,
                ForceLaw::During { .. } | ForceLaw::TorqueTable { .. } | ForceLaw::ForceTable { .. }
            ) || law.formulas().is_some_and(|formulas| formulas.iter().any(|formula| formula.uses(TIME)))
        };
        if let Some(force) = system.forces.iter().find(|force| timed(&force.law)) {
            return Err(StepperError::Timed { name: force.name.clone() });
        }
        if let Some(drive) = system.body.drives().iter().find(|drive| drive.has_corners()) {
            return Err(StepperError::Cornered { name: drive.name.clone() });
        }
        let solver = solver(system, initial, &options, [0.0; 3])?;
        let kinetics = Kinetics::new(system.body).ok_or(PropagateError::LightCarrier)?;
        let (layout, drives) = (Layout::of(system.body), Drives::of(system.body));
        Ok(Self { solver, system, layout, kinetics, drives, options })
    }

    /// Puts the body into another state; the time begins anew.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn place(&mut self, at: &FullState) -> Result<(), StepperError> {
        self.solver = solver(self.system, at, &self.options, self.solver.held())?;
        Ok(())
    }

    /// Moves the body by a time (s) under a torque on the carrier (N·m, body axes).
    ///
    /// # Errors
    /// [`StepperError`]; the state is then that of the last step of the integrator.
    pub fn step(&mut self, torque: [f64; 3], dt: f64) -> Result<StepStatus, StepperError> {
        check(torque, dt)?;
        if torque != self.solver.held() {
            self.solver.hold(torque);
        }
        let end = self.solver.t() + dt;
        for _ in 0..MOST_SUBSTEPS {
            self.solver.step(end)?;
            if self.solver.t() >= end {
                let left = self.system.body.left_range(&self.solver.y()[self.layout.q()]);
                return Ok(left.map_or(StepStatus::Holds, StepStatus::Left));
            }
        }
        Err(StepperError::Long { dt })
    }

    /// Time (s) since the start.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.solver.t()
    }

    /// The state.
    #[must_use]
    pub fn state(&mut self) -> FullState {
        let y = self.solver.y();
        let (q, p) = (&y[self.layout.q()], &y[self.layout.p()]);
        let wheels = self.system.body.wheels().angular_momentum(self.solver.t());
        let own = add(triple(y, MOMENTUM), scale(-1.0, wheels));
        if let Some(drives) = &mut self.drives {
            drives.set(self.solver.t(), q);
            self.kinetics.drive(drives.rates());
        }
        let q = self.drives.as_ref().map_or(q, Drives::q);
        let mut rate = vec![0.0; self.layout.n];
        let omega = self.kinetics.velocities(own, p, q, &mut rate).omega;
        FullState {
            omega,
            attitude: rotation::normalized(attitude(y)),
            q: q.to_vec(),
            rate,
            place: triple(y, PLACE),
            velocity: triple(y, VELOCITY),
        }
    }

    /// Angular momentum (N·m·s), body axes.
    #[must_use]
    pub fn angular_momentum(&self) -> [f64; 3] {
        triple(self.solver.y(), MOMENTUM)
    }

    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    #[must_use]
    pub fn attitude(&self) -> [f64; 4] {
        rotation::normalized(attitude(self.solver.y()))
    }
}

/// Solver from a state at `t = 0`, under a torque.
fn solver<'a>(
    system: Forced<'a>,
    initial: &FullState,
    options: &Options,
    torque: [f64; 3],
) -> Result<FullSolver<'a>, PropagateError> {
    check_drives(system.body, 0.0)?;
    let initial = &initial.clone().driven(system.body);
    check_state(system.body, initial)?;
    check_start(norm(initial.omega), initial.attitude, &[], options)?;
    let layout = Layout::of(system.body);
    let y = initial.pack(system.body, layout);
    let (mut scales, _) = Scales::timed(system, initial.omega, triple(&y, MOMENTUM), initial.pose(), 1.0);
    if initial.omega == [0.0; 3] {
        scales.stir(initial.energy(system.body));
    }
    let sizes = sizes(system.body, layout, &scales);
    let allowed = sizes.iter().map(|size| options.tolerance * size).collect();
    let mut full = FullSystem::new(system, Controls::NONE, &sizes).ok_or(PropagateError::LightCarrier)?;
    full.hold(torque);
    Ok(FullSolver::new(full, y, allowed, options.method, options.rounding))
}
