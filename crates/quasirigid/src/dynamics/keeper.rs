use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::conserved::Conserved;
use super::event::Alarm;
use super::layout::{
    ANGLE, ATTITUDE, DISSIPATED, IMPULSE, MOMENTUM, PLACE, VELOCITY, WORK, attitude, triple,
};
use super::run::{Observer, Options, Pace, Sample};
use crate::math::ode::{Solver, State, Watcher};
use crate::math::rotation::{self, Turn};
use crate::math::vec3::{add, norm, scale};
use crate::model::{Displaced, FlexibleBody, Motion as Placed};

/// A system whose state begins with the slow parts of [`layout`](super::layout).
pub(super) trait Motion {
    /// What a state means.
    fn look(&mut self, t: f64, y: &[f64]) -> Look;

    /// What is constant along the motion.
    fn invariant(&self) -> Invariant;

    /// The part that a state displaces beyond the range of the equations. (K14)
    fn left(&self, y: &[f64]) -> Option<Displaced> {
        let _ = y;
        None
    }
}

/// What a state means.
#[derive(Clone, Debug)]
pub(super) struct Look {
    /// Spin (rad/s), body axes.
    pub omega: [f64; 3],
    /// Momentum (N·m·s), body axes.
    pub momentum: [f64; 3],
    /// Energy of rotation and deformation (J).
    pub energy: f64,
    /// Internal coordinates and their rates.
    pub q: Vec<f64>,
    pub rate: Vec<f64>,
    /// Where it is.
    pub seat: Seat,
}

/// Where a body is, inertial axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat {
    /// Place (m) and velocity (m/s): of the centre of mass of a free body, of the pole of a held one.
    pub place: [f64; 3],
    pub velocity: [f64; 3],
    /// Place (m) and velocity (m/s) of the pole.
    pub pole: [f64; 3],
    pub pole_velocity: [f64; 3],
}

impl Seat {
    /// Of a state that holds the place of the centre of mass of a free body, of the pole of a held one. (P7)
    pub fn of_center(body: &FlexibleBody, motion: Placed<f64>, y: &[f64]) -> Self {
        let (place, velocity) = (triple(y, PLACE), triple(y, VELOCITY));
        let (offset, rate) = Self::pole_from_center(body, motion, y);
        Self { place, velocity, pole: add(place, offset), pole_velocity: add(velocity, rate) }
    }

    /// Of a state that holds the place of the pole. (P7)
    pub fn of_pole(body: &FlexibleBody, motion: Placed<f64>, y: &[f64]) -> Self {
        let (pole, pole_velocity) = (triple(y, PLACE), triple(y, VELOCITY));
        let (offset, rate) = Self::pole_from_center(body, motion, y);
        let (place, velocity) = (add(pole, scale(-1.0, offset)), add(pole_velocity, scale(-1.0, rate)));
        Self { place, velocity, pole, pole_velocity }
    }

    fn pole_from_center(body: &FlexibleBody, motion: Placed<f64>, y: &[f64]) -> ([f64; 3], [f64; 3]) {
        let turn = Turn::of(rotation::normalized(attitude(y)));
        let (offset, rate) = body.pole_from_center(motion);
        (turn.to_inertial(offset), turn.to_inertial(rate))
    }
}

/// What is constant along a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Invariant {
    /// The inertial momentum, of which the state holds the body components.
    Momentum,
    /// The inertial momentum, which the truncation disturbs.
    Direction,
    /// The inertial momentum less the impulse of the external moments.
    Impulse,
}

/// Keeps the invariants and the accounts of a run.
pub(super) struct Keeper<'o, F> {
    motion: F,
    /// Momentum at the start.
    momentum: Conserved,
    /// Energy at the start.
    energy: f64,
    /// `Σ ln(|K|/G)` of the projections made. (P6)
    drift: f64,
    pub alarm: Alarm,
    /// The part that has left the range of the equations, which ends the run.
    pub left: Option<Displaced>,
    observer: &'o mut dyn Observer,
    pace: Pace,
}

