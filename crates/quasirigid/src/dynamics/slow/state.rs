//! State of the slow motion under forces, and the angular momentum that belongs to a given angular velocity.
//! The iteration stops where it no longer gains, not at a fixed tolerance: near the limit of the series each step gains little.
//! Equation (E2) and "Start", docs/theory/09-forced-reduction.md.

use super::flow::{MAX_FORCED_ORDER, SlowPoint, slow_point};
use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, PLACE, SLOW, VELOCITY, attitude, triple};
use crate::dynamics::run::PropagateError;
use crate::math::sym3::times;
use crate::math::vec3::{add, norm, scale};

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

/// Limit of iterations for the angular momentum; each gains the ratio of elastic to rigid angular momentum.
const ITERATIONS: usize = 60;

impl SlowState {
    /// State with the angular velocity `omega` (rad/s, body axes) on the slow manifold of order `p` at `t = 0`; attitude, place and
    /// velocity are those of `self`.
    ///
    /// # Errors
    /// [`PropagateError::Order`], [`PropagateError::NoForce`] if a force has no value there, or [`PropagateError::NoAngularMomentum`] if
    /// the slow manifold has no such angular velocity.
    pub fn with_spin(self, system: Forced, order: usize, omega: [f64; 3]) -> Result<Self, PropagateError> {
        let J = system.body.invariants().J;
        let angular_momentum = add(times(J, omega), system.body.wheels().angular_momentum(0.0));
        let mut state = Self { angular_momentum, ..self };
        let mut best = f64::INFINITY;
        // Of a body at rest: what its parts would turn it by.
        let mut size = norm(omega);
        for _ in 0..ITERATIONS {
            let point = slow_state_point(system, order, &state)?;
            if !best.is_finite() && system.acts() && !norm(point.omega).is_finite() {
                return Err(PropagateError::NoForce); // at the first guess the series is that of a spin all but the one asked for
            }
            let gap = add(omega, scale(-1.0, point.omega));
            if !best.is_finite() {
                size = size.max(norm(gap));
            }
            if norm(gap) >= 0.9 * best {
                break;
            }
            best = norm(gap);
            if best <= 1e-15 * size {
                break;
            }
            state.angular_momentum = add(state.angular_momentum, times(J, gap));
        }
        let near = best <= 1e-10 * size;
        if near && state.angular_momentum.iter().all(|K| K.is_finite()) {
            Ok(state)
        } else {
            Err(PropagateError::NoAngularMomentum)
        }
    }

    pub(super) fn pose(&self, t: f64) -> Pose<f64> {
        Pose { t, attitude: self.attitude, place: self.place, velocity: self.velocity }
    }

    pub(super) fn pack(&self) -> [f64; SLOW] {
        let mut y = [0.0; SLOW];
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
/// [`PropagateError::Order`] if the order is above [`MAX_FORCED_ORDER`].
pub fn slow_state_point(
    system: Forced,
    order: usize,
    state: &SlowState,
) -> Result<SlowPoint, PropagateError> {
    if order > MAX_FORCED_ORDER {
        return Err(PropagateError::Order { order });
    }
    Ok(slow_point(system, order, state.angular_momentum, &state.pose(0.0)))
}
