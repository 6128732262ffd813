//! Motion of the reduced equations under forces, with the energy that vibrations excited by the forces take from it.
//! Equation (E5), docs/theory/09-forced-reduction.md.

use super::flow::{Correction, SlowPoint, slow_point};
use super::state::SlowState;
use super::system::SlowSystem;
use crate::dynamics::external::Pose;
use crate::dynamics::invariant_monitor::{Invariant, StateView, Trajectory};
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, SLOW_LENGTH, triple};
use crate::dynamics::position::Position;
use crate::math::ode::{Checkpoint, Stretch};
use crate::model::{Form, MotionState};

/// Share of the energy of a correction that comes and goes: the vibrations of both its ends may add. (E5)
const BOTH_ENDS: f64 = 4.0;

/// Motion of the reduced equations, and the error of what they dissipate.
pub(super) struct SlowMotion<'a> {
    system: SlowSystem<'a>,
    /// Last state that a step has reached, its time (s), and the error of the power (W) there.
    y: [f64; SLOW_LENGTH],
    t: f64,
    error_of_power: f64,
    /// Last correction, what corrections have changed by within a vibration, and the largest energy (J) of that.
    last: Correction,
    quick: Correction,
    largest: f64,
    /// Energy (J) of the vibrations from jumps, and of what the series leaves out of the dissipated one.
    summed: f64,
}

impl<'a> SlowMotion<'a> {
    /// From the first state.
    pub fn new(system: SlowSystem<'a>, y: &[f64; SLOW_LENGTH]) -> Self {
        let last = correction(&system, 0.0, y);
        let error_of_power = last.error_of_power(system.equations.system);
        let quick = Correction::none(system.equations.system.body.coordinates().len());
        Self { system, y: *y, t: 0.0, error_of_power, last, quick, largest: 0.0, summed: 0.0 }
    }

    /// Energy (J) of excited vibrations, and of what the series leaves out of the dissipated one. (E5)
    pub fn left_out(&self) -> f64 {
        self.summed + BOTH_ENDS * self.largest
    }

    fn point(&self) -> SlowPoint {
        let (K, pose) = place(&self.system, self.t, &self.y);
        slow_point(self.system.equations.system, self.system.equations.order, K, &pose)
    }

    /// Takes the correction at the state as the last one.
    fn correct(&mut self) -> Correction {
        let correction = correction(&self.system, self.t, &self.y);
        self.error_of_power = correction.error_of_power(self.system.equations.system);
        std::mem::replace(&mut self.last, correction)
    }
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

fn correction(system: &SlowSystem, t: f64, y: &[f64]) -> Correction {
    let (K, pose) = place(system, t, y);
    Correction::at(system.equations.system, system.equations.order, K, &pose)
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

    fn enter(&mut self, stretch: Stretch, begins: bool) {
        let before = (begins && self.t > 0.0).then(|| self.point());
        self.system.stretch = stretch;
        if let Some(before) = before {
            let jump = Correction::between(&before, &self.point());
            self.summed += jump.vibration_energy(self.system.equations.system);
        }
        if begins {
            self.correct();
        }
    }

    fn stepped(&mut self, t: f64, y: &[f64]) {
        let before = (self.t, self.error_of_power);
        self.t = t;
        self.y.copy_from_slice(y);
        let from = self.correct();
        let system = self.system.equations.system;
        self.quick.follow(system, [&from, &self.last], t - before.0);
        self.largest = self.largest.max(self.quick.vibration_energy(system));
        self.summed += 0.5 * (t - before.0) * (before.1 + self.error_of_power);
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(&self.y);
        [self.t, self.error_of_power, self.largest, self.summed]
            .iter()
            .for_each(|value| checkpoint.save(*value));
        [&self.last, &self.quick].iter().for_each(|correction| correction.save(checkpoint));
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        checkpoint.load_into(&mut self.y)?;
        for value in [&mut self.t, &mut self.error_of_power, &mut self.largest, &mut self.summed] {
            *value = checkpoint.load()?;
        }
        self.last.load(checkpoint)?;
        self.quick.load(checkpoint)
    }
}
