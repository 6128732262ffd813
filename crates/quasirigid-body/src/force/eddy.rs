//! Torque on the eddy currents of a body that rotates in a magnetic field, which may change itself. (F15)

use crate::math::scalar::Smooth;
use crate::math::vec3::{add, cross, dot};

/// Torque `[M(ω×B − Ḃ)]×B` (N·m) of the magnetic tensor `M` (S·m⁴), all in body axes: `Ḃ` (T/s) is the rate of the field in inertial axes.
/// Currents take the power `(ω×B − Ḃ)·M(ω×B − Ḃ)`, which is never negative. (F15)
pub(super) fn torque<T: Smooth>(
    tensor: &[[f64; 3]; 3],
    omega: [T; 3],
    [field, field_rate]: [[T; 3]; 2],
) -> [T; 3] {
    let cut = add(cross(omega, field), field_rate.map(|rate| -rate));
    let moment = tensor.map(|row| dot(row.map(T::from), cut));
    cross(moment, field)
}
