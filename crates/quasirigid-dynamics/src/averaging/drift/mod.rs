//! Rotation under slow torques, averaged: energy and angular momentum both drift.

mod eddy;
mod follow;
mod rates;
mod region_choice;
mod stop_reason;

use std::sync::Arc;

use super::evolution::RotationState;
use super::power::MeanPower;
use super::slow_torque::SlowTorque;
use crate::model::{Mode, Principal};
use eddy::MeanEddy;

pub use region_choice::SeparatrixPassage;
pub use stop_reason::{DriftHistory, DriftStopReason};

/// Secular evolution of a rotation under a slow torque: energy and angular momentum both drift. (A8)
#[derive(Clone, Debug)]
pub struct Drift<P = Arc<dyn MeanPower>> {
    power: P,
    moments: [f64; 3],
    /// Constant torque in principal axes.
    constant: [f64; 3],
    drag: f64,
    eddy: Option<MeanEddy>,
}

/// A drifting rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftState {
    /// Time (s).
    pub t: f64,
    /// Rotation state at the angular momentum reached; `ξ = ∞` where the wobble has died out.
    pub rotation_state: RotationState,
    /// Angular momentum `G` (N·m·s).
    pub angular_momentum: f64,
    /// Side of the circled axis that the angular momentum is on, ±1.
    pub side: f64,
    /// Direction of the angular momentum, a unit vector in inertial axes: eddy currents turn it. (A15)
    pub direction: [f64; 3],
    /// Revolutions about the angular momentum since the start.
    pub revolutions: f64,
}

/// Limits of the integration of a drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftLimits {
    /// Last time (s).
    pub end: f64,
    /// Rotation state whose `D/I₃` ends the drift, reached from either side.
    pub target: Option<RotationState>,
    /// Share of the first angular momentum below which the body counts as at rest.
    pub rest: f64,
    /// Rate (rad/s) about the angular momentum, `2E/G`, above which the average does not hold: the slowest elastic frequency, for one.
    pub fastest: f64,
    /// Rate (rad/s) about the angular momentum below which the average does not hold: some times that of a magnetic field.
    pub slowest: f64,
    /// Steps of the integration at most.
    pub steps: u64,
}

/// Default share of the angular momentum that counts as rest: drag never takes all of it.
const REST: f64 = 1e-9;
/// Default limit of steps: a passage takes some hundreds.
const MAX_STEPS: u64 = 100_000;

impl DriftLimits {
    /// Limits with a last time (s) and no target; a billionth of the angular momentum counts as rest.
    #[must_use]
    pub fn until(end: f64) -> Self {
        Self { end, target: None, rest: REST, fastest: f64::INFINITY, slowest: 0.0, steps: MAX_STEPS }
    }
}

impl<P: MeanPower> Drift<P> {
    /// The drift of a free body with these principal axes.
    #[must_use]
    pub fn new(power: P, principal: &Principal, torque: SlowTorque) -> Self {
        let constant = principal.components(torque.constant);
        let [.., greatest] = principal.moments;
        let moments = if Mode::any_exists(principal.moments) { principal.moments } else { [greatest; 3] };
        let eddy = torque.eddy.map(|eddy| MeanEddy::new(&eddy, principal));
        Self { power, moments, constant, drag: torque.drag, eddy }
    }
}
