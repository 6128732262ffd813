//! Motion of the reduced equations under forces, with what vibrations excited by the forces take from its energy and add to its angular velocity.
//! Equations (E5), (E7) and (E8), docs/theory/09-forced-reduction.md.

use super::equations::SlowEquations;
use super::flow::{Correction, SlowPoint, slow_point};
use super::load_ratio::load_ratio_of;
use super::ringing::{Ringing, Vibrations};
use super::state::SlowState;
use super::system::SlowSystem;
use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::invariant_monitor::{Invariant, StateView, Trajectory};
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, SLOW_LENGTH, triple};
use crate::dynamics::position::Position;
use crate::math::ode::{Checkpoint, Stretch};
use crate::model::{Displaced, Form, MotionState};

/// Share of the energy of a correction that comes and goes: the vibrations of both its ends may add. (E5)
const BOTH_ENDS: f64 = 4.0;

/// Least order whose equations have displacements.
const DISPLACED: usize = 2;

/// Motion of the reduced equations, and the error of what they dissipate.
pub(super) struct SlowMotion<'a> {
    system: SlowSystem<'a>,
    /// Last state that a step has reached, its time (s), and the error of the power (W) there.
    y: [f64; SLOW_LENGTH],
    t: f64,
    error_of_power: f64,
    /// Slow motion there, the last correction, what corrections have changed by within a vibration, and the largest energy (J) of that.
    slow: SlowPoint,
    last: Correction,
    quick: Correction,
    largest: f64,
    /// Energy (J) of the vibrations from jumps, and of what the series leaves out of the dissipated one.
    summed: f64,
    /// Largest ratio in which the series has converged.
    load_ratio: f64,
    /// Vibrations that the equations leave out; none of a rigid body and without forces.
    vibrations: Option<Vibrations>,
}

impl<'a> SlowMotion<'a> {
    /// From the first state.
    pub fn new(system: SlowSystem<'a>, y: &[f64; SLOW_LENGTH]) -> Self {
        let SlowEquations { system: forced, order, .. } = system.equations;
        let n = forced.body.coordinates().len();
        let (error_of_power, largest, summed, load_ratio) = (0.0, 0.0, 0.0, 0.0);
        let (last, quick) = (Correction::none(n), Correction::none(n));
        let (K, pose) = place(&system, 0.0, y);
        let slow = slow_point(forced, order, K, &pose);
        let vibrations = if moves(forced, order) { Vibrations::of(forced) } else { None };
        let mut motion = Self {
            system,
            y: *y,
            t: 0.0,
            error_of_power,
            slow,
            last,
            quick,
            largest,
            summed,
            load_ratio,
            vibrations,
        };
        motion.correct();
        if let Some(vibrations) = &mut motion.vibrations {
            vibrations.begin(forced, K, &pose, &motion.slow);
        }
        motion
    }

    /// Error of the angular velocity by vibrations; none where it is small. (E8)
    pub fn ringing(&self) -> Option<Ringing> {
        self.vibrations.as_ref().and_then(Vibrations::told)
    }

    /// Largest change of the loads by displacements so far, beside the stiffness; zero of a rigid body. (E7)
    pub fn load_ratio(&self) -> f64 {
        self.load_ratio
    }

    /// Energy (J) of excited vibrations, and of what the series leaves out of the dissipated one. (E5)
    pub fn left_out(&self) -> f64 {
        self.summed + BOTH_ENDS * self.largest
    }

    fn point(&self) -> SlowPoint {
        let (K, pose) = place(&self.system, self.t, &self.y);
        slow_point(self.system.equations.system, self.system.equations.order, K, &pose)
    }

    /// Takes the displacements, the correction and the ratio of the loads at the state as the last ones.
    fn correct(&mut self) -> Correction {
        let (K, pose) = place(&self.system, self.t, &self.y);
        let SlowEquations { system, order, .. } = self.system.equations;
        if !moves(system, order) {
            return self.last.clone();
        }
        let (point, correction) = Correction::at(system, order, K, &pose);
        self.error_of_power = correction.error_of_power(system);
        if order >= DISPLACED {
            self.load_ratio = self.load_ratio.max(load_ratio_of(system, K, &pose));
        }
        self.slow = point;
        std::mem::replace(&mut self.last, correction)
    }
}

/// True if the equations of an order have parts that move: displacements, or cyclic rates, which begin a degree lower. (C3)
fn moves(system: Forced, order: usize) -> bool {
    order >= DISPLACED || (order > 0 && !system.body.cyclic().is_empty())
}

