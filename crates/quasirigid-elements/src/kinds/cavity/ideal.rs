use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use crate::flow::potential_flow::PotentialFlowMoments;
use crate::math::quadrature::gauss_legendre;

/// Quadrature points from the middle of an ellipsoid to a pole, and round a quarter.
const POINTS: usize = 48;

/// An ideal liquid in an ellipsoid, whose flow is linear: `w_3 = 2/(a² + b²) (a² y, −b² x, 0)` and so on in the cycle. (L13)
pub(super) fn in_ellipsoid(semi_axes: [f64; 3]) -> PotentialFlowMoments {
    let fields = [0, 1, 2].map(|axis| {
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        let [a, b] = [first, second].map(|axis| semi_axes[axis].powi(2));
        let mut field = Matrix3::zeros();
        field[(first, second)] = 2.0 * a / (a + b);
        field[(second, first)] = -2.0 * b / (a + b);
        field
    });
    let mut slip = PotentialFlowMoments::default();
    let volume = 4.0 / 3.0 * PI * semi_axes.iter().product::<f64>();
    // Second moments are those of points on the axes.
    for axis in 0..3 {
        let mut place = Vector3::zeros();
        place[axis] = semi_axes[axis] / 5.0_f64.sqrt();
        slip.add_volume(volume, &fields.map(|field| field * place));
    }
    for [z, height] in octant() {
        for [turn, arc] in octant() {
            let (sin, cos) = (0.5 * PI * turn).sin_cos();
            let across = (1.0 - z * z).sqrt();
            let unit = Vector3::new(across * cos, across * sin, z);
            let place = unit.component_mul(&Vector3::from(semi_axes));
            let normal = unit.component_div(&Vector3::from(semi_axes)).norm();
            let area = semi_axes.iter().product::<f64>() * normal * height * 0.5 * PI * arc;
            for corner in 0..8 {
                let sign = |axis: usize| if corner >> axis & 1 == 0 { 1.0 } else { -1.0 };
                let mirrored = Vector3::from_fn(|axis, _| sign(axis) * place[axis]);
                slip.add_surface(area, &fields.map(|field| field * mirrored));
            }
        }
    }
    slip
}

/// Nodes and weights from 0 to 1.
fn octant() -> impl Iterator<Item = [f64; 2]> {
    gauss_legendre(POINTS).into_iter().map(|[x, weight]| [0.5 * (1.0 + x), 0.5 * weight])
}
