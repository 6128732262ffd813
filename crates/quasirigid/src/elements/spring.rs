/// A linear spring with a linear dashpot beside it, between two ends.
///
/// It acts on the displacement of one end relative to the other, taken in body axes, so a body that turns
/// steadily does not work it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// One end.
    pub from: End,
    /// The other end.
    pub to: End,
    /// Force per displacement and force per rate.
    pub law: Law,
}

/// What an end of a spring is fixed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// The carrier.
    Carrier,
    /// The point with this index in [`Assembly::points`](super::Assembly::points).
    Point(usize),
}

/// Stiffness and damping of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Force `−(stiffness · r + damping · ṙ)` for a relative displacement `r`.
    Spatial {
        /// Stiffness (N/m).
        stiffness: Coefficient,
        /// Damping (N·s/m).
        damping: Coefficient,
    },
    /// Force along the line that joins the ends at equilibrium, and none across it.
    Axial {
        /// Stiffness (N/m).
        stiffness: f64,
        /// Damping (N·s/m).
        damping: f64,
        /// Where the carrier's end sits (m, file's frame); needed when one end is the carrier.
        anchor: Option<[f64; 3]>,
    },
}

/// A symmetric linear map from displacement to force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coefficient {
    /// The same in every direction.
    Isotropic(f64),
    /// One value per axis of the file's frame.
    Diagonal([f64; 3]),
    /// Full symmetric matrix in the axes of the file's frame.
    Full([[f64; 3]; 3]),
}
