use super::MeshingError;
use super::fineness::{Fineness, cells, relative};
use super::simplices::Simplices;
use crate::Mesh;

/// A box with `sides` along the axes. No dihedral angle of even cells is below 32°; all are 45°, 60° or 90° where
/// the other sides are whole multiples of the width of a cell.
///
/// # Errors
/// [`MeshingError`] for lengths that are not positive or too different, no cells, too many, or a bad exponent.
pub fn cuboid(sides: [f64; 3], resolution: usize, exponent: f64) -> Result<Mesh, MeshingError> {
    let (unit, sides) = relative(sides)?;
    let fineness = Fineness::new(resolution, exponent)?;
    let width = fineness.width(sides.into_iter().fold(1.0, f64::min));
    let counts = sides.map(|side| cells(side, width, 1));
    fineness.allowed(6.0 * counts.map(|count| count as f64).into_iter().product::<f64>())?;
    let at = |axis: usize, index: usize| {
        sides[axis] * (fineness.between_walls(index as f64 / counts[axis] as f64) - 0.5)
    };
    let base = Simplices::grid([counts[0], counts[1]], false, |i, j| [at(0, i), at(1, j)]);
    Simplices::prisms(&base, counts[2], false, |[x, y], k| [x, y, at(2, k)]).mapped(unit, |point| point)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{angles_deg, assert_sound, error};
    use super::*;

    #[test]
    fn a_box_is_exact_and_sound_with_any_grading_and_unit() {
        for (unit, resolution, exponent) in [(1.0, 1, 1.0), (1e-3, 2, 1.5), (1e3, 3, 2.5)] {
            let [a, b, c] = [1.3, 3.0, 2.1].map(|side| unit * side);
            let mesh = cuboid([a, b, c], resolution, exponent).unwrap();
            let v = a * b * c / 12.0;
            assert!(error(&mesh, [12.0 * v, v * a * a, v * b * b, v * c * c, 0.0, 0.0, 0.0]) < 1e-12);
            let away = |x: f64, side: f64| (x.abs() - 0.5 * side).abs();
            assert_sound(&mesh, 2, |[x, y, z]| away(x, a).min(away(y, b)).min(away(z, c)));
        }
    }

    #[test]
    fn angles_are_bounded() {
        let least = |sides, resolution| angles_deg(&cuboid(sides, resolution, 1.0).unwrap())[0];
        assert!((least([1.0, 3.0, 2.0], 2) - 45.0).abs() < 1e-12);
        for k in 0..50 {
            let sides = [1.0, 1.0 + 0.013 * k as f64, 1.3 - 0.005 * k as f64];
            assert!(least(sides, 1) > 32.0 && least(sides, 2) > 32.0, "{sides:?}");
        }
    }

    #[test]
    fn cells_are_as_wide_as_asked() {
        assert_eq!(cuboid([2.0, 1.0, 3.0], 2, 1.0).unwrap().cells.len(), 6 * 4 * 2 * 6);
    }

    #[test]
    fn boxes_without_a_mesh_are_refused() {
        assert!(matches!(cuboid([1.0, 0.0, 1.0], 2, 1.0), Err(MeshingError::Length { .. })));
        assert!(matches!(cuboid([1.0, 1.0, 1e-5], 2, 1.0), Err(MeshingError::Disparate { .. })));
        assert!(matches!(cuboid([1.0; 3], 95, 1.0), Err(MeshingError::TooMany { resolution: 94, .. })));
        let refusal = cuboid([1.0, 1e3, 1.0], usize::MAX, 1.0);
        assert!(matches!(refusal, Err(MeshingError::TooMany { .. })));
    }
}
