use super::energy_range::EnergyRange;
use crate::math::sym3::{self, times};
use crate::math::vec3::{add, norm, scale};
use crate::model::{FlexibleBody, Principal};
use crate::modes::{EquilibriumError, RelativeEquilibrium, SpinMagnitude};

/// Limit of iterations for the angular velocity of an angular momentum.
const MAX_ITERATIONS: usize = 60;
/// Relative change of an angular velocity that is rounding.
const ITERATION_ROUNDING: f64 = 1e-14;

/// Displacements in balance with an angular velocity (rad/s); of bodies without momentum wheels where that is not known, with rotors, liquids
/// and curved paths, those of the steady spin of the same size about the principal axis next to it. (Q8)
///
/// # Errors
/// [`EquilibriumError`] if there is no such steady spin.
pub fn spun_displacements(body: &FlexibleBody, omega: [f64; 3]) -> Result<Vec<f64>, EquilibriumError> {
    if !body.wheels().is_empty() {
        let axis = scale(norm(omega).recip(), omega);
        let balanced =
            body.balanced(omega).ok_or(EquilibriumError::NotFound { axis, reached: 0.0, wheels: true })?;
        return Ok(balanced.q);
    }
    if let Some(q) = EnergyRange::balance(body, omega) {
        return Ok(q);
    }
    Ok(RelativeEquilibrium::near(
        body,
        Principal::compute(body.invariants().J).axis_beside(omega),
        SpinMagnitude::Rate(norm(omega)),
    )?
    .q)
}

/// Angular velocity (rad/s) and displacements with this angular momentum (N·m·s, body axes, without that of wheels), the body deformed as
/// [`spun_displacements`] says. (Q8)
///
/// # Errors
/// [`EquilibriumError`] if there is no such steady spin.
pub fn spun_state(
    body: &FlexibleBody,
    angular_momentum: [f64; 3],
) -> Result<([f64; 3], Vec<f64>), EquilibriumError> {
    let mut omega = times(sym3::inverse(body.invariants().J), angular_momentum);
    let mut q = spun_displacements(body, omega)?;
    for _ in 0..MAX_ITERATIONS {
        let next = times(sym3::inverse(body.full_inertia_at(&q)), angular_momentum);
        let change = norm(add(next, scale(-1.0, omega)));
        omega = next;
        q = spun_displacements(body, omega)?;
        if change <= ITERATION_ROUNDING * norm(omega) {
            break;
        }
    }
    Ok((omega, q))
}
