//! Completeness: the order to which the equations of a body have all the terms of the body.

use std::collections::BTreeSet;

use super::Assembly;

/// Model that leaves terms out of the equations of a body, in the full system and in the reduced one alike. (S1)
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Incomplete {
    /// Appendages from a sheet whose extent is not known: the load of a steady spin on their modes. (K17)
    SheetLoads,
    /// Liquids in cavities that are no rings: terms in the square of their velocity beyond those of slow flows. (L21)
    Liquids,
    /// Ellipsoids: strain is linear.
    Ellipsoids,
    /// Solids inside surfaces: strain is linear.
    Surfaces,
    /// Shapes and matrices from other programs: displacements are linear.
    Shapes,
    /// Appendages from a sheet: nothing of second order in their coordinates is known. (K17)
    Sheets,
    /// Axial springs: their force is linear in the displacement. (I10)
    AxialSprings,
    /// Springs at places on appendages: their displacements are linear. (I10)
    SpringsOnAppendages,
    /// Hinges: paths in the reduced equations are of second order. (I8)
    Hinges,
    /// Beams, panels and solids: paths are of second order. (K7)
    Structures,
}

impl Incomplete {
    /// Highest order `p` at which nothing is missing.
    #[must_use]
    pub fn order(self) -> usize {
        match self {
            Self::SheetLoads => 0,
            Self::Liquids
            | Self::Ellipsoids
            | Self::Surfaces
            | Self::Shapes
            | Self::Sheets
            | Self::AxialSprings
            | Self::SpringsOnAppendages => 3,
            Self::Hinges | Self::Structures => 5,
        }
    }
}

impl Assembly {
    /// Models that leave terms of order `p` and below out of the equations, the lowest order first.
    #[must_use]
    pub fn incomplete_at(&self, order: usize) -> Vec<Incomplete> {
        let all: BTreeSet<Incomplete> = self.each().flat_map(|(_, element)| element.incomplete()).collect();
        all.into_iter().filter(|terms| terms.order() < order).collect()
    }
}
