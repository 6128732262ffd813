use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Matrix6, Vector3, Vector6};

use super::bending::Enriched;
use super::slopes::Slopes;
use super::stiffness::full;
use crate::finite::elasticity::VOIGT;
use quasirigid_mesh::{Rule, Shape};

/// Geometric stiffness (N/m) of a solid cell for one component of the displacement, node by node: stiffening by the stress `σ` of a
/// displacement `u` (m, node by node x y z) against further motion.
///
/// ```text
/// S_ab = ∫ ∂N_a/∂x_k σ_kl ∂N_b/∂x_l dV,     σ = D ε(u)
/// ```
///
/// The geometric stiffness over all displacements is this times the 3×3 identity. `D` is the elasticity (Pa) in the
/// axes of the nodes, over xx yy zz yz zx xy with engineering shears. In a hexahedron of 8 nodes the stress is that
/// of its own displacements as well.
pub(crate) fn geometric(
    shape: Shape,
    nodes: &[Vector3<f64>],
    D: &Matrix6<f64>,
    u: &DVector<f64>,
) -> DMatrix<f64> {
    let slopes = Slopes::new(shape, nodes, Rule::Slopes);
    let displacement = if shape == Shape::Hex8 { Enriched(full(&slopes, D)).completed(u) } else { u.clone() };
    let by_node = Matrix3xX::from_column_slice(displacement.as_slice());
    let mut geometric = DMatrix::zeros(nodes.len(), nodes.len());
    for (point, volume) in slopes.volumes.iter().enumerate() {
        let gradients = Matrix3xX::from_column_slice(slopes.gradients.column(point).as_slice());
        let mut gradient = &by_node * gradients.transpose();
        if let Some(dilatation) = &slopes.dilatation {
            gradient += Matrix3::identity() * dilatation.column(point).dot(&displacement);
        }
        let stress = stress(&gradient, D);
        let nodal = gradients.columns(0, nodes.len());
        geometric.gemm_tr(*volume, &nodal, &(stress * nodal), 1.0);
    }
    geometric
}

/// Stress (Pa) of the displacement gradient `∂u_i/∂x_k`.
fn stress(gradient: &Matrix3<f64>, D: &Matrix6<f64>) -> Matrix3<f64> {
    let strain = gradient + gradient.transpose();
    let half = 0.5 * strain;
    let strain = Vector6::new(
        half[(0, 0)],
        half[(1, 1)],
        half[(2, 2)],
        strain[(1, 2)],
        strain[(2, 0)],
        strain[(0, 1)],
    );
    let stress = D * strain;
    Matrix3::from_fn(|i, k| stress[VOIGT[i][k]])
}
