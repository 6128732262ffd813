//! Interface of a finite element: stiffness, mass, damping, lumped masses and geometric stiffness over its nodes.
//! A structure sees all elements through this; the lumped masses carry the inertia invariants, which the mass matrix alone does not give.
//! Equations (K3) and (K6), docs/theory/12-structures.md.

use nalgebra::{DMatrix, DVector, Matrix3xX, Vector3};

/// Connectivity of an element: nodes, their degrees of freedom, and material.
#[derive(Clone, Debug)]
pub(crate) struct Connectivity {
    /// Nodes that the element joins.
    pub nodes: Vec<usize>,
    /// Degrees of freedom of each of them: 3, or 6 if nodes have rotations.
    pub dofs: usize,
    /// Number of the element's material, which determines the dissipation.
    pub material: usize,
}

/// Element of elastic material between nodes, in the axes of the file's frame.
///
/// Degrees of freedom are numbered node by node: the three displacements (m), and where a node also has rotations these three (rad).
pub(crate) trait Element: Sync {
    /// Nodes, their degrees of freedom and the material of the element.
    fn connectivity(&self) -> &Connectivity;

    /// Nodes that the element joins.
    fn nodes(&self) -> &[usize] {
        &self.connectivity().nodes
    }

    /// Degrees of freedom of each of them.
    fn dofs(&self) -> usize {
        self.connectivity().dofs
    }

    /// Number of the element's material.
    fn material(&self) -> usize {
        self.connectivity().material
    }

    /// Stiffness over the element's degrees of freedom.
    fn stiffness(&self) -> DMatrix<f64>;

    /// Mass matrix over the element's degrees of freedom. (K3)
    fn mass(&self) -> DMatrix<f64> {
        let size = self.nodes().len() * self.dofs();
        let add = |sum: DMatrix<f64>, lumped_mass: &LumpedMass| {
            sum + lumped_mass.mass * lumped_mass.shapes.tr_mul(&lumped_mass.shapes)
        };
        self.lumped_masses().iter().fold(DMatrix::zeros(size, size), add)
    }

    /// Damping by dashpots over the element's degrees of freedom; none of an element without dashpots.
    fn damping(&self) -> Option<DMatrix<f64>> {
        None
    }

    /// Lumped masses; sums over them are exact for the products of two displacements.
    fn lumped_masses(&self) -> Vec<LumpedMass>;

    /// Geometric stiffness of the stress that forces per mass (N/kg, by place) produce, and the displacement that they cause; none if the
    /// paths of its points are straight. (K6)
    fn geometric(
        &self,
        _displacement: &DVector<f64>,
        _force: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        None
    }
}

/// Lumped mass: a material point of an element (paper, §1), with `r = Σ H_j q_j` over the degrees of freedom of the element.
#[derive(Clone, Debug)]
pub(crate) struct LumpedMass {
    /// Mass (kg).
    pub mass: f64,
    /// Place of the mass.
    pub location: MassLocation,
    /// Displacement for a unit of each degree of freedom.
    pub shapes: Matrix3xX<f64>,
    /// Rotation that moves the mass on an arm; none if there is no arm.
    pub turn: Option<Turn>,
}

/// Place of a lumped mass.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MassLocation {
    /// At an equilibrium position (m), in the file's frame.
    At(Vector3<f64>),
    /// Between two places, with their distance (m): mass that is moved by the difference of two displacements alone, and may
    /// be negative.
    Between(Vector3<f64>),
}

impl LumpedMass {
    /// Value at the mass of a field that is one everywhere.
    pub fn one(&self) -> f64 {
        match self.location {
            MassLocation::At(_) => 1.0,
            MassLocation::Between(_) => 0.0,
        }
    }

    /// Value at the mass of the position from a point (m).
    pub fn place_from(&self, reference: Vector3<f64>) -> Vector3<f64> {
        match self.location {
            MassLocation::At(place) => place - reference,
            MassLocation::Between(distance) => distance,
        }
    }
}

/// Second order of the path of the end of an arm that two rotations carry, `½ (θ × (φ × p) + φ × (θ × p))`. (K6)
pub(crate) fn carried(theta: &Vector3<f64>, phi: &Vector3<f64>, arm: &Vector3<f64>) -> Vector3<f64> {
    0.5 * (theta.cross(&phi.cross(arm)) + phi.cross(&theta.cross(arm)))
}

/// A rotation that carries a lumped mass: `½ θ × (θ × arm)` is the second order of its path.
#[derive(Clone, Debug)]
pub(crate) struct Turn {
    /// The lumped mass from the centre of the rotation (m).
    pub arm: Vector3<f64>,
    /// Rotation for a unit of each degree of freedom.
    pub shapes: Matrix3xX<f64>,
}
