//! States of a material: displacements that its Maxwell elements have flowed.
//! Equation (M21), docs/theory/15-modes.md.

use nalgebra::DMatrix;

use super::LinearState;
use crate::model::{RationalModulus, Viscoelastic};

/// Material with a rational modulus, as directions of strain that each Maxwell element follows. (M21)
pub(super) struct Lag {
    modulus: RationalModulus,
    /// Columns `l` with `C = l lᵀ`, rows by elastic coordinates.
    strain: DMatrix<f64>,
}

/// Share of the largest stiffness below which a direction has none.
const SLACK: f64 = 1e-14;

impl Lag {
    /// The states that a material needs.
    pub fn of(material: &Viscoelastic, modulus: &RationalModulus) -> Self {
        let size = material.stiffness.size();
        let mut stiffness = DMatrix::<f64>::zeros(size, size);
        material.stiffness.iter().for_each(|(row, column, entry)| stiffness[(row, column)] += *entry);
        let directions = stiffness.symmetric_eigen();
        let least = SLACK * directions.eigenvalues.amax();
        let stiff: Vec<_> = (0..size).filter(|k| directions.eigenvalues[*k] > least).collect();
        let mut strain = directions.eigenvectors.select_columns(&stiff);
        for (mut column, k) in strain.column_iter_mut().zip(&stiff) {
            column *= directions.eigenvalues[*k].sqrt();
        }
        Self { modulus: modulus.clone(), strain }
    }

    /// Number of states.
    pub fn states(&self) -> usize {
        self.modulus.maxwell.len() * self.strain.ncols()
    }

    /// Meanings of the states.
    pub fn named(&self, material: usize) -> impl Iterator<Item = LinearState> {
        let directions = self.strain.ncols();
        (0..self.states()).map(move |place| LinearState::Lag {
            material,
            element: place / directions,
            direction: place % directions,
        })
    }

    /// Adds the forces of the displacements and of their rates, on the left-hand side of the equations of motion.
    pub fn pull(&self, forces: &mut DMatrix<f64>, held: usize) {
        let stiffness = &self.strain * self.strain.transpose();
        let (size, beyond) = (stiffness.nrows().min(held - 3), self.modulus.fast() - 1.0);
        let stiffness = stiffness.view((0, 0), (size, size));
        let mut by_displacement = forces.view_mut((3, 3), (size, size));
        by_displacement += beyond * stiffness;
        let mut by_rate = forces.view_mut((3, held + 3), (size, size));
        by_rate += self.modulus.dashpot * stiffness;
    }

    /// Adds the states from a place on, `ż = r (lᵀq − z)`, and the forces `−μ l z` of what has flowed.
    pub fn follow(&self, A: &mut DMatrix<f64>, forces: &mut DMatrix<f64>, start: usize) {
        let mut place = start;
        for [rate, strength] in &self.modulus.maxwell {
            for direction in self.strain.column_iter() {
                for (j, entry) in direction.iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
                    A[(place, 3 + j)] += rate * entry;
                    forces[(3 + j, place)] -= strength * entry;
                }
                A[(place, place)] = -rate;
                place += 1;
            }
        }
    }
}
