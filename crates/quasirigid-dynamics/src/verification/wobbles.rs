//! Rate and frequency of a small wobble about a steady spin: the reduced equations against the modes of the full system.
//! Equation (V12), docs/theory/04-validity.md.

use crate::dynamics::{SteadySpin, steady_spin_near};
use crate::math::vec3::dot;
use crate::model::{Principal, ReducedBody};
use crate::modes::SpinModes;

/// Share of the eigenvalue below which a rate is rounding, in both systems.
const RATE_ROUNDING: f64 = 1e-14;

/// Relative difference between a small wobble of the reduced equations and the mode of the full system about the same steady spin that is
/// nearest to it, the larger one of rate and frequency; infinite if the reduced equations have no such spin. None next to an axis that
/// the moments of inertia do not determine. (V12)
#[must_use]
pub fn wobble_difference(reduced: &ReducedBody, modes: &SpinModes) -> Option<f64> {
    let K = modes.equilibrium.angular_momentum;
    let principal = Principal::compute(reduced.J);
    let along = |axis: usize| dot(principal.axes[axis], K).abs();
    let axis = (0..3).max_by(|a, b| along(*a).total_cmp(&along(*b)))?;
    if !principal.determined()[axis] {
        return None;
    }
    let Some(spin) = steady_spin_near(reduced, K) else { return Some(f64::INFINITY) };
    let differences = modes.modes.iter().map(|mode| difference(&spin, mode.of_motion));
    differences.min_by(f64::total_cmp)
}

fn difference(spin: &SteadySpin, [decay, frequency]: [f64; 2]) -> f64 {
    let size = decay.hypot(frequency);
    let turning = (spin.frequency - frequency).abs() / size;
    if spin.growth.abs().max(decay.abs()) <= RATE_ROUNDING * size {
        return turning;
    }
    turning.max((spin.growth + decay).abs() / decay.abs().max(RATE_ROUNDING * size))
}
