//! Full and reduced states from a start: without displacement, or with the angular momentum of another state.
//!
//! The slow manifold of a body is in `verification` ([`Start::settled`]) and a wobble in `secular` ([`Start::wobbling`]), which may
//! use a reduction and the closed form of torque-free rotation.

use super::full::FullState;
use super::run::Start;
use crate::model::{FlexibleBody, ReducedBody};

impl Start {
    /// Full state with this angular velocity and no displacement: elastic parts at rest in their equilibrium.
    #[must_use]
    pub fn at_rest(&self, body: &FlexibleBody) -> FullState {
        let Self { omega, attitude, place, velocity } = *self;
        FullState { place, velocity, ..FullState::at_rest(body, omega, attitude) }
    }

    /// Reduced start with the angular momentum of a full state, `ω = ω(K)`. (R17)
    #[must_use]
    pub fn matched(reduced: &ReducedBody, body: &FlexibleBody, full: &FullState) -> Self {
        let FullState { attitude, place, velocity, .. } = *full;
        Self { omega: reduced.angular_velocity(full.angular_momentum(body)), attitude, place, velocity }
    }
}
