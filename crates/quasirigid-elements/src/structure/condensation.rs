/// Number of coordinates that parts of finite elements keep, beside the number of their unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condensation {
    /// Displacements and rotations of nodes, angles of joints, coordinates of modes.
    pub unknowns: usize,
    /// Coordinates of the flexible body that hold their slow motion.
    pub coordinates: usize,
    /// Largest share of its elastic energy that a response loses: one of those to the loads of a spin and of external forces, to the order
    /// that is kept.
    pub left_out: f64,
}
