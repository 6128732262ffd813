use nalgebra::{DMatrix, Matrix6};

use super::element::{Connectivity, Element, LumpedMass};

/// Block of matrices that another program gives between nodes.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub connectivity: Connectivity,
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    /// The mass as material points.
    pub lumped_masses: Vec<LumpedMass>,
}

impl Block {
    /// Block between two nodes, or of one with itself, over the degrees of freedom of an element of these.
    pub fn spread(block: &Matrix6<f64>, dofs: usize, own: bool) -> DMatrix<f64> {
        let part = block.view((0, 0), (dofs, dofs));
        if own {
            return part.into_owned();
        }
        let mut matrix = DMatrix::zeros(2 * dofs, 2 * dofs);
        matrix.view_mut((0, dofs), (dofs, dofs)).copy_from(&part);
        matrix.view_mut((dofs, 0), (dofs, dofs)).copy_from(&part.transpose());
        matrix
    }
}

impl Element for Block {
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
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

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        self.lumped_masses.clone()
    }
}
