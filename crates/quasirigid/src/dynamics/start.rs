use nalgebra::{Matrix3, Vector3};

use super::form::Form;
use crate::math::sphere::jacobian;
use crate::math::vec3::norm;
use crate::model::ReducedBody;

/// Limit of Newton steps; the series is a small change of a linear map, so a few suffice.
const NEWTON_STEPS: usize = 30;

/// State of a form with the angular velocity `omega`: `omega` itself, or the angular momentum that solves `Ω(K) = ω`.
pub(super) fn start(body: &ReducedBody, omega: [f64; 3], form: Form) -> Option<[f64; 3]> {
    if form == Form::AngularVelocity {
        return Some(omega);
    }
    let mut K = body.angular_momentum(omega);
    let mut best = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let Omega = body.Omega.vector(K);
        let gap: [f64; 3] = std::array::from_fn(|i| omega[i] - Omega[i]);
        if norm(gap) >= 0.5 * best {
            break;
        }
        best = norm(gap);
        let step = Matrix3::from(jacobian(&body.Omega, K)).lu().solve(&Vector3::from(gap))?;
        K = std::array::from_fn(|i| K[i] + step[i]);
    }
    (best < 1e-12 * norm(omega) && K.iter().all(|K| K.is_finite())).then_some(K)
}
