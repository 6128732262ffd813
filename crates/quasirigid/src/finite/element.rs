use nalgebra::{DMatrix, DVector, Matrix3xX, Vector3};

/// A piece of elastic matter between nodes, in the axes of the file's frame.
///
/// Freedoms are numbered node by node: the three displacements (m), and where a node also turns its three rotations (rad).
pub(crate) trait Element {
    /// Nodes it joins.
    fn nodes(&self) -> &[usize];

    /// Freedoms of each of them: 3, or 6 if nodes turn.
    fn freedoms(&self) -> usize;

    /// Number of the matter it is made of, which says how it dissipates.
    fn matter(&self) -> usize;

    /// Stiffness over its freedoms.
    fn stiffness(&self) -> DMatrix<f64>;

    /// Mass matrix over its freedoms. (K3)
    fn mass(&self) -> DMatrix<f64> {
        let size = self.nodes().len() * self.freedoms();
        let add = |sum: DMatrix<f64>, grain: &Grain| sum + grain.mass * grain.shapes.tr_mul(&grain.shapes);
        self.grains().iter().fold(DMatrix::zeros(size, size), add)
    }

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
pub(crate) struct Grain {
    /// Mass (kg).
    pub mass: f64,
    /// Where it is.
    pub site: Site,
    /// Displacement for a unit of each freedom.
    pub shapes: Matrix3xX<f64>,
    /// What turns it on an arm; none if nothing does.
    pub turn: Option<Turn>,
}

/// Where a grain is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Site {
    /// At an equilibrium position (m), in the file's frame.
    At(Vector3<f64>),
    /// Between two places, with their distance (m): mass that is moved by the difference of two displacements alone, and may
    /// be negative.
    Between(Vector3<f64>),
}

impl Grain {
    /// The value on it of a field that is one everywhere.
    pub fn one(&self) -> f64 {
        match self.site {
            Site::At(_) => 1.0,
            Site::Between(_) => 0.0,
        }
    }

    /// The value on it of the place from a point (m).
    pub fn place_from(&self, reference: Vector3<f64>) -> Vector3<f64> {
        match self.site {
            Site::At(place) => place - reference,
            Site::Between(distance) => distance,
        }
    }
}

/// A rotation that carries a grain: `½ θ × (θ × arm)` is the second order of its path.
#[derive(Clone, Debug)]
pub(crate) struct Turn {
    /// The grain from the centre of the rotation (m).
    pub arm: Vector3<f64>,
    /// Rotation for a unit of each freedom.
    pub shapes: Matrix3xX<f64>,
}
