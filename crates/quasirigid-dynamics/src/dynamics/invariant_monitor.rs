//! Invariant monitor: after each step the angular momentum and the attitude are projected back onto their constants
//! (P3), (P6), events are looked for, states become samples, and what acts from outside has its timing (Z1).
//!
//! One monitor serves every integrated system; a [`Trajectory`] tells the monitor the quantities of a state.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::conserved_momentum::Conserved;
use super::event::EventDetector;
use super::position::Position;
use super::run::{Observer, Options, Outcome, Pace, PropagateError, Sample, Scan};
use super::timing::{FeltLaws, Timing};
use crate::math::expression::Lobatto;
use crate::math::ode::{Checkpoint, Solver, State, StepObserver, StopReason, Stretch};
use crate::math::rotation;
use crate::math::vec3::{add, dot, norm, scale};
use crate::model::force::{Felt, ForceLaw, KinematicState, VARIABLES};
use crate::model::{Displaced, FlexibleBody, Marker, MotionState};

/// Motion of an integrated system, whose state begins with the angular momentum in body axes or with the angular velocity.
pub(super) trait Trajectory {
    /// State of the system.
    type State: State;

    /// Index of the attitude in the state.
    const ATTITUDE: usize;

    /// Quantities of a state.
    fn view(&mut self, t: f64, y: &[f64]) -> StateView;

    /// Angular momentum (N·m·s) of a state, body axes.
    fn angular_momentum(&mut self, t: f64, y: &[f64]) -> [f64; 3];

    /// Place of a state with this aligned attitude.
    fn position(&self, t: f64, y: &[f64], view: &StateView, attitude: [f64; 4]) -> Position;

    /// Change of the angular momentum and the attitude, as a state that is zero elsewhere.
    fn change(&self, y: &Self::State, angular_momentum: [f64; 3], attitude: [f64; 4]) -> Self::State {
        let mut change = y.zeroed();
        change.as_mut()[..3].copy_from_slice(&angular_momentum);
        change.as_mut()[Self::ATTITUDE..Self::ATTITUDE + 4].copy_from_slice(&attitude);
        change
    }

    /// Quantity that is constant along the motion.
    fn invariant(&self) -> Invariant;

    /// Energy at an angular momentum less the change that the state accounts for (J), constant along the motion, and its gradient over the
    /// angular momentum; none where the equations do not keep the balance. (R16)
    fn energy_balance(&self, y: &[f64], K: [f64; 3]) -> Option<(f64, [f64; 3])> {
        let _ = (y, K);
        None
    }

    /// Part displaced beyond the range of the equations. (K14)
    fn left(&self, y: &[f64]) -> Option<Displaced> {
        let _ = y;
        None
    }

    /// Called after each step, with the state corrected.
    fn stepped(&mut self, t: f64, y: &[f64]) {
        let _ = (t, y);
    }

    /// Called before the steps in a stretch between breakpoints of the forces, with whether they begin at its begin. (Z1)
    fn enter(&mut self, stretch: Stretch, begins: bool) {
        let _ = (stretch, begins);
    }

    /// The state after what jumps at a time, where something does: sampled controllers. (Y3)
    fn jumped(&mut self, t: f64, y: &Self::State) -> Option<Self::State> {
        let _ = (t, y);
        None
    }

    /// Saves what the motion has summed up beside the state.
    fn save(&self, checkpoint: &mut Checkpoint) {
        let _ = checkpoint;
    }

    /// Loads what was saved; none if it is of another motion.
    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let _ = checkpoint;
        Some(())
    }

    /// Passes the internal coordinates and their rates to an observer.
    fn show_coordinates(&self, view: &StateView, observer: &mut dyn Observer) {
        observer.coordinates(&view.q, &view.rate);
    }

    /// Passes what controllers command and hold to an observer that keeps it.
    fn show_controls(&self, t: f64, y: &[f64], view: &StateView, observer: &mut dyn Observer) {
        let _ = (t, y, view, observer);
    }
}

/// Quantities of a state.
#[derive(Clone, Debug)]
pub(super) struct StateView {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Angular momentum (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Energy of rotation and deformation (J).
    pub energy: f64,
    /// Internal coordinates and their rates; empty where coordinates follow the angular velocity.
    pub q: Vec<f64>,
    pub rate: Vec<f64>,
    /// Energy taken by the dashpots (J).
    pub dissipated: f64,
    /// Work of the external forces (J).
    pub work: f64,
    /// Parts of the change of energy since the start that are accounted for in the state (J).
    pub explained: [f64; 2],
    /// Angle turned (rad).
    pub angle: f64,
    /// Impulse of the external moments (N·m·s), inertial axes.
    pub impulse: [f64; 3],
}

/// Invariant of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Invariant {
    /// Inertial angular momentum, with its body components in the state.
    AngularMomentum,
    /// Direction of the inertial angular momentum; the truncation changes the size.
    Direction,
    /// Inertial angular momentum less the impulse of the external moments.
    Impulse,
}

