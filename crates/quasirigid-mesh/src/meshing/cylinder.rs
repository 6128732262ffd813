//! Meshes of cylinders and annuli: a round section times its height, cut into curved tetrahedra.
//! The section is a hexagon mapped smoothly to a disc; cells are nearly even, and the bounds on their angles are tested, not proved.
//! Moments converge with the fourth power of the width of a cell.

use std::f64::consts::PI;

use super::MeshingError;
use super::fineness::{Fineness, cells, relative};
use super::round::{hexagon, rounded};
use super::simplices::Simplices;
use crate::Mesh;

/// Least number of cells around a circle.
pub(super) const AROUND: usize = 6;

/// A circular cylinder around the z axis, with an even number of cells across its diameter. No dihedral angle of even
/// cells is below 29° from a resolution of 2 on.
///
/// # Errors
/// [`MeshingError`] for lengths that are not positive or too different, no cells, too many, or a bad exponent.
pub fn cylinder(radius: f64, height: f64, resolution: usize, exponent: f64) -> Result<Mesh, MeshingError> {
    let (unit, [radius, height]) = relative([radius, height])?;
    let fineness = Fineness::new(resolution, exponent)?;
    let width = fineness.width((2.0 * radius).min(height));
    let [across, layers] = [radius, height].map(|length| cells(length, width, 1));
    fineness.allowed(18.0 * (across as f64).powi(2) * layers as f64)?;
    let level = |k: usize| height * (fineness.between_walls(k as f64 / layers as f64) - 0.5);
    let disc = hexagon(across, fineness);
    Simplices::prisms(&disc, layers, false, |[x, y, rho], k| [x, y, rho, level(k)]).mapped(
        unit,
        |[x, y, rho, z]| {
            let [x, y] = rounded([x, y], rho);
            [radius * x, radius * y, z]
        },
    )
}

/// A space between two cylinders around the z axis, of an inner and an outer radius. No dihedral angle of even cells is below 22° from a
/// resolution of 2 on if the inner radius is at least half the outer one.
///
/// # Errors
/// [`MeshingError`] for lengths that are not positive or too different, radii in the wrong order, no cells, too many, or
/// a bad exponent.
pub fn annulus(
    [inner, outer]: [f64; 2],
    height: f64,
    resolution: usize,
    exponent: f64,
) -> Result<Mesh, MeshingError> {
    if inner >= outer {
        return Err(MeshingError::NotWithin { inner, outer });
    }
    let (unit, [inner, outer, gap, height]) = relative([inner, outer, outer - inner, height])?;
    let fineness = Fineness::new(resolution, exponent)?;
    let width = fineness.width(gap.min(height));
    let [rows, layers] = [gap, height].map(|length| cells(length, width, 1));
    let around = cells(PI * (inner + outer), width, AROUND);
    fineness.allowed([rows, layers, around].map(|count| count as f64).into_iter().product::<f64>() * 6.0)?;
    let base = Simplices::grid([around, rows], true, |i, j| {
        let (sin, cos) = (2.0 * PI * i as f64 / around as f64).sin_cos();
        [cos, sin, fineness.between_walls(j as f64 / rows as f64)]
    });
    let level = |k: usize| height * (fineness.between_walls(k as f64 / layers as f64) - 0.5);
    Simplices::prisms(&base, layers, false, |[x, y, outward], k| [x, y, outward, level(k)]).mapped(
        unit,
        |[x, y, outward, z]| {
            let radius = inner * (1.0 - outward) + outer * outward;
            let stretch = radius / x.hypot(y);
            [stretch * x, stretch * y, z]
        },
    )
}

#[cfg(test)]
mod tests {
    use super::super::testing::{angles_deg, assert_fourth_order, assert_sound};
    use super::*;

    /// Exact moments of a space between two cylinders.
    fn exact([a, b]: [f64; 2], height: f64) -> [f64; 7] {
        let v = PI * (b * b - a * a) * height;
        let across = v * (a * a + b * b) / 4.0;
        [v, across, across, v * height * height / 12.0, 0.0, 0.0, 0.0]
    }

