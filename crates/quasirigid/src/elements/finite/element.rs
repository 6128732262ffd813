use nalgebra::{DMatrix, DVector, Matrix3xX, Vector3};

/// A piece of elastic matter between nodes, in the axes of the file's frame.
///
/// Freedoms are numbered node by node: the three displacements (m), and where a node also turns its three rotations (rad).
pub(in crate::elements) trait Element {
    /// Nodes it joins.
    fn nodes(&self) -> &[usize];

    /// Freedoms of each of them: 3, or 6 if nodes turn.
    fn freedoms(&self) -> usize;

    /// Number of the matter it is made of, which says how it dissipates.
    fn matter(&self) -> usize;

    /// Stiffness over its freedoms.
    fn stiffness(&self) -> DMatrix<f64>;

    /// Damping by dashpots over its freedoms; none if it has no dashpots.
    fn damping(&self) -> Option<DMatrix<f64>> {
        None
    }

    /// Its mass as material points; sums over them are exact for the products of two displacements.
    fn grains(&self) -> Vec<Grain>;

    /// Geometric stiffness of the stress that forces per mass (N/kg, by place) produce, and the displacement that they cause;
    /// none if the paths of its points are straight. (K6)
    fn geometric(
        &self,
        _displacement: &DVector<f64>,
        _force: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        None
    }
}

/// A material point of an element: paper, §1, with `r = Σ H_j q_j` over the freedoms of the element.
#[derive(Clone, Debug)]
pub(in crate::elements) struct Grain {
    /// Mass (kg).
    pub mass: f64,
    /// Equilibrium position (m), in the file's frame.
    pub place: Vector3<f64>,
    /// Displacement for a unit of each freedom.
    pub shapes: Matrix3xX<f64>,
    /// What turns it on an arm; none if nothing does.
    pub turn: Option<Turn>,
}

/// A rotation that carries a grain: `½ θ × (θ × arm)` is the second order of its path.
#[derive(Clone, Debug)]
pub(in crate::elements) struct Turn {
    /// The grain from the centre of the rotation (m).
    pub arm: Vector3<f64>,
    /// Rotation for a unit of each freedom.
    pub shapes: Matrix3xX<f64>,
}