/// Imbalance of the energy, relative to the energy, that is left as rounding.
const BALANCED: f64 = 32.0 * f64::EPSILON;
/// Largest change of the angular momentum, relative to it, that a projection makes: beyond it the step is at fault.
const FARTHEST: f64 = 1e-3;

/// Limit of the Newton steps of a projection, which square the gap.
const PROJECTIONS: usize = 4;

/// Monitor of the invariants and the accounts of a run.
pub(super) struct InvariantMonitor<'o, T> {
    pub trajectory: T,
    /// Angular momentum at the start.
    angular_momentum: Conserved,
    /// Energy at the start.
    energy: f64,
    /// `Σ ln(|K|/G)` of the projections made. (P6)
    drift: f64,
    detector: EventDetector,
    /// Part that has left the range of the equations, which ends the run.
    left: Option<Displaced>,
    /// Timing of what acts from outside, where something depends on the time.
    pub timing: Option<Timing<'o>>,
    pub observer: &'o mut dyn Observer,
    /// Outputs so far.
    outputs: u64,
    pace: Pace,
}

impl<'o, T: Trajectory> InvariantMonitor<'o, T> {
    /// From the first state and its angular momentum.
    pub fn new(
        mut trajectory: T,
        y: &[f64],
        angular_momentum: Conserved,
        options: &Options,
        observer: &'o mut dyn Observer,
    ) -> Self {
        let energy = trajectory.view(0.0, y).energy;
        let (detector, pace) = (EventDetector::new(&options.events), Pace::new());
        let mut monitor = Self {
            trajectory,
            angular_momentum,
            energy,
            drift: 0.0,
            detector,
            left: None,
            timing: None,
            observer,
            outputs: 0,
            pace,
        };
        let start = monitor.sample(0.0, y);
        monitor.detector.set(&start);
        monitor
    }

    /// Goes on from the checkpoint of the observer, if it has one; returns the number of outputs made before.
    pub fn resume(&mut self, solver: &mut impl Solver<State = T::State>) -> Result<usize, PropagateError> {
        let Some(mut checkpoint) = self.observer.resumes() else { return Ok(0) };
        let loaded = self.load(&mut checkpoint, |trajectory, checkpoint| {
            trajectory.load(checkpoint)?;
            solver.load(checkpoint)
        });
        loaded.ok_or(PropagateError::Checkpoint)
    }

    /// Passes a checkpoint to the observer, with what `state` saves behind the monitor.
    #[cold]
    #[inline(never)]
    pub fn save(&mut self, state: impl FnOnce(&T, &mut Checkpoint)) {
        let mut checkpoint = Checkpoint::default();
        checkpoint.save_count(self.outputs);
        checkpoint.save(self.drift);
        self.detector.save(&mut checkpoint);
        self.timing.iter().for_each(|timing| timing.save(&mut checkpoint));
        state(&self.trajectory, &mut checkpoint);
        self.observer.checkpoint(checkpoint);
    }

    /// Loads a checkpoint to its end, with what `state` loads behind the monitor; returns the number of outputs made before.
    pub fn load(
        &mut self,
        checkpoint: &mut Checkpoint,
        state: impl FnOnce(&mut T, &mut Checkpoint) -> Option<()>,
    ) -> Option<usize> {
        self.outputs = checkpoint.load_count()?;
        self.drift = checkpoint.load()?;
        self.detector.load(checkpoint)?;
        self.timing.iter_mut().try_for_each(|timing| timing.load(checkpoint))?;
        state(&mut self.trajectory, checkpoint)?;
        usize::try_from(self.outputs).ok().filter(|_| checkpoint.is_spent())
    }

    /// Tells the observer the progress after so many steps from moment to moment; none between.
    #[inline(always)]
    pub fn progress(&mut self, steps: u64, t: f64) -> Option<ControlFlow<()>> {
        self.pace.due(steps).then(|| self.observer.progress(t))
    }