/// Angular momentum (N·m·s) and pose of a state, at the limit of the time inside the stretch.
fn place(system: &SlowSystem, t: f64, y: &[f64]) -> ([f64; 3], Pose<f64>) {
    let t = system.stretch.within(t);
    let K = match system.form {
        Form::AngularMomentum => triple(y, MOMENTUM),
        Form::AngularVelocity => system.view(t, y).angular_momentum,
    };
    (K, SlowState::unpack(y).pose(t))
}

impl Trajectory for SlowMotion<'_> {
    type State = [f64; SLOW_LENGTH];

    const ATTITUDE: usize = ATTITUDE;

    fn view(&mut self, t: f64, y: &[f64]) -> StateView {
        self.system.view(t, y)
    }

    fn angular_momentum(&mut self, t: f64, y: &[f64]) -> [f64; 3] {
        match self.system.form {
            Form::AngularMomentum => triple(y, MOMENTUM),
            Form::AngularVelocity => self.system.view(t, y).angular_momentum,
        }
    }

    fn position(&self, _: f64, y: &[f64], view: &StateView, _: [f64; 4]) -> Position {
        let motion = MotionState { omega: view.omega, q: &view.q, rate: &view.rate };
        match self.system.form {
            Form::AngularMomentum => Position::of_center(self.system.equations.system.body, motion, y),
            Form::AngularVelocity => Position::of_pole(self.system.equations.system.body, motion, y),
        }
    }

    fn invariant(&self) -> Invariant {
        match (self.system.equations.system.acts(), self.system.form) {
            (true, _) => Invariant::Impulse,
            (false, Form::AngularMomentum) => Invariant::AngularMomentum,
            (false, Form::AngularVelocity) => Invariant::Direction,
        }
    }

    fn left(&self, _: &[f64]) -> Option<Displaced> {
        self.system.equations.system.body.left_range(&self.slow.q)
    }

    fn enter(&mut self, stretch: Stretch, begins: bool) {
        let before = (begins && self.t > 0.0).then(|| self.point());
        self.system.stretch = stretch;
        if let Some(before) = before {
            let jump = Correction::between(&before, &self.point());
            self.summed += jump.vibration_energy(self.system.equations.system);
        }
        if !begins {
            return;
        }
        self.correct();
        let (K, pose) = place(&self.system, self.t, &self.y);
        let system = self.system.equations.system;
        if let Some(vibrations) = &mut self.vibrations {
            if self.t > 0.0 {
                vibrations.meet(system, K, &pose);
                vibrations.compare(system, K, self.t, &self.slow);
            } else {
                vibrations.begin(system, K, &pose, &self.slow);
            }
        }
    }

    fn stepped(&mut self, t: f64, y: &[f64]) {
        let before = (self.t, self.error_of_power);
        let start = self.vibrations.is_some().then(|| place(&self.system, self.t, &self.y));
        self.t = t;
        self.y.copy_from_slice(y);
        let from = self.correct();
        let system = self.system.equations.system;
        self.quick.follow(system, [&from, &self.last], t - before.0);
        self.largest = self.largest.max(self.quick.vibration_energy(system));
        self.summed += 0.5 * (t - before.0) * (before.1 + self.error_of_power);
        if let (Some(vibrations), Some(start)) = (&mut self.vibrations, start) {
            let end = place(&self.system, t, y);
            let K = end.0;
            vibrations.follow(system, [start, end], |t| self.system.stretch.within(t));
            vibrations.compare(system, K, t, &self.slow);
        }
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(&self.y);
        [self.t, self.error_of_power, self.largest, self.summed, self.load_ratio]
            .iter()
            .for_each(|value| checkpoint.save(*value));
        [&self.last, &self.quick].iter().for_each(|correction| correction.save(checkpoint));
        self.vibrations.iter().for_each(|vibrations| vibrations.save(checkpoint));
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        checkpoint.load_into(&mut self.y)?;
        let Self { t, error_of_power, largest, summed, load_ratio, .. } = self;
        for value in [t, error_of_power, largest, summed, load_ratio] {
            *value = checkpoint.load()?;
        }
        self.last.load(checkpoint)?;
        self.quick.load(checkpoint)?;
        self.vibrations.iter_mut().try_for_each(|vibrations| vibrations.load(checkpoint))
    }
}
