use nalgebra::{DMatrix, Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use super::bending::Enriched;
use super::slopes::{Slopes, products};
use crate::finite::elasticity::VOIGT;
use quasirigid_mesh::{Rule, Shape};

/// Stiffness (N/m) of a solid cell over the displacements of its nodes, node by node x y z.
///
/// ```text
/// K_ai,bj = Σ_kl D_ik,jl ∫ ∂N_a/∂x_k ∂N_b/∂x_l dV
/// ```
///
/// `D` is the elasticity (Pa) in the axes of the nodes, over xx yy zz yz zx xy with engineering shears.
pub(crate) fn stiffness(shape: Shape, nodes: &[Vector3<f64>], D: &Matrix6<f64>) -> DMatrix<f64> {
    by_rule(shape, nodes, D, Rule::Slopes)
}

/// Stiffness by the points of a rule.
pub(super) fn by_rule(shape: Shape, nodes: &[Vector3<f64>], D: &Matrix6<f64>, rule: Rule) -> DMatrix<f64> {
    let slopes = Slopes::new(shape, nodes, rule);
    let full = full(&slopes, D);
    if shape == Shape::Hex8 { Enriched(full).condensed() } else { full }
}

/// Stiffness over all displacements whose slopes are given.
pub(super) fn full(slopes: &Slopes, D: &Matrix6<f64>) -> DMatrix<f64> {
    let products = products(&slopes.gradients, &slopes.gradients, &slopes.volumes);
    let tensor = tensor(D);
    let size = products.nrows();
    let mut stiffness = DMatrix::zeros(size, size);
    for a in (0..size).step_by(3) {
        for b in (a..size).step_by(3) {
            let product: Matrix3<f64> = products.fixed_view::<3, 3>(a, b).into_owned();
            let block = tensor * SMatrix::<f64, 9, 1>::from_column_slice(product.as_slice());
            let block = Matrix3::from_column_slice(block.as_slice());
            stiffness.fixed_view_mut::<3, 3>(a, b).copy_from(&block);
            stiffness.fixed_view_mut::<3, 3>(b, a).copy_from(&block.transpose());
        }
    }
    if let Some(dilatation) = &slopes.dilatation {
        stiffness += of_dilatation(slopes, dilatation, D);
    }
    stiffness
}

/// Stiffness that a correction `c` of the strain in each direction adds, with the stress `S` and the pressure sum `p` of a unit strain in
/// all directions: `K_ai,bj += S_ik ∫ ∂N_a/∂x_k c_bj dV + S_jl ∫ c_ai ∂N_b/∂x_l dV + p ∫ c_ai c_bj dV`.
fn of_dilatation(slopes: &Slopes, dilatation: &DMatrix<f64>, D: &Matrix6<f64>) -> DMatrix<f64> {
    let pressure = D * Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0);
    let stress = Matrix3::from_fn(|i, k| pressure[VOIGT[i][k]]);
    let mut forces = slopes.gradients.clone();
    for mut column in forces.column_iter_mut() {
        for slope in column.as_mut_slice().chunks_exact_mut(3) {
            let force = stress * Vector3::from_column_slice(slope);
            slope.copy_from_slice(force.as_slice());
        }
    }
    // (s + p c/2) cᵀ and its transpose make up all three terms.
    forces += 0.5 * stress.trace() * dilatation;
    let half = products(&forces, dilatation, &slopes.volumes);
    &half + half.transpose()
}

/// Elasticity as a matrix with rows `i + 3j` and columns `k + 3l` of `D_ik,jl`.
fn tensor(D: &Matrix6<f64>) -> SMatrix<f64, 9, 9> {
    SMatrix::from_fn(|ij, kl| D[(VOIGT[ij % 3][kl % 3], VOIGT[ij / 3][kl / 3])])
}
