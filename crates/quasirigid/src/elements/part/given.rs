use super::nodal::NodalMass;
use crate::elements::error::{ElementError, Field, Place, at};
use crate::elements::structure::{Hold, Matter, Structure};
use crate::model::Rheology;

/// Matrices over displacements and rotations of nodes, from another program. (K9)
///
/// What the program held is taken as held on the carrier; its mass there is the carrier's.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// The nodes, and the mass matrix.
    pub mass: NodalMass,
    /// Stiffness matrix over the same rows: rows, columns and entries, both triangles.
    pub stiffness: Vec<(usize, usize, f64)>,
    /// Damping matrix.
    pub damping: Vec<(usize, usize, f64)>,
    /// How what has this stiffness answers periodic strain.
    pub rheology: Rheology,
}

impl Matrices {
    /// Adds its blocks to a structure that has its nodes.
    pub(super) fn furnish(
        &self,
        index: usize,
        first: usize,
        [per_mass, per_stiffness]: [f64; 2],
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let place = Place::Part(index);
        self.rheology.check().map_err(|error| at(place, Field::Rheology)(error.into()))?;
        let matrices = [
            (Field::Mass, self.mass.entries.as_slice()),
            (Field::Damping, &self.damping),
            (Field::Stiffness, &self.stiffness),
        ];
        let blocks = self.mass.blocks(place, matrices)?;
        let masses = blocks.iter().map(|(pair, [mass, ..])| (*pair, mass));
        let lumps = self.mass.lumps(masses).map_err(at(place, Field::Mass))?;
        let rheology = self.rheology.clone();
        let matter = structure.matter(Matter { rheology, per_mass, per_stiffness });
        for (pair, matrices) in &blocks {
            structure.elements.push(Box::new(self.mass.element(*pair, first, matter, matrices, &lumps)));
        }
        Ok(())
    }

    /// Number of a node without a row for some displacement: the other program held it.
    pub(super) fn held(&self) -> Option<u64> {
        let held = self.mass.moves().iter().position(|moves| moves[..3].contains(&false))?;
        Some(self.mass.node_labels[held])
    }

    /// How each node is held where its components have no row.
    pub(super) fn holds(&self) -> Vec<Hold> {
        self.mass.moves().into_iter().map(Hold::Partly).collect()
    }
}

#[cfg(test)]
mod tests;
