use super::MeshingError;
use super::fineness::{Fineness, relative};
use super::round::{icosahedral_ball, rounded};
use crate::Mesh;

/// An ellipsoid with semi-axes along the axes, with an even number of cells across each: a ball, stretched. No dihedral
/// angle of even cells of a ball is below 37°.
///
/// # Errors
/// [`MeshingError`] for lengths that are not positive or too different, no cells, too many, or a bad exponent.
pub fn ellipsoid(semi_axes: [f64; 3], resolution: usize, exponent: f64) -> Result<Mesh, MeshingError> {
    let (unit, semi_axes) = relative(semi_axes)?;
    let fineness = Fineness::new(resolution, exponent)?;
    let across = resolution.div_ceil(2);
    fineness.allowed(20.0 * (across as f64).powi(3))?;
    icosahedral_ball(across, fineness).mapped(unit, |[x, y, z, rho]| {
        let [x, y, z] = rounded([x, y, z], rho);
        [semi_axes[0] * x, semi_axes[1] * y, semi_axes[2] * z]
    })
}

#[cfg(test)]
mod tests {
    use super::super::testing::{angles_deg, assert_fourth_order, assert_sound};
    use super::*;
    use quasirigid_math::vec3::norm;
    use std::f64::consts::PI;

    fn exact([a, b, c]: [f64; 3]) -> [f64; 7] {
        let v = 4.0 / 15.0 * PI * a * b * c;
        [5.0 * v, v * a * a, v * b * b, v * c * c, 0.0, 0.0, 0.0]
    }

    #[test]
    fn moments_converge_with_the_fourth_power() {
        for unit in [1e-3, 1.0, 1e3] {
            let axes = [1.0, 0.7, 1.6].map(|axis| unit * axis);
            assert_fourth_order(exact(axes), 6, |n| ellipsoid(axes, n, 1.0).unwrap());
        }
        assert_fourth_order(exact([1.0; 3]), 8, |n| ellipsoid([1.0; 3], n, 1.5).unwrap());
    }

    #[test]
    fn ellipsoids_are_sound() {
        for (axes, resolution, exponent) in
            [([1.0; 3], 1, 1.0), ([2.0; 3], 7, 2.0), ([3e3, 1e3, 2e3], 8, 1.3)]
        {
            let mesh = ellipsoid(axes, resolution, exponent).unwrap();
            let size = axes.into_iter().fold(0.0, f64::max);
            let within = |node: [f64; 3]| norm(std::array::from_fn(|axis| node[axis] / axes[axis]));
            assert_sound(&mesh, 2, |node| size * (1.0 - within(node)));
            assert_eq!(mesh.cells.len(), 20 * resolution.div_ceil(2).pow(3));
        }
    }

    #[test]
    fn angles_of_a_ball_are_bounded() {
        for resolution in [2, 4, 10, 20] {
            assert!(angles_deg(&ellipsoid([1.0; 3], resolution, 1.0).unwrap())[0] > 37.0);
        }
    }

    #[test]
    fn ellipsoids_without_a_mesh_are_refused() {
        assert!(matches!(ellipsoid([1.0, f64::NAN, 1.0], 2, 1.0), Err(MeshingError::Length { .. })));
        assert_eq!(ellipsoid([1.0; 3], 0, 1.0), Err(MeshingError::Resolution));
        assert!(matches!(ellipsoid([1.0; 3], usize::MAX, 1.0), Err(MeshingError::TooMany { .. })));
    }
}
