use super::Seat;
use super::nodal::{NodalMass, times};
use crate::error::{ElementError, Field, at};
use crate::model::Rheology;
use crate::structure::{Constraint, Structure};

/// Matrices over displacements and rotations of nodes, from another program. (K9)
///
/// Nodes that the program constrained are taken as constrained to the carrier; their mass is the carrier's.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// The nodes, and the mass matrix.
    pub mass: NodalMass,
    /// Stiffness matrix over the same rows: rows, columns and entries, both triangles.
    pub stiffness: Vec<(usize, usize, f64)>,
    /// Damping matrix.
    pub damping: Vec<(usize, usize, f64)>,
    /// Rheology of this stiffness: response to periodic strain.
    pub rheology: Rheology,
}

/// Energy of a rigid motion, as a share of the terms that cancel in it, below which it is rounding of the numbers in a file.
const RIGID_ENERGY_ROUNDING: f64 = 1e-12;

impl Matrices {
    /// Adds the blocks of the matrices to a structure that has their nodes.
    pub(super) fn assemble_into(&self, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        let Seat { place, first, rayleigh } = seat;
        self.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))?;
        let matrices = [
            (Field::MASS, self.mass.entries.as_slice()),
            (Field::DAMPING, &self.damping),
            (Field::STIFFNESS, &self.stiffness),
        ];
        let blocks = self.mass.blocks(place, matrices)?;
        let masses = blocks.iter().map(|(pair, [mass, ..])| (*pair, mass));
        let lumps = self.mass.lumps(masses).map_err(at(place, Field::MASS))?;
        let material = structure.material(&self.rheology, rayleigh);
        for (pair, matrices) in &blocks {
            structure.elements.push(Box::new(self.mass.element(*pair, first, material, matrices, &lumps)));
        }
        Ok(())
    }

    /// Number of a node without a row for some displacement: the other program constrained it.
    pub(super) fn held(&self) -> Option<u64> {
        let held = self.mass.moves().iter().position(|moves| moves[..3].contains(&false))?;
        Some(self.mass.node_labels[held])
    }

    /// Whether the stiffness resists every rigid motion of the whole: the other program constrained nodes that it does not name.
    pub(super) fn stands(&self) -> bool {
        let rigid = self.mass.rigid();
        let size = |row: usize| rigid.row(row).norm();
        let scale: f64 = self.stiffness.iter().map(|(i, j, entry)| entry.abs() * size(*i) * size(*j)).sum();
        let energies = rigid.tr_mul(&times(&self.stiffness, &rigid)).symmetric_eigenvalues();
        !energies.is_empty() && energies.min() > RIGID_ENERGY_ROUNDING * scale
    }

    /// Constraints of the nodes whose components have no row.
    pub(super) fn constraints(&self) -> Vec<Constraint> {
        self.mass.moves().into_iter().map(Constraint::Partly).collect()
    }
}

#[cfg(test)]
mod tests;
