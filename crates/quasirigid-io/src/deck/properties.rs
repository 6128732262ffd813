//! Properties and materials of a deck, in its unit.

/// A material.
#[derive(Clone, Copy)]
pub(crate) enum Stuff {
    Isotropic {
        young: f64,
        poisson: f64,
        density: f64,
        loss: f64,
    },
    /// With three planes of symmetry: moduli along 1, 2, 3, then ν and G of 12, 13, 23.
    Orthotropic {
        young: [f64; 3],
        poisson: [f64; 3],
        shear: [f64; 3],
        density: f64,
        loss: f64,
    },
    /// Of a ply: moduli along and across, ν₁₂, G₁₂, G₁₃, G₂₃.
    Lamina {
        young: [f64; 2],
        poisson: f64,
        shear: [f64; 3],
        density: f64,
        loss: f64,
    },
}

impl Stuff {
    /// Density, in the unit of the deck.
    pub fn density(&self) -> f64 {
        match self {
            Self::Isotropic { density, .. }
            | Self::Orthotropic { density, .. }
            | Self::Lamina { density, .. } => *density,
        }
    }
}

/// A layer of a plate.
#[derive(Clone, Copy)]
pub(crate) struct Ply {
    pub material: u64,
    pub thickness: f64,
    /// Angle (degrees).
    pub angle: f64,
}

/// Plies of laminated solids, lowest first.
pub(crate) struct Laminate {
    pub plies: Vec<Ply>,
    /// Axes of the material, from 0, from which the angles of plies count and along which they are stacked.
    pub directions: [usize; 2],
}

/// Layers of plates, lowest first.
pub(crate) struct Plating {
    pub layers: Vec<Ply>,
    /// Height of the lowest face; none for a middle on the grid points.
    pub bottom: Option<f64>,
    /// Mass per area beside that of the layers.
    pub extra: f64,
}

/// Sections of beams along their length.
#[derive(Clone)]
pub(crate) struct Bending {
    pub material: u64,
    /// From the first end on, by ascending shares of the length; between them they change linearly, behind the last one they do not.
    pub stations: Vec<Station>,
    /// Factors of the shear areas; none where shear is neglected.
    pub shear: Option<[f64; 2]>,
}

/// Section of a beam in two planes: plane 1 has the first direction.
#[derive(Clone, Copy, Default, PartialEq)]
pub(crate) struct Station {
    /// Share of the length.
    pub at: f64,
    pub area: f64,
    /// Moments of bending in plane 1 and 2, and the product.
    pub moments: [f64; 3],
    pub torsion: f64,
    /// Mass per length beside that of the material.
    pub extra: f64,
}

/// Section of rods.
#[derive(Clone, Copy)]
pub(crate) struct RodSection {
    pub material: u64,
    pub area: f64,
    pub extra: f64,
}
