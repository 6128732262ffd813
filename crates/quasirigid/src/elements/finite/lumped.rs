use nalgebra::{DMatrix, Matrix3, Matrix3xX, Vector3};

use super::element::{Element, Grain, Site, Turn};
use crate::model::Inertia;

/// Mass without stiffness at a node, a point or a small rigid body.
#[derive(Clone, Debug)]
pub(in crate::elements) struct Mass {
    pub node: usize,
    /// Freedoms of the node.
    pub freedoms: usize,
    pub matter: usize,
    /// Material points of the same mass and moments: the mass of each, and where it is from the node.
    pub points: Vec<(f64, Vector3<f64>)>,
    /// Where the node is.
    pub place: Vector3<f64>,
}

/// A spring between two nodes that acts on their displacement relative to each other.
#[derive(Clone, Debug)]
pub(in crate::elements) struct Link {
    pub nodes: [usize; 2],
    pub matter: usize,
    /// Force for a displacement.
    pub stiffness: Matrix3<f64>,
    /// Force for its rate.
    pub damping: Matrix3<f64>,
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
        3
    }

    fn matter(&self) -> usize {
        self.matter
    }

    fn stiffness(&self) -> DMatrix<f64> {
        between(&self.stiffness)
    }

    fn damping(&self) -> Option<DMatrix<f64>> {
        Some(between(&self.damping))
    }

    fn grains(&self) -> Vec<Grain> {
        Vec::new()
    }
}

/// A law for the displacement of the second end relative to the first, over both.
fn between(law: &Matrix3<f64>) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(6, 6);
    for (row, column, sign) in [(0, 0, 1.0), (3, 3, 1.0), (0, 3, -1.0), (3, 0, -1.0)] {
        matrix.view_mut((row, column), (3, 3)).copy_from(&(sign * law));
    }
    matrix
}

/// Six points with the mass and the inertia of a rigid body about its centre: masses, and places from it.
pub(in crate::elements) fn rigid_points(mass: f64, inertia: &Inertia) -> Vec<(f64, Vector3<f64>)> {
    let eigen = inertia.second_moments().symmetric_eigen();
    let arms = (0..3).map(|axis| {
        let length = (3.0 * eigen.eigenvalues[axis].max(0.0) / mass).sqrt();
        length * eigen.eigenvectors.column(axis)
    });
    arms.flat_map(|arm| [(mass / 6.0, arm), (mass / 6.0, -arm)]).collect()
}
