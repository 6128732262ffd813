use crate::math::sym3::{self, times};
use crate::math::vec3::{add, dot, norm, scale};
use crate::model::{FlexibleBody, MotionState, Principal, ReducedBody};
use crate::modes::{EquilibriumError, Given, RelativeEquilibrium};

/// Largest difference, relative to itself, between the angular momentum that the series has and that of the state it describes, for the
/// state to have a meaning.
const MEANINGFUL: f64 = 1e-2;
/// Steps towards an angular velocity that has an angular momentum.
const STEPS: usize = 60;
/// Change of an angular velocity, relative to itself, that is rounding.
const SETTLED: f64 = 1e-14;

/// Whether the slow manifold of a reduced body has a meaning at an angular velocity (rad/s): whether the state that it describes has the
/// angular momentum that its series says. (Q8)
#[must_use]
pub fn manifold_has_meaning(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> bool {
    let (q, rate) = (reduced.q.value(omega), reduced.rate.value(omega));
    let momentum = body.momentum(MotionState { omega, q: &q, rate: &rate });
    let momentum = add(momentum, body.wheels().momentum(0.0));
    let said = reduced.momentum(omega);
    let gap = norm(add(said, scale(-1.0, momentum)));
    gap <= MEANINGFUL * norm(times(body.invariants().J, omega))
}

/// Displacements of the steady spin about the principal axis next to an angular velocity (rad/s), at its size. (Q8)
///
/// # Errors
/// [`EquilibriumError`] if there is no such steady spin.
pub fn spun_displacements(body: &FlexibleBody, omega: [f64; 3]) -> Result<Vec<f64>, EquilibriumError> {
    Ok(RelativeEquilibrium::near(body, nearest(body, omega), Given::Rate(norm(omega)))?.q)
}

/// Angular velocity (rad/s) and displacements with this angular momentum (N·m·s, body axes, without that of wheels), the body deformed
/// as by the steady spin of that size about the principal axis next to it. (Q8)
///
/// # Errors
/// [`EquilibriumError`] if there is no such steady spin.
pub fn spun_state(body: &FlexibleBody, momentum: [f64; 3]) -> Result<([f64; 3], Vec<f64>), EquilibriumError> {
    let mut omega = times(sym3::inverse(body.invariants().J), momentum);
    let mut q = spun_displacements(body, omega)?;
    for _ in 0..STEPS {
        let next = times(sym3::inverse(body.inertia_at(&q)), momentum);
        let change = norm(add(next, scale(-1.0, omega)));
        omega = next;
        q = spun_displacements(body, omega)?;
        if change <= SETTLED * norm(omega) {
            break;
        }
    }
    Ok((omega, q))
}

/// The principal axis next to an angular velocity, on its side.
fn nearest(body: &FlexibleBody, omega: [f64; 3]) -> [f64; 3] {
    let along = |axis: &[f64; 3]| dot(*axis, omega);
    let axes = Principal::compute(body.invariants().J).axes;
    let axis = axes.into_iter().max_by(|a, b| along(a).abs().total_cmp(&along(b).abs())).unwrap_or(omega);
    scale(along(&axis).signum(), axis)
}