    #[test]
    fn moments_converge_with_the_fourth_power() {
        for unit in [1e-3, 1.0, 1e3] {
            let [a, b, h] = [0.5, 1.0, 2.0].map(|length| unit * length);
            assert_fourth_order(exact([0.0, b], h), 4, |n| cylinder(b, h, n, 1.0).unwrap());
            assert_fourth_order(exact([a, b], h), 2, |n| annulus([a, b], h, n, 1.0).unwrap());
        }
        assert_fourth_order(exact([0.0, 1.0], 1.0), 3, |n| cylinder(1.0, 1.0, n, 2.0).unwrap());
        assert_fourth_order(exact([0.5, 1.0], 1.0), 2, |n| annulus([0.5, 1.0], 1.0, n, 2.0).unwrap());
    }

    #[test]
    fn cylinders_are_sound() {
        for (radius, height, resolution, exponent) in
            [(1.0, 5.0, 1, 1.0), (3e3, 1e3, 3, 1.0), (1.0, 2.0, 6, 1.5)]
        {
            let mesh = cylinder(radius, height, resolution, exponent).unwrap();
            assert_sound(&mesh, 2, |[x, y, z]| {
                (x.hypot(y) - radius).abs().min((z.abs() - 0.5 * height).abs())
            });
        }
    }

    #[test]
    fn annuli_are_sound() {
        for ([inner, outer], height, resolution, exponent) in
            [([0.3, 1.0], 5.0, 1, 1.0), ([0.8e-3, 1e-3], 1e-4, 2, 1.0), ([0.1, 1.0], 2.0, 5, 1.5)]
        {
            let mesh = annulus([inner, outer], height, resolution, exponent).unwrap();
            assert_sound(&mesh, 0, |[x, y, z]| {
                let [a, b] = [inner, outer].map(|radius| (x.hypot(y) - radius).abs());
                a.min(b).min((z.abs() - 0.5 * height).abs())
            });
        }
    }

    #[test]
    fn angles_are_bounded() {
        for height in [0.1, 0.42, 0.55, 0.77, 1.0, 1.31, 1.6, 2.3, 3.7] {
            for resolution in 2..5 {
                assert!(angles_deg(&cylinder(0.5, height, resolution, 1.0).unwrap())[0] > 29.0);
                assert!(angles_deg(&annulus([0.5, 1.0], 0.5 * height, resolution, 1.0).unwrap())[0] > 22.0);
            }
        }
    }

    #[test]
    fn cells_are_as_wide_as_asked() {
        assert_eq!(cylinder(1.0, 4.0, 4, 1.0).unwrap().cells.len(), 18 * 2 * 2 * 8);
        assert_eq!(cylinder(2.0, 1.0, 2, 1.0).unwrap().cells.len(), 18 * 4 * 4 * 2);
        // 1.5 π around, in widths of ¼, is 18.8.
        assert_eq!(annulus([0.5, 1.0], 1.0, 2, 1.0).unwrap().cells.len(), 6 * 19 * 2 * 4);
    }

    #[test]
    fn cylinders_without_a_mesh_are_refused() {
        assert!(matches!(cylinder(1.0, -1.0, 2, 1.0), Err(MeshingError::Length { .. })));
        assert!(matches!(cylinder(1.0, 1.0, 200, 1.0), Err(MeshingError::TooMany { .. })));
        let refusal = annulus([1.0, 1.0], 1.0, 2, 1.0);
        assert_eq!(refusal, Err(MeshingError::NotWithin { inner: 1.0, outer: 1.0 }));
        assert!(matches!(annulus([1.0, f64::NAN], 1.0, 2, 1.0), Err(MeshingError::Length { .. })));
        assert!(matches!(annulus([1.0, f64::INFINITY], 1.0, 2, 1.0), Err(MeshingError::Length { .. })));
        assert!(matches!(annulus([1.0, 1.0001], 1.0, 2, 1.0), Err(MeshingError::Disparate { .. })));
    }
}
