//! Mesh of a torus: a disc swept round the axis, cut into curved tetrahedra.
//! Cells on the inside of the bend are compressed, so a ring too tight for its cells is refused instead of folded.

use std::f64::consts::PI;

use super::MeshingError;
use super::cylinder::AROUND;
use super::fineness::{Fineness, cells, relative};
use super::round::{hexagon, rounded};
use super::simplices::Simplices;
use crate::Mesh;

/// A torus around the z axis: a tube with an even number of cells across, its middle on a circle of a `radius`. No
/// dihedral angle of even cells is below 23° from a resolution of 2 on if the radius is at least twice that of the tube.
///
/// # Errors
/// [`MeshingError`] for lengths that are not positive or too different, a tube that meets the axis, no cells, too many,
/// a bad exponent, or cells that the bend turns inside out.
pub fn ring(radius: f64, tube_radius: f64, resolution: usize, exponent: f64) -> Result<Mesh, MeshingError> {
    if tube_radius >= radius {
        return Err(MeshingError::NotWithin { inner: tube_radius, outer: radius });
    }
    let (unit, [radius, tube]) = relative([radius, tube_radius])?;
    let fineness = Fineness::new(resolution, exponent)?;
    let width = fineness.width(2.0 * tube);
    let (across, around) = (resolution.div_ceil(2), cells(2.0 * PI * radius, width, AROUND));
    fineness.allowed(18.0 * (across as f64).powi(2) * around as f64)?;
    let disc = hexagon(across, fineness);
    let ring = Simplices::prisms(&disc, around, true, |[x, z, rho], k| {
        let (sin, cos) = (2.0 * PI * k as f64 / around as f64).sin_cos();
        [x, z, rho, cos, sin]
    });
    ring.mapped(unit, |[x, z, rho, cos, sin]| {
        let [x, z] = rounded([x, z], rho);
        let stretch = (radius + tube * x) / cos.hypot(sin);
        [stretch * cos, stretch * sin, tube * z]
    })
}

#[cfg(test)]
mod tests {
    use super::super::testing::{angles_deg, assert_fourth_order, assert_sound};
    use super::*;

    #[test]
    fn moments_converge_with_the_fourth_power() {
        for (radius, tube, exponent) in [(3e-3, 1e-3, 1.0), (2.0, 1.0, 1.5), (3e3, 1e3, 1.0)] {
            let v = 2.0 * PI * PI * radius * tube * tube;
            let across = v * (radius * radius / 2.0 + 3.0 * tube * tube / 8.0);
            let exact = [v, across, across, v * tube * tube / 4.0, 0.0, 0.0, 0.0];
            assert_fourth_order(exact, 6, |n| ring(radius, tube, n, exponent).unwrap());
        }
    }

    #[test]
    fn rings_are_sound() {
        for (radius, tube, resolution, exponent) in
            [(9.0, 1.0, 2, 1.0), (3e3, 1e3, 5, 1.0), (1.1, 1.0, 6, 1.5)]
        {
            let mesh = ring(radius, tube, resolution, exponent).unwrap();
            assert_sound(&mesh, 0, |[x, y, z]| (x.hypot(y) - radius).hypot(z) - tube);
        }
    }

    #[test]
    fn angles_are_bounded() {
        for (radius, resolution) in [(2.0, 2), (2.0, 4), (2.0, 6), (2.7, 3), (3.0, 8), (10.0, 2)] {
            assert!(
                angles_deg(&ring(radius, 1.0, resolution, 1.0).unwrap())[0] > 23.0,
                "{radius} {resolution}"
            );
        }
    }

    #[test]
    fn cells_are_as_wide_as_asked() {
        // 6 π around, in widths of ½, is 37.7.
        assert_eq!(ring(3.0, 1.0, 4, 1.0).unwrap().cells.len(), 18 * 2 * 2 * 38);
    }

    #[test]
    fn rings_without_a_mesh_are_refused() {
        assert_eq!(ring(1.0, 1.0, 4, 1.0), Err(MeshingError::NotWithin { inner: 1.0, outer: 1.0 }));
        assert!(matches!(ring(f64::NAN, 1.0, 4, 1.0), Err(MeshingError::Length { .. })));
        let refusal = ring(1.2, 1.0, 2, 1.0).unwrap_err();
        let expected = "8 of 144 curved cells are inside out near a wall; raise the resolution";
        assert_eq!(refusal.to_string(), expected);
    }
}
