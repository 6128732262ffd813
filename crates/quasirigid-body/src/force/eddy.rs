//! Torque on the eddy currents of a body that rotates in a magnetic field. (F15)

use crate::math::scalar::Smooth;
use crate::math::vec3::{cross, dot};

/// Torque `[M(ω×B)]×B` (N·m) of the magnetic tensor `M` (S·m⁴), all in body axes: its power `−(ω×B)·M(ω×B)` is never positive. (F15)
pub(super) fn torque<T: Smooth>(tensor: &[[f64; 3]; 3], omega: [T; 3], field: [T; 3]) -> [T; 3] {
    let cut = cross(omega, field);
    let moment = tensor.map(|row| dot(row.map(T::from), cut));
    cross(moment, field)
}
