//! Mesh of the space between two ellipsoids: a divided icosahedron in layers.
//! The inner and the outer wall are images of one sphere, so cells join equal points of both and no layer needs a search.

use super::MeshingError;
use super::fineness::{Fineness, cells, relative};
use super::round::icosahedron_hull;
use super::simplices::Simplices;
use crate::Mesh;

/// Angle between neighbouring corners of an icosahedron: arctan 2.
const CORNERS_APART: f64 = 1.107_148_717_794_090_4;

/// A space between two ellipsoids with semi-axes along the axes, the inner within the outer.
///
/// Straight lines join the images of a point of the unit sphere on the two walls. Cells are as wide as the gaps along the three axes are on
/// average. Between balls no dihedral angle of even cells is below 22° if the inner radius is at least half the outer one.
///
/// # Errors
/// [`MeshingError`] for lengths that are not positive or too different, semi-axes in the wrong order, no cells, too many,
/// or a bad exponent.
pub fn shell(
    outer: [f64; 3],
    inner: [f64; 3],
    resolution: usize,
    exponent: f64,
) -> Result<Mesh, MeshingError> {
    if let Some((outer, inner)) = outer.into_iter().zip(inner).find(|(outer, inner)| inner >= outer) {
        return Err(MeshingError::NotWithin { inner, outer });
    }
    let gaps: [f64; 3] = std::array::from_fn(|axis| outer[axis] - inner[axis]);
    let lengths: [f64; 9] = std::array::from_fn(|k| [outer, inner, gaps][k / 3][k % 3]);
    let (unit, [a, b, c, p, q, r, gaps @ ..]) = relative(lengths)?;
    let (outer, inner) = ([a, b, c], [p, q, r]);
    let fineness = Fineness::new(resolution, exponent)?;
    let width = fineness.width(gaps.iter().sum::<f64>() / 3.0);
    let mean = outer.iter().chain(&inner).sum::<f64>() / 6.0;
    let across = cells(CORNERS_APART * mean, width, 1);
    fineness.allowed(60.0 * (across as f64).powi(2) * resolution as f64)?;
    let base = icosahedron_hull().divided(across);
    let outward = |k: usize| fineness.between_walls(k as f64 / resolution as f64);
    Simplices::prisms(&base, resolution, false, |[x, y, z], k| [x, y, z, outward(k)]).mapped(
        unit,
        |[x, y, z, outward]| {
            let length = x.hypot(y).hypot(z);
            let semi_axis = |axis: usize| inner[axis] * (1.0 - outward) + outer[axis] * outward;
            [semi_axis(0) * (x / length), semi_axis(1) * (y / length), semi_axis(2) * (z / length)]
        },
    )
}

#[cfg(test)]
mod tests {
    use super::super::testing::{angles_deg, assert_fourth_order, assert_sound};
    use super::*;
    use quasirigid_math::vec3::norm;
    use std::f64::consts::PI;

    fn exact(outer: [f64; 3], inner: [f64; 3]) -> [f64; 7] {
        let [[p, pa, pb, pc], [q, qa, qb, qc]] = [outer, inner].map(|[a, b, c]| {
            let v = 4.0 / 15.0 * PI * a * b * c;
            [5.0 * v, v * a * a, v * b * b, v * c * c]
        });
        [p - q, pa - qa, pb - qb, pc - qc, 0.0, 0.0, 0.0]
    }

    #[test]
    fn moments_converge_with_the_fourth_power() {
        for (unit, exponent) in [(1e-3, 1.0), (1.0, 1.5), (1e3, 1.0)] {
            let [outer, inner] = [[1.0, 0.9, 0.8], [0.6, 0.6, 0.3]].map(|axes| axes.map(|axis| unit * axis));
            assert_fourth_order(exact(outer, inner), 2, |n| shell(outer, inner, n, exponent).unwrap());
        }
    }

    #[test]
    fn shells_are_sound() {
        for (outer, inner, resolution, exponent) in [
            ([1.0; 3], [0.5; 3], 1, 1.0),
            ([3e3, 2e3, 1e3], [2e3, 1.5e3, 0.6e3], 2, 1.0),
            ([1e-3; 3], [0.2e-3, 0.6e-3, 0.8e-3], 4, 2.0),
        ] {
            let mesh = shell(outer, inner, resolution, exponent).unwrap();
            let size = outer.into_iter().fold(0.0, f64::max);
            let away = |node: [f64; 3], axes: [f64; 3]| {
                size * (1.0 - norm(std::array::from_fn(|axis| node[axis] / axes[axis]))).abs()
            };
            assert_sound(&mesh, 4, |node| away(node, outer).min(away(node, inner)));
        }
    }

    #[test]
    fn angles_between_balls_are_bounded() {
        for (inner, resolution) in [(0.5, 1), (0.5, 3), (0.5, 4), (0.55, 3), (0.62, 5), (0.7, 2), (0.9, 1)] {
            let [least, _] = angles_deg(&shell([1.0; 3], [inner; 3], resolution, 1.0).unwrap());
            assert!(least > 22.0, "{inner} {resolution}: {least}");
        }
    }

    #[test]
    fn cells_are_as_wide_as_asked() {
        // Between neighbouring corners of the icosahedron are 1.107 × ¾, in widths of ⅙ 4.98.
        assert_eq!(shell([1.0; 3], [0.5; 3], 3, 1.0).unwrap().cells.len(), 60 * 5 * 5 * 3);
    }

    #[test]
    fn shells_without_a_mesh_are_refused() {
        let refusal = shell([1.0, 0.5, 1.0], [0.4, 0.6, 0.4], 2, 1.0);
        assert_eq!(refusal, Err(MeshingError::NotWithin { inner: 0.6, outer: 0.5 }));
        assert!(matches!(shell([1.0; 3], [-0.1; 3], 2, 1.0), Err(MeshingError::Length { .. })));
        assert!(matches!(shell([1.0; 3], [0.99; 3], 3, 1.0), Err(MeshingError::TooMany { .. })));
    }
}
