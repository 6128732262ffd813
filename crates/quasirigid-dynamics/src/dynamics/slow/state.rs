//! State of the slow motion under forces.
//! Equation (E2) and "Start", docs/theory/09-forced-reduction.md.

use super::equations::SlowEquations;
use super::flow::{SlowPoint, slow_point};
use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, PLACE, SLOW_LENGTH, VELOCITY, attitude, triple};
use crate::dynamics::run::PropagateError;

/// State of the slow motion: the angular momentum determines the internal coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlowState {
    /// Angular momentum (N·m·s), body axes: about the centre of mass of a free body, about the pole of a constrained one.
    pub angular_momentum: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a constrained one.
    pub place: [f64; 3],
    /// Velocity of that point (m/s).
    pub velocity: [f64; 3],
}

impl SlowState {
    /// State with the angular velocity `omega` (rad/s, body axes) on the slow manifold of order `p` at `t = 0` by the series along the flow;
    /// attitude, place and velocity are those of `self`. (E2)
    ///
    /// # Errors
    /// Those of [`SlowEquations::state`].
    pub fn with_spin(self, system: Forced, order: usize, omega: [f64; 3]) -> Result<Self, PropagateError> {
        SlowEquations::series(system, order).state(self, omega)
    }

    pub(super) fn pose(&self, t: f64) -> Pose<f64> {
        Pose { t, attitude: self.attitude, place: self.place, velocity: self.velocity }
    }

    pub(super) fn pack(&self) -> [f64; SLOW_LENGTH] {
        let mut y = [0.0; SLOW_LENGTH];
        y[MOMENTUM..MOMENTUM + 3].copy_from_slice(&self.angular_momentum);
        y[ATTITUDE..ATTITUDE + 4].copy_from_slice(&self.attitude);
        y[PLACE..PLACE + 3].copy_from_slice(&self.place);
        y[VELOCITY..VELOCITY + 3].copy_from_slice(&self.velocity);
        y
    }

    pub(super) fn unpack(y: &[f64]) -> Self {
        Self {
            angular_momentum: triple(y, MOMENTUM),
            attitude: attitude(y),
            place: triple(y, PLACE),
            velocity: triple(y, VELOCITY),
        }
    }
}

/// Slow motion of order `p` at a state, at `t = 0`. (E2)
///
/// # Errors
/// [`PropagateError::Order`] if the order is above [`MAX_FORCED_ORDER`](crate::dynamics::MAX_FORCED_ORDER).
pub fn slow_state_point(
    system: Forced,
    order: usize,
    state: &SlowState,
) -> Result<SlowPoint, PropagateError> {
    SlowEquations::series(system, order).check()?;
    Ok(slow_point(system, order, state.angular_momentum, &state.pose(0.0)))
}
