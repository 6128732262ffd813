use super::cell::points;
use super::grid::Grid;
use crate::math::vec3::{add, scale};

/// Volume of a cavity and its moments.
pub(crate) struct Moments {
    /// Volume (m³).
    pub volume: f64,
    /// Centre of volume (m).
    pub center: [f64; 3],
    /// `∫ r rᵀ dV` (m⁵) about the centre.
    pub second: [[f64; 3]; 3],
}

impl Moments {
    pub(super) fn of(grid: &Grid) -> Self {
        // Places are taken from a point of the cavity, so that its distance from the origin costs no digits.
        let start = grid.cells.first().map(|cell| grid.places[cell[0]]).unwrap_or_default();
        let (mut volume, mut first) = (0.0, [0.0; 3]);
        for cell in &grid.cells {
            for point in points(&cell.map(|node| grid.places[node])) {
                volume += point.volume;
                first = add(first, scale(point.volume, add(point.place, scale(-1.0, start))));
            }
        }
        let center = add(start, scale(1.0 / volume, first));
        let mut second = [[0.0; 3]; 3];
        for cell in &grid.cells {
            for point in points(&cell.map(|node| grid.places[node])) {
                let r = add(point.place, scale(-1.0, center));
                second = [0, 1, 2].map(|row| add(second[row], scale(point.volume * r[row], r)));
            }
        }
        Self { volume, center, second }
    }

    /// Whether floating point can represent them.
    pub(super) fn in_range(&self) -> bool {
        let squares = [0, 1, 2].map(|axis| self.second[axis][axis]);
        self.volume.is_normal() && squares.iter().all(|square| square.is_normal())
    }
}
