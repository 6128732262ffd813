//! Quadratic displacements of a hexahedron of 8 nodes, without which it is far too stiff in bending.

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};

use super::slopes::{inverse, jacobian};
use quasirigid_mesh::{CellSample, MAX_NODES, Shape};

/// Displacements `1 − ξ²`, `1 − η²`, `1 − ζ²`, in three directions each.
pub(super) const OWN: usize = 3;

/// The middle of a cell: its Jacobian determinant and `J⁻ᵀ` there.
pub(super) struct Middle {
    determinant: f64,
    inverse: Matrix3<f64>,
}

impl Middle {
    pub fn new(shape: Shape, nodes: &[Vector3<f64>]) -> Self {
        let at = [0.0; 3];
        let sample =
            CellSample { at, weight: 0.0, functions: [0.0; MAX_NODES], gradients: shape.gradients(at) };
        let jacobian = jacobian(nodes, &sample);
        Self { determinant: jacobian.determinant(), inverse: inverse(&jacobian) }
    }

    /// `∇P_m = −2 ξ_m (j₀/j) J₀⁻ᵀ e_m`: with the Jacobian of the middle their mean over the cell vanishes, so that a
    /// constant strain needs none of them in a cell of any form `[@taylor1976]`.
    pub fn slopes(&self, at: [f64; 3], determinant: f64, slopes: &mut [f64]) {
        for (axis, slope) in slopes.chunks_exact_mut(3).enumerate() {
            let factor = -2.0 * at[axis] * self.determinant / determinant;
            slope.copy_from_slice((factor * self.inverse.column(axis)).as_slice());
        }
    }
}

/// A stiffness over the displacements of the nodes and the cell's own.
pub(super) struct Enriched(pub DMatrix<f64>);

impl Enriched {
    /// Displacements of the cell itself per displacement of the nodes, in balance without a force: `−K_aa⁻¹ K_au`.
    pub fn own(&self) -> DMatrix<f64> {
        let nodes = self.0.nrows() - 3 * OWN;
        let own: SMatrix<f64, 9, 9> = self.0.fixed_view::<9, 9>(nodes, nodes).into_owned();
        let coupled = self.0.view((nodes, 0), (3 * OWN, nodes)).into_owned();
        match own.cholesky() {
            Some(factor) => -factor.solve(&coupled),
            None => coupled * f64::NAN,
        }
    }

    /// The stiffness over the displacements of the nodes alone: `K_uu − K_ua K_aa⁻¹ K_au`.
    pub fn condensed(&self) -> DMatrix<f64> {
        let nodes = self.0.nrows() - 3 * OWN;
        let mut condensed = self.0.view((0, 0), (nodes, nodes)).into_owned();
        condensed.gemm(1.0, &self.0.view((0, nodes), (nodes, 3 * OWN)), &self.own(), 1.0);
        condensed
    }

    /// Displacements of the nodes, followed by the cell's own.
    pub fn completed(&self, displacement: &DVector<f64>) -> DVector<f64> {
        let own = self.own() * displacement;
        DVector::from_iterator(self.0.nrows(), displacement.iter().chain(&own).copied())
    }
}
