use std::f64::consts::TAU;

use super::evolution::Stage;
use super::poinsot::FreeRotation;
use super::power::MeanPower;
use super::slow_torque::SlowTorque;
use crate::math::ode::{Dop853, Solver, StepError, System};
use crate::math::simd::{Arithmetic, Plain};
use crate::math::sym::{add, dot, scale};
use crate::model::{Mode, Principal};

/// Ageing of a rotation under a slow torque: energy and momentum both drift. (A8)
pub struct Drift<'a> {
    power: &'a dyn MeanPower,
    moments: [f64; 3],
    /// Constant torque in principal axes.
    constant: [f64; 3],
    drag: f64,
}

/// A drifting rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftState {
    /// Time (s).
    pub t: f64,
    /// The stage at the angular momentum reached.
    pub stage: Stage,
    /// Angular momentum `G` (N·m·s).
    pub momentum: f64,
    /// Side of the circled axis that the momentum is on, ±1.
    pub side: f64,
    /// Turns about the angular momentum since the start.
    pub turns: f64,
}

/// How a drift ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DriftEnding {
    /// The last time was reached.
    Finished,
    /// The torque holds the rotation at the separatrix: it is driven there from both sides.
    Held,
    /// No step could be made.
    Failed(StepError),
}

/// Error allowed per step, in `ξ` and in the logarithm of `G`.
const TOLERANCE: f64 = 1e-10;
/// Distance from the separatrix, as `ξ`, where the rotation passes to the other side: `e^{−25}` of a time is left out.
const SEPARATRIX: f64 = -25.0;

impl<'a> Drift<'a> {
    /// The drift of a free body with these principal axes.
    #[must_use]
    pub fn new(power: &'a dyn MeanPower, principal: &Principal, torque: SlowTorque) -> Self {
        let constant = principal.components(torque.constant);
        Self { power, moments: principal.moments, constant, drag: torque.drag }
    }

    /// Follows the drift from a state and gives the states at ascending times (s). Through the separatrix towards either
    /// axis both sides are equally likely; the positive one is followed.
    #[must_use]
    pub fn follow(&self, start: DriftState, times: &[f64]) -> (Vec<DriftState>, DriftEnding) {
        let mut states = Vec::with_capacity(times.len());
        let mut from = start;
        loop {
            let rates = self.rates(&from);
            let y = [from.stage.xi, 0.0, from.turns];
            let mut solver =
                Dop853::<_, _, Plain>::new(rates, from.t, y, [TOLERANCE, TOLERANCE, f64::INFINITY]);
            let state = |t: f64, y: &[f64; 3]| DriftState {
                t,
                stage: Stage { mode: from.stage.mode, xi: y[0] },
                momentum: from.momentum * y[1].exp(),
                side: from.side,
                turns: y[2],
            };
            let crossed = loop {
                while times.get(states.len()).is_some_and(|t| *t <= solver.t()) {
                    let t = times[states.len()];
                    let y = if t < solver.t() { solver.dense().at(t) } else { *solver.y() };
                    states.push(state(t, &y));
                }
                if states.len() == times.len() {
                    return (states, DriftEnding::Finished);
                }
                if let Err(error) = solver.step(times[times.len() - 1]) {
                    return (states, DriftEnding::Failed(error));
                }
                if solver.y()[0] < SEPARATRIX {
                    break state(solver.t(), solver.y());
                }
            };
            let mode = match crossed.stage.mode {
                Mode::ShortAxis => Mode::LongAxis,
                Mode::LongAxis => Mode::ShortAxis,
            };
            from = DriftState { stage: Stage { mode, xi: SEPARATRIX }, side: 1.0, ..crossed };
            let onward = self.rates(&from).at(from.stage.xi, from.momentum);
            if onward[0] <= 0.0 {
                return (states, DriftEnding::Held);
            }
        }
    }

    fn rates(&self, from: &DriftState) -> Rates<'_, 'a> {
        Rates { drift: self, mode: from.stage.mode, side: from.side, momentum: from.momentum }
    }
}

/// Rates of `ξ`, of the logarithm of `G`, and of the turns, in one mode.
struct Rates<'d, 'a> {
    drift: &'d Drift<'a>,
    mode: Mode,
    side: f64,
    /// Angular momentum that the logarithm is counted from.
    momentum: f64,
}

impl System<[f64; 3]> for Rates<'_, '_> {
    fn rate<R: Arithmetic>(&mut self, _: f64, y: &[f64; 3], rate: &mut [f64; 3]) {
        *rate = self.at(y[0], self.momentum * y[1].exp());
    }
}

impl Rates<'_, '_> {
    /// The rates at a place and an angular momentum. (A8)
    fn at(&self, xi: f64, G: f64) -> [f64; 3] {
        let Drift { moments, constant, drag, .. } = self.drift;
        let motion = FreeRotation::at_logit(*moments, G, self.mode, xi);
        let axis = self.mode.circled();
        let mut torque = [0.0; 3];
        torque[axis] = self.side * constant[axis];
        // Torque along the momentum, and what it gives to the wobble: `±M·(ω − K/I)` with the moment of the circled axis.
        let along = |omega: [f64; 3]| {
            let K = [0, 1, 2].map(|i| moments[i] * omega[i]);
            dot(add(torque, scale(-drag, omega)), K) / G
        };
        let away = |omega: [f64; 3]| {
            let sum: f64 = (0..3).map(|i| (1.0 - moments[i] / moments[axis]) * omega[i] * omega[i]).sum();
            -drag * sum
        };
        let growth = motion.mean(2, along) / G;
        let work = motion.mean(2, away);
        let power = self.drift.power.mean_power(&motion);
        let gain = match self.mode {
            Mode::ShortAxis => work - power,
            Mode::LongAxis => power - work,
        };
        let excess = gain / motion.energy_from_axis() - 2.0 * growth;
        [-excess / self.slope(xi), growth, 2.0 * motion.energy() / (G * TAU)]
    }

    /// `−d ln(X/G²)/dξ` for the energy `X` of the wobble.
    fn slope(&self, xi: f64) -> f64 {
        let [I1, I2, I3] = self.drift.moments;
        let to_axis = 1.0 / (1.0 + xi.exp());
        let to_separatrix = 1.0 / (1.0 + (-xi).exp());
        let bend = match self.mode {
            Mode::ShortAxis => (I3 - I2) * to_axis / (I3 - (I3 - I2) * to_axis),
            Mode::LongAxis => -(I2 - I1) * to_axis / (I1 + (I2 - I1) * to_axis),
        };
        to_separatrix * (1.0 + bend)
    }
}