impl<'o, F: Motion> Keeper<'o, F> {
    /// From the first state, and the momentum that what turns inside has there (N·m·s).
    pub fn new(
        mut motion: F,
        y: &[f64],
        inside: [f64; 3],
        options: &Options,
        observer: &'o mut dyn Observer,
    ) -> Self {
        let start = motion.look(0.0, y);
        let K_N = rotation::to_inertial(attitude(y), start.momentum);
        let momentum = Conserved::new(K_N, norm(K_N), inside);
        let alarm = Alarm::new(&options.events);
        let mut keeper = Self {
            motion,
            momentum,
            energy: start.energy,
            drift: 0.0,
            alarm,
            left: None,
            observer,
            pace: Pace::new(),
        };
        let sample = keeper.sample(0.0, y);
        keeper.alarm.set(&sample);
        keeper
    }

    pub fn sample(&mut self, t: f64, y: &[f64]) -> Sample {
        let look = self.motion.look(t, y);
        self.read(t, y, &look)
    }

    fn read(&self, t: f64, y: &[f64], look: &Look) -> Sample {
        let (momentum, energy) = (look.momentum, look.energy);
        let attitude = self.aligned(y, momentum);
        let momentum_drift = match self.motion.invariant() {
            Invariant::Momentum if self.momentum.held() => self.drift,
            Invariant::Momentum | Invariant::Direction => self.momentum.change(momentum),
            Invariant::Impulse => {
                let K_N = self.momentum.K_N;
                let expected = add(K_N, triple(y, IMPULSE));
                let gap = norm(add(rotation::to_inertial(attitude, momentum), scale(-1.0, expected)));
                if gap > 0.0 { gap / norm(expected).max(norm(K_N)) } else { gap }
            }
        };
        Sample {
            t,
            omega: look.omega,
            attitude,
            momentum,
            energy,
            dissipated: y[DISSIPATED],
            work: y[WORK],
            energy_drift: energy - self.energy + y[DISSIPATED] - y[WORK],
            momentum_drift,
            turns: y[ANGLE] / TAU,
            place: look.seat.place,
            velocity: look.seat.velocity,
            pole: look.seat.pole,
        }
    }

    /// The attitude that gives the momentum its inertial direction where that is known (P3); a unit one elsewhere.
    fn aligned(&self, y: &[f64], momentum: [f64; 3]) -> [f64; 4] {
        let attitude = attitude(y);
        match self.motion.invariant() {
            Invariant::Momentum | Invariant::Direction => self.momentum.aligned(attitude, momentum),
            Invariant::Impulse => rotation::normalized(attitude),
        }
    }

    /// Puts `|K|` back to its value (P6) and the attitude where it belongs (P3).
    fn hold_invariants<M: Solver>(&mut self, solver: &mut M) {
        let y = solver.y().as_ref();
        let mut change = solver.y().zeroed();
        let momentum = match self.motion.invariant() {
            Invariant::Momentum => {
                let K = triple(y, MOMENTUM);
                if self.momentum.held() {
                    let drift = self.momentum.drift(K);
                    self.drift += drift;
                    for axis in 0..3 {
                        change.as_mut()[MOMENTUM + axis] = -drift * K[axis];
                    }
                }
                K
            }
            Invariant::Direction => self.motion.look(solver.t(), y).momentum,
            Invariant::Impulse => [0.0; 3],
        };
        for (i, part) in self.aligned(y, momentum).into_iter().enumerate() {
            change.as_mut()[ATTITUDE + i] = part - y[ATTITUDE + i];
        }
        solver.correct(&change);
    }
}

impl<M: Solver, F: Motion> Watcher<M> for Keeper<'_, F> {
    fn output(&mut self, t: f64, y: &M::State) {
        let look = self.motion.look(t, y.as_ref());
        let sample = self.read(t, y.as_ref(), &look);
        self.observer.coordinates(&look.q, &look.rate);
        self.observer.sample(&sample);
    }

    fn event(&mut self, solver: &mut M) -> Option<f64> {
        if self.alarm.idle() {
            return None;
        }
        let mut alarm = std::mem::take(&mut self.alarm);
        let end = self.sample(solver.t(), solver.y().as_ref());
        let mut dense = None;
        let event = alarm.check(&end, |t| {
            let dense = dense.get_or_insert_with(|| solver.dense());
            self.sample(t, dense.at(t).as_ref())
        });
        self.alarm = alarm;
        event
    }

    fn stepped(&mut self, solver: &mut M) -> ControlFlow<()> {
        self.hold_invariants(solver);
        self.left = self.motion.left(solver.y().as_ref());
        if self.left.is_some() {
            return ControlFlow::Break(());
        }
        if self.pace.due(solver.work().steps) {
            self.observer.progress(solver.t())
        } else {
            ControlFlow::Continue(())
        }
    }
}
