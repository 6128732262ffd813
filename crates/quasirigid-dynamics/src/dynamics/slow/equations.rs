//! Slow equations under forces: the series along the flow, its torque-free part replaced by the energy form, which no cut-off of a series
//! lets gain energy.
//! The iteration for a spin stops where it no longer gains, not at a fixed tolerance: near the limit of the series each step gains little.
//! Equations (E2), (E6) and "Start", docs/theory/09-forced-reduction.md.

use super::flow::{MAX_FORCED_ORDER, SlowPoint, free_point, rests, slow_point};
use super::state::SlowState;
use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::run::PropagateError;
use crate::math::sym3::times;
use crate::math::vec3::{add, norm, scale};
use crate::model::force::Loads;
use crate::model::{FlexibleBody, Form, ReducedBody};

/// Slow equations of a body under forces: the series along the flow (E2), or the energy form of the torque-free body with what forces
/// change (E6).
#[derive(Clone, Copy, Debug)]
pub struct SlowEquations<'a> {
    pub(super) system: Forced<'a>,
    pub(super) order: usize,
    free: Option<&'a ReducedBody>,
    /// Whether all forces are functions of the time alone.
    prescribed: bool,
}

/// Slow motion at a state.
pub(super) struct SlowFlow {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Energy (J), without that of wheels.
    pub energy: f64,
    /// Power (W) that dissipators take.
    pub power: f64,
    /// Internal coordinates and loads, by the series along the flow.
    pub point: SlowPoint,
}

impl SlowFlow {
    fn of_series(body: &FlexibleBody, point: SlowPoint) -> Self {
        let power = body.damping().quadratic(&point.rate);
        Self { omega: point.omega, energy: body.energy(point.motion()), power, point }
    }
}

/// Limit of iterations for the angular momentum; each gains the ratio of elastic to rigid angular momentum.
const ITERATIONS: usize = 60;

impl<'a> SlowEquations<'a> {
    /// Series of order `p` along the flow. (E2)
    #[must_use]
    pub fn series(system: Forced<'a>, order: usize) -> Self {
        Self::energy_form(system, order, None)
    }

    /// Energy form of the torque-free body with what forces change by the series of order `p` along the flow. `reduced` is of
    /// [`torque_free_order`](Self::torque_free_order) or higher; without it the series stands alone. (E6)
    #[must_use]
    pub fn energy_form(system: Forced<'a>, order: usize, reduced: Option<&'a ReducedBody>) -> Self {
        Self { system, order, free: reduced, prescribed: system.is_prescribed() }
    }

    /// Order of the energy form beside a series of order `p`: one above, by which the torque-free part is as good as that of the series,
    /// whose inertia tensor is not cut off. None where the series stands alone: of the rigid body, in the angular-velocity form, and where
    /// motors change the angular momentum of wheels, on which the torque-free motion depends. (E6)
    #[must_use]
    pub fn torque_free_order(system: Forced, form: Form, order: usize) -> Option<usize> {
        let steady = system.body.wheels().driven.is_empty();
        (order > 0 && form == Form::AngularMomentum && steady).then_some(order + 1)
    }

    /// Slow motion at an angular momentum (N·m·s, body axes) and a pose. (E2), (E6)
    pub(super) fn at(&self, K: [f64; 3], pose: &Pose<f64>) -> SlowFlow {
        let body = self.system.body;
        let acted = SlowFlow::of_series(body, slow_point(self.system, self.order, K, pose));
        let Some(reduced) = self.free else { return acted };
        let series = SlowFlow::of_series(body, free_point(self.system, self.order, K, pose));
        let lawful = reduced.motion(K);
        SlowFlow {
            omega: add(lawful.omega, add(acted.omega, scale(-1.0, series.omega))),
            energy: reduced.energy_of_momentum.scalar(K) + (acted.energy - series.energy),
            power: lawful.power + (acted.power - series.power),
            point: acted.point,
        }
    }

    /// The same for rates alone: while forces by the time are zero, that of the energy form, with the internal coordinates at zero. (E6)
    pub(super) fn for_rates(&self, K: [f64; 3], pose: &Pose<f64>) -> SlowFlow {
        let Some(reduced) = self.free.filter(|_| self.prescribed && rests(self.system, pose)) else {
            return self.at(K, pose);
        };
        let n = self.system.body.coordinates().len();
        let lawful = reduced.motion(K);
        let omega = lawful.omega;
        let point = SlowPoint { omega, q: vec![0.0; n], rate: vec![0.0; n], loads: Loads::none(n) };
        SlowFlow { omega, energy: reduced.energy_of_momentum.scalar(K), power: lawful.power, point }
    }

    /// Angular velocity (rad/s, body axes) at a state, at `t = 0`.
    ///
    /// # Errors
    /// [`PropagateError::Order`] if the order is above [`MAX_FORCED_ORDER`].
    pub fn angular_velocity(&self, state: &SlowState) -> Result<[f64; 3], PropagateError> {
        self.check()?;
        Ok(self.at(state.angular_momentum, &state.pose(0.0)).omega)
    }

    pub(super) fn check(&self) -> Result<(), PropagateError> {
        if !self.system.body.drives().is_empty() {
            return Err(PropagateError::Driven);
        }
        if self.order > MAX_FORCED_ORDER {
            return Err(PropagateError::Order { order: self.order });
        }
        Ok(())
    }

    /// State with the angular velocity `omega` (rad/s, body axes) at `t = 0`; attitude, place and velocity are those of `still`.
    ///
    /// # Errors
    /// [`PropagateError::Order`], [`PropagateError::NoForce`] if a force has no value there, or [`PropagateError::NoAngularMomentum`] if
    /// the slow manifold has no such angular velocity.
    pub fn state(&self, still: SlowState, omega: [f64; 3]) -> Result<SlowState, PropagateError> {
        let body = self.system.body;
        let J = body.invariants().J;
        let angular_momentum = add(times(J, omega), body.wheels().angular_momentum(0.0));
        let mut state = SlowState { angular_momentum, ..still };
        let mut best = f64::INFINITY;
        // Of a body at rest: what its parts would turn it by.
        let mut size = norm(omega);
        for _ in 0..ITERATIONS {
            let found = self.angular_velocity(&state)?;
            if !best.is_finite() && self.system.acts() && !norm(found).is_finite() {
                return Err(PropagateError::NoForce); // at the first guess the series is that of a spin all but the one asked for
            }
            let gap = add(omega, scale(-1.0, found));
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
}
