//! Motion of the reduced equations under forces, with the energy that vibrations excited by the forces take from it.
//! Equation (E5), docs/theory/09-forced-reduction.md.

use super::flow::{SlowPoint, error_of_power, slow_point, vibration_energy};
use super::state::SlowState;
use super::system::SlowSystem;
use crate::dynamics::external::Pose;
use crate::dynamics::form::Form;
use crate::dynamics::invariant_monitor::{Invariant, StateView, Trajectory};
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, SLOW, triple};
use crate::dynamics::seat::Seat;
use crate::math::ode::{Checkpoint, Stretch};
use crate::model::MotionState;

/// Motion of the reduced equations, and the error of what they dissipate.
pub(super) struct SlowMotion<'a> {
    system: SlowSystem<'a>,
    /// Last state that a step has reached, its time (s), and the error of the power (W) there.
    y: [f64; SLOW],
    t: f64,
    error_of_power: f64,
    /// Energy (J) of excited vibrations, and of what the series leaves out of the dissipated one. (E5)
    pub left_out: f64,
}

impl<'a> SlowMotion<'a> {
    /// From the first state.
    pub fn new(system: SlowSystem<'a>, y: &[f64; SLOW]) -> Self {
        let mut motion = Self { system, y: *y, t: 0.0, error_of_power: 0.0, left_out: 0.0 };
        motion.error_of_power = motion.error();
        motion
    }

    /// Angular momentum (N·m·s) and pose of the last state, at the limit of the time inside the stretch.
    fn place(&self) -> ([f64; 3], Pose<f64>) {
        let t = self.system.stretch.within(self.t);
        let K = match self.system.form {
            Form::AngularMomentum => triple(&self.y, MOMENTUM),
            Form::AngularVelocity => self.system.view(t, &self.y).angular_momentum,
        };
        (K, SlowState::unpack(&self.y).pose(t))
    }

    fn error(&self) -> f64 {
        let (K, pose) = self.place();
        error_of_power(self.system.system, self.system.order, K, &pose)
    }

    fn point(&self) -> SlowPoint {
        let (K, pose) = self.place();
        slow_point(self.system.system, self.system.order, K, &pose)
    }
}

impl Trajectory for SlowMotion<'_> {
    type State = [f64; SLOW];

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

    fn seat(&self, _: f64, y: &[f64], view: &StateView, _: [f64; 4]) -> Seat {
        let motion = MotionState { omega: view.omega, q: &view.q, rate: &view.rate };
        match self.system.form {
            Form::AngularMomentum => Seat::of_center(self.system.system.body, motion, y),
            Form::AngularVelocity => Seat::of_pole(self.system.system.body, motion, y),
        }
    }

    fn invariant(&self) -> Invariant {
        match (self.system.system.acts(), self.system.form) {
            (true, _) => Invariant::Impulse,
            (false, Form::AngularMomentum) => Invariant::AngularMomentum,
            (false, Form::AngularVelocity) => Invariant::Direction,
        }
    }

    fn enter(&mut self, stretch: Stretch, begins: bool) {
        let before = (begins && self.t > 0.0).then(|| self.point());
        self.system.stretch = stretch;
        if let Some(before) = before {
            self.left_out += vibration_energy(self.system.system, &before, &self.point());
        }
        if begins {
            self.error_of_power = self.error();
        }
    }

    fn stepped(&mut self, t: f64, y: &[f64]) {
        let before = (self.t, self.error_of_power);
        self.t = t;
        self.y.copy_from_slice(y);
        self.error_of_power = self.error();
        self.left_out += 0.5 * (t - before.0) * (before.1 + self.error_of_power);
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(&self.y);
        [self.t, self.error_of_power, self.left_out].iter().for_each(|value| checkpoint.save(*value));
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        checkpoint.load_into(&mut self.y)?;
        for value in [&mut self.t, &mut self.error_of_power, &mut self.left_out] {
            *value = checkpoint.load()?;
        }
        Some(())
    }
}
