//! Dilatation of quadratic hexahedra, without which they lock where the material is nearly incompressible.

use nalgebra::{DMatrix, Matrix4, Matrix4xX, Vector4};

use super::slopes::weighted;
use crate::math::mesh::Sample;

/// What the dilatation of each displacement changes in its strain: a third of `d̄_ai − ∂N_a/∂x_i` in each direction, where
/// `d̄` is the linear function of the reference coordinates that comes nearest to the dilatation in the mean square over
/// the cell `[@hughes1980]`. Rows `3a + i`, a column per point.
///
/// The mean over the cell does not change, so that a constant stress still needs no force inside a body.
pub(super) fn correction(gradients: &DMatrix<f64>, volumes: &[f64], samples: &[Sample]) -> DMatrix<f64> {
    let linear = Matrix4xX::from_fn(
        samples.len(),
        |row, point| if row == 0 { 1.0 } else { samples[point].at[row - 1] },
    );
    let mut gram = Matrix4::zeros();
    for (function, volume) in linear.column_iter().zip(volumes) {
        let function: Vector4<f64> = function.into_owned();
        gram += *volume * function * function.transpose();
    }
    let shares = match gram.cholesky() {
        Some(factor) => factor.solve(&linear),
        None => linear.clone() * f64::NAN,
    };
    let means = weighted(gradients, volumes) * linear.transpose();
    (means * shares - gradients) / 3.0
}
