//! Elements without cells: a mass at a node, and a link of springs and dashpots between two nodes.
//! A rigid body at a node is six material points with its moments, so that it enters every sum over lumped masses as elements do.
//! Equations (K3) and (I11), docs/theory.

use nalgebra::{DMatrix, Matrix3, Matrix3xX, SMatrix, Vector3};

use super::element::{Connectivity, Element, LumpedMass, MassLocation, Turn};
use crate::model::Inertia;

/// Mass without stiffness at a node, a point or a small rigid body.
#[derive(Clone, Debug)]
pub(crate) struct Mass {
    /// The node alone.
    pub connectivity: Connectivity,
    /// Material points with the mass and moments of the body: the mass of each, and its position from the node.
    pub points: Vec<(f64, Vector3<f64>)>,
    /// Place of the node.
    pub place: Vector3<f64>,
}

/// Link: springs and dashpots between two nodes.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    connectivity: Connectivity,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
}

impl Link {
    /// Link whose strain is a sum over the two nodes of linear maps of their degrees of freedom, with its force per strain and per rate of
    /// strain.
    pub fn new<const N: usize>(
        nodes: [usize; 2],
        material: usize,
        strain: [SMatrix<f64, N, N>; 2],
        [stiffness, damping]: [SMatrix<f64, N, N>; 2],
    ) -> Self {
        let law = |law: SMatrix<f64, N, N>| {
            let mut matrix = DMatrix::zeros(2 * N, 2 * N);
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let part = strain[row].transpose() * law * strain[column];
                matrix.view_mut((N * row, N * column), (N, N)).copy_from(&part);
            }
            matrix
        };
        let connectivity = Connectivity { nodes: nodes.to_vec(), dofs: N, material };
        Self { connectivity, stiffness: law(stiffness), damping: law(damping) }
    }
}

impl Element for Mass {
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    fn stiffness(&self) -> DMatrix<f64> {
        DMatrix::zeros(self.dofs(), self.dofs())
    }

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        let lumped_mass = |(mass, arm): &(f64, Vector3<f64>)| {
            let mut shapes = Matrix3xX::zeros(self.dofs());
            shapes.columns_mut(0, 3).copy_from(&Matrix3::identity());
            let turn = (self.dofs() == 6).then(|| {
                shapes.columns_mut(3, 3).copy_from(&-arm.cross_matrix());
                let mut rotations = Matrix3xX::zeros(6);
                rotations.columns_mut(3, 3).copy_from(&Matrix3::identity());
                Turn { arm: *arm, shapes: rotations }
            });
            LumpedMass { mass: *mass, location: MassLocation::At(self.place + arm), shapes, turn }
        };
        self.points.iter().map(lumped_mass).collect()
    }
}

impl Element for Link {
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    fn stiffness(&self) -> DMatrix<f64> {
        self.stiffness.clone()
    }

    fn damping(&self) -> Option<DMatrix<f64>> {
        Some(self.damping.clone())
    }

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        Vec::new()
    }
}

/// Six points with the mass and the inertia of a rigid body about its centre: masses, and places from it.
pub(crate) fn rigid_points(mass: f64, inertia: &Inertia) -> Vec<(f64, Vector3<f64>)> {
    let eigen = inertia.second_moments().symmetric_eigen();
    let arms = (0..3).map(|axis| {
        let length = (3.0 * eigen.eigenvalues[axis].max(0.0) / mass).sqrt();
        length * eigen.eigenvectors.column(axis)
    });
    arms.flat_map(|arm| [(mass / 6.0, arm), (mass / 6.0, -arm)]).collect()
}