    /// Corrects the state after a step.
    #[inline(always)]
    pub fn settle(&mut self, solver: &mut impl Solver<State = T::State>) -> ControlFlow<()> {
        self.hold_invariants(solver);
        self.trajectory.stepped(solver.t(), solver.y().as_ref());
        self.left = self.trajectory.left(solver.y().as_ref());
        let mut missed = false;
        if let Some(timing) = &mut self.timing {
            timing.stepped(solver.rule(), solver.t());
            missed = timing.missed.is_some();
        }
        if self.left.is_some() || missed { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Sample of a state, projected as states after steps are: between steps the interpolant errs as much.
    pub fn sample(&mut self, t: f64, y: &[f64]) -> Sample {
        let y = &self.projected(t, y);
        let view = self.trajectory.view(t, y);
        self.read(t, y, &view)
    }

    /// What the formulas of laws feel at a state. (F9)
    fn felt(&mut self, t: f64, y: &[f64], body: &FlexibleBody, laws: &[&ForceLaw<Marker>]) -> Vec<Felt> {
        let view = self.trajectory.view(t, y);
        let sample = self.read(t, y, &view);
        let motion = MotionState { omega: view.omega, q: &view.q, rate: &view.rate };
        let pole_velocity =
            add(sample.velocity, rotation::to_inertial(sample.attitude, body.pole_from_center(motion).1));
        let kinematics =
            KinematicState { t, attitude: sample.attitude, pole: sample.pole, pole_velocity, motion };
        laws.iter().map(|law| body.felt(law, &kinematics)).collect()
    }

    /// State with `|K|` and the balance of the energy restored. (P6)
    fn projected(&mut self, t: f64, y: &[f64]) -> Vec<f64> {
        let mut projected = y.to_vec();
        if self.trajectory.invariant() == Invariant::AngularMomentum && self.angular_momentum.held() {
            let K = self.trajectory.angular_momentum(t, y);
            let change = add(self.restored(y, K), scale(-1.0, K));
            (0..3).for_each(|axis| projected[axis] += change[axis]);
        }
        projected
    }

    /// Angular momentum with `|K|` and the balance of the energy restored, by Newton steps along the sphere. (P6)
    #[inline(always)]
    fn restored(&self, y: &[f64], K: [f64; 3]) -> [f64; 3] {
        let mut K = self.angular_momentum.sized(K);
        for _ in 0..PROJECTIONS {
            let Some((energy, gradient)) = self.trajectory.energy_balance(y, K) else { break };
            let Some(change) = self.energy_change(K, energy - self.energy, gradient) else { break };
            K = self.angular_momentum.sized(add(K, change));
        }
        K
    }

    /// Formulas of the time, as far as they were followed.
    pub fn scan(&self) -> Scan {
        self.timing.as_ref().map(Timing::scan).unwrap_or_default()
    }

    /// Outcome of the run.
    pub fn outcome(&self, reason: StopReason) -> Outcome {
        let missed = self.timing.as_ref().and_then(|timing| timing.missed);
        let end = self.left.map(Outcome::LeftRange).or(missed.map(Outcome::Missed));
        end.unwrap_or_else(|| Outcome::of(reason, self.detector.triggered))
    }

    fn read(&self, t: f64, y: &[f64], view: &StateView) -> Sample {
        let attitude = self.aligned(y, view.angular_momentum);
        let Position { place, velocity, pole } = self.trajectory.position(t, y, view, attitude);
        Sample {
            t,
            omega: view.omega,
            attitude,
            angular_momentum: view.angular_momentum,
            energy: view.energy,
            dissipated: view.dissipated,
            work: view.work,
            energy_drift: view.energy - self.energy - view.explained[0] - view.explained[1],
            momentum_drift: self.momentum_drift(view, attitude),
            revolutions: view.angle / TAU,
            place,
            velocity,
            pole,
        }
    }

    fn momentum_drift(&self, view: &StateView, attitude: [f64; 4]) -> f64 {
        match self.trajectory.invariant() {
            Invariant::AngularMomentum if self.angular_momentum.held() => self.drift,
            Invariant::AngularMomentum | Invariant::Direction => {
                self.angular_momentum.change(view.angular_momentum)
            }
            Invariant::Impulse => {
                let K_N = self.angular_momentum.K_N;
                let expected = add(K_N, view.impulse);
                let gap =
                    norm(add(rotation::to_inertial(attitude, view.angular_momentum), scale(-1.0, expected)));
                if gap > 0.0 { gap / norm(expected).max(norm(K_N)) } else { gap }
            }
        }
    }

    /// Attitude that gives the angular momentum its inertial direction where that is known (P3); elsewhere the normalised attitude.
    #[inline(always)]
    fn aligned(&self, y: &[f64], angular_momentum: [f64; 3]) -> [f64; 4] {
        let attitude = [0, 1, 2, 3].map(|i| y[T::ATTITUDE + i]);
        match self.trajectory.invariant() {
            Invariant::AngularMomentum | Invariant::Direction => {
                self.angular_momentum.aligned(attitude, angular_momentum)
            }
            Invariant::Impulse => rotation::normalized(attitude),
        }
    }

    /// Change of the angular momentum, tangential to `|K| = G`, that takes a gap in the balance of the energy out; none where the gap is
    /// rounding, which next to a steady spin would move the angular momentum more than the integrator errs. (P6)
    #[inline(always)]
    fn energy_change(&self, K: [f64; 3], gap: f64, gradient: [f64; 3]) -> Option<[f64; 3]> {
        if gap.abs() <= BALANCED * self.energy.abs() {
            return None;
        }
        let slope = add(gradient, scale(-dot(K, gradient) / dot(K, K), K));
        let change = scale(-gap / dot(slope, slope), slope);
        (norm(change) <= FARTHEST * norm(K)).then_some(change)
    }

    /// Projects `|K|` and the energy (P6) and the attitude (P3) back onto their constants.
    #[inline(always)]
    fn hold_invariants(&mut self, solver: &mut impl Solver<State = T::State>) {
        let y = solver.y().as_ref();
        let mut pull = [0.0; 3];
        let angular_momentum = match self.trajectory.invariant() {
            Invariant::Impulse => [0.0; 3],
            Invariant::AngularMomentum | Invariant::Direction => {
                self.trajectory.angular_momentum(solver.t(), y)
            }
        };
        if self.trajectory.invariant() == Invariant::AngularMomentum && self.angular_momentum.held() {
            let drift = self.angular_momentum.drift(angular_momentum);
            self.drift += drift;
            pull = add(self.restored(y, angular_momentum), scale(-1.0, angular_momentum));
        }
        let aligned = self.aligned(y, angular_momentum);
        let turn = std::array::from_fn(|i| aligned[i] - y[T::ATTITUDE + i]);
        solver.correct(&self.trajectory.change(solver.y(), pull, turn));
    }
}

impl<M: Solver<State = T::State>, T: Trajectory> StepObserver<M> for InvariantMonitor<'_, T> {
    fn output(&mut self, t: f64, y: &M::State) {
        let y = &self.projected(t, y.as_ref());
        let view = self.trajectory.view(t, y);
        let sample = self.read(t, y, &view);
        self.trajectory.show_coordinates(&view, self.observer);
        self.trajectory.show_controls(t, y, &view, self.observer);
        self.observer.sample(&sample);
        self.outputs += 1;
    }

    fn stop(&mut self, t: f64) -> f64 {
        self.timing.as_mut().map_or(f64::INFINITY, |timing| timing.stop(t))
    }

    fn stretch(&mut self, t: f64) -> Option<(Stretch, bool)> {
        let (stretch, begins) = self.timing.as_mut()?.stretch(t)?;
        self.trajectory.enter(stretch, begins);
        Some((stretch, begins))
    }

    fn takes_back(&mut self, solver: &mut M) -> Option<M::State> {
        let FeltLaws { body, laws, shares } = self.timing.as_ref()?.felt()?;
        let (rule, dense) = (solver.rule(), solver.dense());
        let mut along = vec![[[0.0; VARIABLES]; Lobatto::POINTS]; laws.len()];
        for (place, share) in shares.into_iter().enumerate() {
            let t = rule.t + share * rule.h;
            for (along, felt) in along.iter_mut().zip(self.felt(t, dense.at(t).as_ref(), body, &laws)) {
                along[place] = felt;
            }
        }
        self.timing.as_mut()?.takes_back(rule, &along).then(|| dense.at(rule.t))
    }

    fn event(&mut self, solver: &mut M) -> Option<f64> {
        if self.detector.idle() {
            return None;
        }
        let mut detector = std::mem::take(&mut self.detector);
        let end = self.sample(solver.t(), solver.y().as_ref());
        let mut dense = None;
        let event = detector.check(&end, |t| {
            let dense = dense.get_or_insert_with(|| solver.dense());
            self.sample(t, dense.at(t).as_ref())
        });
        self.detector = detector;
        event
    }

    #[inline(always)]
    fn stepped(&mut self, solver: &mut M) -> ControlFlow<()> {
        self.settle(solver)?;
        if let Some(y) = self.trajectory.jumped(solver.t(), solver.y()) {
            solver.rewind(solver.t(), y);
        }
        let Some(flow) = self.progress(solver.work().steps, solver.t()) else {
            return ControlFlow::Continue(());
        };
        if self.observer.wants_checkpoint() {
            self.save(|trajectory, checkpoint| {
                trajectory.save(checkpoint);
                solver.save(checkpoint);
            });
        }
        flow
    }
}
