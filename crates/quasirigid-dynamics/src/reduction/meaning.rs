//! Condition for a start on the slow manifold: its series and the state from its series are one motion, and a small one.
//! A truncated series always has a value; only the state itself tells whether the value means anything.
//! Equation (Q8), docs/theory/16-methods.md.

use crate::math::sym3::times;
use crate::math::vec3::{add, norm, scale};
use crate::model::{FlexibleBody, MotionState, ReducedBody};

/// Largest difference between the angular momentum of the series and that of the state from the series, relative to `|Jω|`, and between
/// the angular velocity of an angular momentum and that which has it. (Q8)
const MEANINGFUL: f64 = 1e-2;
/// Largest angular momentum of the rates of cyclic coordinates relative to `|Jω|` for the series to be small: that at which spin against
/// friction fails, `τ|ω| = ½`, where the whole body turned inside. (Q8)
const SMALL_INTERNAL_MOMENTUM: f64 = 0.5;

/// True if the slow manifold of a reduced body has a meaning at an angular velocity (rad/s): the state from its series has the angular
/// momentum of its series, the rates of rotors and liquids are small in it, and `ω(K(ω)) = ω`. (Q8)
#[must_use]
pub fn manifold_has_meaning(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> bool {
    let (q, rate) = (reduced.q.value(omega), reduced.rate.value(omega));
    let said = reduced.angular_momentum(omega);
    let gap = gap(body, MotionState { omega, q: &q, rate: &rate }, said);
    let back = add(reduced.angular_velocity(said), scale(-1.0, omega));
    gap <= MEANINGFUL * norm(times(body.invariants().J, omega))
        && is_slow(body, omega, &rate)
        && norm(back) <= MEANINGFUL * norm(omega)
}

/// True if a state on the slow manifold of a forced body has the angular momentum (N·m·s) of its series, and the rates of its rotors and
/// liquids are small. (Q8)
#[must_use]
pub fn state_has_meaning(body: &FlexibleBody, motion: MotionState<f64>, said: [f64; 3]) -> bool {
    let whole = norm(times(body.invariants().J, motion.omega)).max(norm(said));
    gap(body, motion, said) <= MEANINGFUL * whole && is_slow(body, motion.omega, motion.rate)
}

/// Difference (N·m·s) between the angular momentum of a state, that of wheels included, and another one.
fn gap(body: &FlexibleBody, motion: MotionState<f64>, said: [f64; 3]) -> f64 {
    let K = add(body.angular_momentum(motion), body.wheels().angular_momentum(0.0));
    norm(add(said, scale(-1.0, K)))
}

/// Whether the rates of cyclic coordinates carry a small angular momentum; of a body that does not turn, none.
fn is_slow(body: &FlexibleBody, omega: [f64; 3], rate: &[f64]) -> bool {
    let h = &body.invariants().h;
    let carried = body.cyclic().fold([0.0; 3], |sum, j| add(sum, scale(rate[j], h[j])));
    norm(carried) <= SMALL_INTERNAL_MOMENTUM * norm(times(body.invariants().J, omega))
}
