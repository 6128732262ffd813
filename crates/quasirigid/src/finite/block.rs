use nalgebra::{DMatrix, Matrix6};

use super::element::{Element, Grain};

/// Matrices that another program gives between nodes.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub nodes: Vec<usize>,
    /// Freedoms of each node.
    pub freedoms: usize,
    pub matter: usize,
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    /// The mass as material points.
    pub grains: Vec<Grain>,
}

impl Block {
    /// A block between two nodes, or of one with itself, over the freedoms of an element of these.
    pub fn spread(block: &Matrix6<f64>, freedoms: usize, own: bool) -> DMatrix<f64> {
        let part = block.view((0, 0), (freedoms, freedoms));
        if own {
            return part.into_owned();
        }
        let mut matrix = DMatrix::zeros(2 * freedoms, 2 * freedoms);
        matrix.view_mut((0, freedoms), (freedoms, freedoms)).copy_from(&part);
        matrix.view_mut((freedoms, 0), (freedoms, freedoms)).copy_from(&part.transpose());
        matrix
    }
}

impl Element for Block {
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

    fn mass(&self) -> DMatrix<f64> {
        self.mass.clone()
    }

    fn grains(&self) -> Vec<Grain> {
        self.grains.clone()
    }
}
