//! Grading: densities that differ from cell to cell of a region, as voxels have them, and moduli that follow a power of them.

use crate::error::Problem;
use crate::number;

/// Densities `ρ` of the cells of a region, and moduli `(ρ/ρ₀)ⁿ` times those of its material, whose density is `ρ₀`.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Grading {
    /// Density (kg/m³) of each cell, in the order of the region's cells.
    pub densities: Vec<f64>,
    /// Exponent `n`; zero for the moduli of the material throughout.
    pub exponent: f64,
}

impl Grading {
    /// Accepts a positive density for each of so many cells, and moduli that are positive numbers.
    pub(super) fn check(&self, cells: usize, reference: f64) -> Result<(), Problem> {
        if self.densities.len() != cells {
            return Err(Problem::DensityPerCell { found: self.densities.len(), cells });
        }
        for density in &self.densities {
            number::positive(*density)?;
            number::positive(self.factor(*density, reference))?;
        }
        Ok(())
    }

    /// Moduli at a density (kg/m³), relative to those at the reference density.
    #[must_use]
    pub fn factor(&self, density: f64, reference: f64) -> f64 {
        (density / reference).powf(self.exponent)
    }
}
