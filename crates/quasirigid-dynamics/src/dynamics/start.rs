use nalgebra::{Matrix3, Vector3};

use super::form::{AngularMomentumForm, Equations};
use crate::math::sym3;
use crate::math::vec3::norm;
use crate::model::{Form, ReducedBody};

/// Limit of Newton steps; the series is a small change of a linear map, so a few suffice.
const NEWTON_STEPS: usize = 30;

/// Step of the differences for Newton's slopes, relative to `Jω`; their error slows the last steps down by as much.
const DIFFERENCE: f64 = 1e-6;

/// State of a form with the angular velocity `omega`: `omega` itself, or the angular momentum that solves `ω(K) = ω`. (R17)
pub(super) fn start(body: &ReducedBody, omega: [f64; 3], form: Form) -> Option<[f64; 3]> {
    if form == Form::AngularVelocity {
        return Some(omega);
    }
    let form = AngularMomentumForm::new(body);
    let at = |K: Vector3<f64>| Vector3::from(form.omega(K.into()));
    let omega = Vector3::from(omega);
    let mut K = Vector3::from(body.angular_momentum(omega.into()));
    let step = DIFFERENCE * norm(sym3::times(body.J, omega.into()));
    let mut best = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let gap = omega - at(K);
        if gap.norm() >= 0.5 * best {
            break;
        }
        best = gap.norm();
        if best == 0.0 {
            break;
        }
        let slope = |axis: usize| {
            (at(K + step * Vector3::ith(axis, 1.0)) - at(K - step * Vector3::ith(axis, 1.0))) / (2.0 * step)
        };
        let slopes = Matrix3::from_columns(&[slope(0), slope(1), slope(2)]);
        K += slopes.lu().solve(&gap)?;
    }
    (best <= 1e-12 * omega.norm() && K.iter().all(|K| K.is_finite())).then(|| K.into())
}
