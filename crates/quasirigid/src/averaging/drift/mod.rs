//! Rotation under slow torques, averaged: energy and angular momentum both drift.

mod ending;
mod follow;
mod rates;
mod region_choice;

use std::sync::Arc;

use super::evolution::Stage;
use super::power::MeanPower;
use super::slow_torque::SlowTorque;
use crate::model::Principal;

pub use ending::{DriftEnding, DriftHistory};
pub use region_choice::SeparatrixPassage;

/// Secular evolution of a rotation under a slow torque: energy and angular momentum both drift. (A8)
#[derive(Clone, Copy, Debug)]
pub struct Drift<P = Arc<dyn MeanPower>> {
    power: P,
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
    /// The stage at the angular momentum reached; `ξ = ∞` where the wobble has died out.
    pub stage: Stage,
    /// Angular momentum `G` (N·m·s).
    pub momentum: f64,
    /// Side of the circled axis that the angular momentum is on, ±1.
    pub side: f64,
    /// Turns about the angular momentum since the start.
    pub turns: f64,
}

/// How far a drift is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftLimits {
    /// Last time (s).
    pub end: f64,
    /// Stage whose `D/I₃` ends the drift, from whichever side it is reached.
    pub target: Option<Stage>,
    /// Share of the first angular momentum below which the body counts as at rest.
    pub rest: f64,
    /// Rate (rad/s) about the angular momentum, `2E/G`, above which the average does not hold, as the slowest elastic frequency.
    pub fastest: f64,
    /// Steps of the integration at most.
    pub steps: u64,
}

/// Share of the angular momentum that counts as rest, unless the caller says otherwise.
const REST: f64 = 1e-9;
/// Steps, unless the caller says otherwise: a passage takes some hundreds.
const STEPS: u64 = 100_000;

impl DriftLimits {
    /// To a time (s), whatever happens before; a billionth of the angular momentum counts as rest.
    #[must_use]
    pub fn until(end: f64) -> Self {
        Self { end, target: None, rest: REST, fastest: f64::INFINITY, steps: STEPS }
    }
}

impl<P: MeanPower> Drift<P> {
    /// The drift of a free body with these principal axes.
    #[must_use]
    pub fn new(power: P, principal: &Principal, torque: SlowTorque) -> Self {
        let constant = principal.components(torque.constant);
        Self { power, moments: principal.moments, constant, drag: torque.drag }
    }
}
