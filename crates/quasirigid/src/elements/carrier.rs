/// The rigid body `G` that carries everything else (paper, §1).
#[derive(Clone, Debug, PartialEq)]
pub struct Carrier {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Inertia tensor (kg·m²) about the carrier's own centre of mass, in the file's axes.
    pub inertia: [[f64; 3]; 3],
}
