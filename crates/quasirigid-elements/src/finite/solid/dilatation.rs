//! Dilatation of quadratic hexahedra, without which they lock where the material is nearly incompressible.

use nalgebra::{DMatrix, Matrix4, Matrix4xX, Vector4};

use super::slopes::weighted;
use quasirigid_mesh::CellSample;

/// Correction of the strain by the smoothed dilatation of each displacement: a third of `d̄_ai − ∂N_a/∂x_i` in each direction, where `d̄`
/// is the linear function of the reference coordinates nearest to the dilatation in the mean square over the cell `[@hughes1980]`. Rows `3a
/// + i`, a column per point.
///
/// The mean over the cell does not change, so that a constant stress still needs no force inside a body.
pub(super) fn correction(gradients: &DMatrix<f64>, volumes: &[f64], samples: &[CellSample]) -> DMatrix<f64> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use quasirigid_mesh::{Rule, Shape};

    /// A linear dilatation needs no correction, and the mean of the correction vanishes.
    #[test]
    fn the_correction_is_that_of_a_projection() {
        for shape in [Shape::Hex20, Shape::Hex27] {
            let samples = shape.samples(Rule::Slopes);
            let volumes: Vec<f64> =
                samples.iter().map(|at| at.weight * (1.0 + 0.3 * at.at[0] * at.at[1])).collect();
            let gradients = DMatrix::from_fn(3 * shape.nodes(), samples.len(), |row, at| {
                samples[at].gradients[row / 3][row % 3]
            });
            let change = correction(&gradients, &volumes, samples);
            assert!(change.amax() > 0.1 && weighted(&change, &volumes).column_sum().amax() < 1e-14);
            let linear = &gradients + 3.0 * &change;
            assert!(correction(&linear, &volumes, samples).amax() < 1e-14);
        }
    }
}
