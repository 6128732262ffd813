//! Fineness of a division, and the sizes that a shape may have.

use quasirigid_math::memory;

use super::MeshingError;

/// Most cells of a mesh.
pub(super) const MOST_CELLS: usize = 5_000_000;
/// Memory that a cell takes while a mesh is made (bytes): ten nodes, its share of the nodes, and their places in the tables of edges.
const CELL: f64 = 400.0;
/// Greatest ratio of the longest length of a shape to its shortest.
const MOST_RATIO: f64 = 1e4;
/// Largest exponent of grading.
const MOST_EXPONENT: f64 = 4.0;

/// Cells across the narrowest width, and the exponent with which they become thinner towards the walls.
#[derive(Clone, Copy)]
pub(super) struct Fineness {
    resolution: usize,
    exponent: f64,
}

impl Fineness {
    pub fn new(resolution: usize, exponent: f64) -> Result<Self, MeshingError> {
        if resolution == 0 {
            return Err(MeshingError::Resolution);
        }
        if !(1.0..=MOST_EXPONENT).contains(&exponent) {
            return Err(MeshingError::Exponent { exponent, most: MOST_EXPONENT });
        }
        Ok(Self { resolution, exponent })
    }

    /// Width of an even cell where the shape is `narrowest`.
    pub fn width(&self, narrowest: f64) -> f64 {
        narrowest / self.resolution as f64
    }

    /// Accepts a number of cells if a mesh may have as many.
    pub fn allowed(&self, cells: f64) -> Result<(), MeshingError> {
        allowed(cells, self.resolution)
    }

    /// Place of a point, even between the middle (0) and a wall (1), after grading.
    pub fn towards_wall(&self, x: f64) -> f64 {
        1.0 - (1.0 - x).powf(self.exponent)
    }

    /// Place of a point, even between two walls at 0 and 1, after grading.
    pub fn between_walls(&self, x: f64) -> f64 {
        let side = 2.0 * x - 1.0;
        0.5 + (0.5 * self.towards_wall(side.abs())).copysign(side)
    }
}

/// Accepts a number of cells if a mesh may have as many and there is room for them; the error names a resolution that would do.
pub(super) fn allowed(cells: f64, resolution: usize) -> Result<(), MeshingError> {
    if cells <= MOST_CELLS as f64 {
        return memory::ask(cells * CELL).map_err(|cause| MeshingError::Memory { cells, cause });
    }
    let coarser = resolution as f64 * (MOST_CELLS as f64 / cells).cbrt();
    Err(MeshingError::TooMany { cells, most: MOST_CELLS, resolution: coarser as usize })
}

/// Longest of several lengths, and all lengths relative to it.
pub(super) fn relative<const N: usize>(lengths: [f64; N]) -> Result<(f64, [f64; N]), MeshingError> {
    if let Some(value) = lengths.into_iter().find(|length| !(*length > 0.0 && length.is_finite())) {
        return Err(MeshingError::Length { value });
    }
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let ratio = longest / lengths.into_iter().fold(f64::INFINITY, f64::min);
    if !(ratio <= MOST_RATIO) {
        return Err(MeshingError::Disparate { ratio, most: MOST_RATIO });
    }
    Ok((longest, lengths.map(|length| length / longest)))
}

/// Number of cells of a width along a length: whole, and at least as many as are needed.
pub(super) fn cells(length: f64, width: f64, least: usize) -> usize {
    ((length / width).round() as usize).max(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grading_keeps_walls_and_middle_and_thins_cells_at_walls() {
        for exponent in [1.0, 1.5, 4.0] {
            let fineness = Fineness::new(3, exponent).unwrap();
            assert_eq!([0.0, 0.5, 1.0].map(|x| fineness.between_walls(x)), [0.0, 0.5, 1.0]);
            assert_eq!([0.0, 1.0].map(|x| fineness.towards_wall(x)), [0.0, 1.0]);
            let first = fineness.between_walls(0.1);
            assert!((first - 0.5 * 0.2_f64.powf(exponent)).abs() < 1e-15, "{first}");
            assert!((fineness.between_walls(0.9) + first - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn what_makes_no_mesh_is_refused() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(relative([1.0, value]), Err(MeshingError::Length { .. })), "{value}");
            assert!(matches!(Fineness::new(1, value), Err(MeshingError::Exponent { .. })), "{value}");
        }
        assert!(relative([1e-4, 1.0]).is_ok() && relative([0.99e-4, 1.0]).is_err());
        assert!(Fineness::new(1, 4.0).is_ok() && Fineness::new(1, 4.01).is_err());
        assert!(Fineness::new(1, 1.0).is_ok() && Fineness::new(1, 0.99).is_err());
        assert_eq!(Fineness::new(0, 1.0).err(), Some(MeshingError::Resolution));
        let fineness = Fineness::new(100, 1.0).unwrap();
        assert_eq!(fineness.allowed(5e6), Ok(()));
        let refusal = fineness.allowed(40e6).unwrap_err();
        let expected = "there would be about 4.000e7 cells, more than 5000000; try a resolution of 50";
        assert_eq!(refusal.to_string(), expected);
        let refusal = Fineness::new(1, 1.0).unwrap().allowed(40e6).unwrap_err();
        assert!(refusal.to_string().ends_with("the shape is too thin beside its length"), "{refusal}");
    }
}
