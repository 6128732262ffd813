use nalgebra::{DMatrix, Matrix3, Matrix3xX, SMatrix, Vector3};

use super::element::{Element, Grain, Site, Turn};
use crate::model::Inertia;

/// Mass without stiffness at a node, a point or a small rigid body.
#[derive(Clone, Debug)]
pub(crate) struct Mass {
    pub node: usize,
    /// Freedoms of the node.
    pub freedoms: usize,
    pub matter: usize,
    /// Material points of the same mass and moments: the mass of each, and where it is from the node.
    pub points: Vec<(f64, Vector3<f64>)>,
    /// Where the node is.
    pub place: Vector3<f64>,
}

/// A spring between two nodes.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    nodes: [usize; 2],
    freedoms: usize,
    matter: usize,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
}

impl Link {
    /// Spring whose strain is a sum over the two nodes, a map of the freedoms of each, with its force for a strain and for the rate of
    /// one.
    pub fn new<const N: usize>(
        nodes: [usize; 2],
        matter: usize,
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
        Self { nodes, freedoms: N, matter, stiffness: law(stiffness), damping: law(damping) }
    }
}

impl Element for Mass {
    fn nodes(&self) -> &[usize] {
        std::slice::from_ref(&self.node)
    }

    fn freedoms(&self) -> usize {
        self.freedoms
    }

    fn matter(&self) -> usize {
        self.matter
    }

    fn stiffness(&self) -> DMatrix<f64> {
        DMatrix::zeros(self.freedoms, self.freedoms)
    }

    fn grains(&self) -> Vec<Grain> {
        let grain = |(mass, arm): &(f64, Vector3<f64>)| {
            let mut shapes = Matrix3xX::zeros(self.freedoms);
            shapes.columns_mut(0, 3).copy_from(&Matrix3::identity());
            let turn = (self.freedoms == 6).then(|| {
                shapes.columns_mut(3, 3).copy_from(&-arm.cross_matrix());
                let mut turns = Matrix3xX::zeros(6);
                turns.columns_mut(3, 3).copy_from(&Matrix3::identity());
                Turn { arm: *arm, shapes: turns }
            });
            Grain { mass: *mass, site: Site::At(self.place + arm), shapes, turn }
        };
        self.points.iter().map(grain).collect()
    }
}

impl Element for Link {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn freedoms(&self) -> usize {
        self.freedoms
    }

    fn matter(&self) -> usize {
        self.matter
    }

    fn stiffness(&self) -> DMatrix<f64> {
        self.stiffness.clone()
    }

    fn damping(&self) -> Option<DMatrix<f64>> {
        Some(self.damping.clone())
    }

    fn grains(&self) -> Vec<Grain> {
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
