//! To what order the equations of a body are those of the body.

use super::{Assembly, CavityShape, End, Kind, Law, Regime};

/// What leaves terms out of the equations of a body, in the full system and in the reduced one alike. (S1)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Incomplete {
    /// Liquids in cavities that are no rings: the square of their velocity beyond that of slow flows. (L21)
    Liquids,
    /// Ellipsoids: strain is linear.
    Ellipsoids,
    /// Solids inside surfaces: strain is linear.
    Surfaces,
    /// Shapes and matrices from other programs: displacements are linear.
    Shapes,
    /// Axial springs: their force is linear in the displacement. (I10)
    AxialSprings,
    /// Springs at places on appendages: they see the displacement to first order. (I10)
    SpringsOnAppendages,
    /// Hinges: paths are of second order. (I8)
    Hinges,
    /// Beams, panels and solids: paths are of second order. (K7)
    Structures,
}

impl Incomplete {
    /// Highest order `p` at which nothing is missing.
    #[must_use]
    pub fn order(self) -> usize {
        match self {
            Self::Liquids
            | Self::Ellipsoids
            | Self::Surfaces
            | Self::Shapes
            | Self::AxialSprings
            | Self::SpringsOnAppendages => 3,
            Self::Hinges | Self::Structures => 5,
        }
    }
}

impl Assembly {
    /// What leaves terms of order `p` and below out of the equations, the lowest order first.
    #[must_use]
    pub fn incomplete_at(&self, order: usize) -> Vec<Incomplete> {
        let shaped = |kind: &Kind| matches!(kind, Kind::Matrices(_) | Kind::Modes(_));
        let flows = |shape: &CavityShape| !matches!(shape, CavityShape::Ring { .. });
        let on_appendage = |end: End| matches!(end, End::Hinged(_));
        let liquid = |regime: &Regime, shape| *regime == Regime::Viscous && flows(shape);
        let all = [
            (Incomplete::Liquids, self.cavities.iter().any(|each| liquid(&each.regime, &each.shape))),
            (Incomplete::Ellipsoids, !self.ellipsoids.is_empty()),
            (Incomplete::Surfaces, !self.surfaces.is_empty()),
            (Incomplete::Shapes, self.parts.iter().any(|part| shaped(&part.kind))),
            (Incomplete::AxialSprings, self.springs.iter().any(|each| matches!(each.law, Law::Axial { .. }))),
            (
                Incomplete::SpringsOnAppendages,
                self.springs.iter().any(|each| on_appendage(each.from) || on_appendage(each.to)),
            ),
            (
                Incomplete::Hinges,
                !self.hinged.is_empty() || self.connections.iter().any(|each| !each.axes.is_empty()),
            ),
            (Incomplete::Structures, self.parts.iter().any(|part| !shaped(&part.kind))),
        ];
        let there = all.into_iter().filter(|(_, there)| *there).map(|(what, _)| what);
        there.filter(|what| what.order() < order).collect()
    }
}
