/// A rigid appendage on a hinge with one, two or three rotational axes: a boom, a whip antenna, a panel.
///
/// The axes turn one inside the other like gimbals: the first is fixed in the carrier, the second is carried by
/// the first, the third by the second. At equilibrium they have the directions given here.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinged {
    /// Unique name.
    pub name: String,
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass at equilibrium (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Inertia tensor (kg·m²) about the appendage's own centre of mass, in the file's axes. A thin rod has none
    /// about its own line.
    pub inertia: [[f64; 3]; 3],
    /// Where the hinge sits (m), in the file's frame.
    pub hinge: [f64; 3],
    /// Hinge axes, outermost first; any length but zero.
    pub axes: Vec<[f64; 3]>,
    /// Rotational stiffness (N·m/rad), one value per axis or a symmetric matrix in the order of the axes.
    pub stiffness: HingeCoefficient,
    /// Rotational damping (N·m·s/rad), in the same form.
    pub damping: HingeCoefficient,
}

/// A symmetric linear map from hinge angles to hinge torques.
#[derive(Clone, Debug, PartialEq)]
pub enum HingeCoefficient {
    /// One value per axis.
    PerAxis(Vec<f64>),
    /// Full symmetric matrix, one row per axis.
    Full(Vec<Vec<f64>>),
}
