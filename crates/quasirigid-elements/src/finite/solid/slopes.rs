use nalgebra::{DMatrix, Matrix3, Vector3};

use super::{bending, dilatation};
use quasirigid_mesh::{CellSample, Rule, Shape};

/// Slopes of the displacements of a cell at the points of a rule.
pub(super) struct Slopes {
    /// `∂N_a/∂x_k`: rows `3a + k`, first of the nodes, then of the cell's own displacements; a column per point.
    pub gradients: DMatrix<f64>,
    /// Volume (m³) of each point.
    pub volumes: Vec<f64>,
    /// Correction of the strain in each direction by the smoothed dilatation, where there is one: rows and columns as of `gradients`.
    pub dilatation: Option<DMatrix<f64>>,
}

impl Slopes {
    pub fn new(shape: Shape, nodes: &[Vector3<f64>], rule: Rule) -> Self {
        let samples = shape.samples(rule);
        let own = if shape == Shape::Hex8 { bending::OWN } else { 0 };
        let mut gradients = DMatrix::zeros(3 * (nodes.len() + own), samples.len());
        let mut volumes = Vec::with_capacity(samples.len());
        let middle = bending::Middle::new(shape, nodes);
        for (sample, mut column) in samples.iter().zip(gradients.column_iter_mut()) {
            let jacobian = jacobian(nodes, sample);
            let determinant = jacobian.determinant();
            let inverse = inverse(&jacobian);
            let column = column.as_mut_slice();
            for (slope, along) in column.chunks_exact_mut(3).zip(&sample.gradients[..nodes.len()]) {
                slope.copy_from_slice((inverse * Vector3::from(*along)).as_slice());
            }
            if own > 0 {
                middle.slopes(sample.at, determinant, &mut column[3 * nodes.len()..]);
            }
            volumes.push(sample.weight * determinant);
        }
        let smoothed = rule == Rule::Slopes && matches!(shape, Shape::Hex20 | Shape::Hex27);
        let dilatation = smoothed.then(|| dilatation::correction(&gradients, &volumes, samples));
        Self { gradients, volumes, dilatation }
    }
}

/// Columns times the volumes of their points.
pub(super) fn weighted(columns: &DMatrix<f64>, volumes: &[f64]) -> DMatrix<f64> {
    let mut weighted = columns.clone();
    weighted.column_iter_mut().zip(volumes).for_each(|(mut column, volume)| column *= *volume);
    weighted
}

/// `∫ u_r v_s dV` of fields whose values at the points are the rows of two matrices.
pub(super) fn products(u: &DMatrix<f64>, v: &DMatrix<f64>, volumes: &[f64]) -> DMatrix<f64> {
    weighted(u, volumes) * v.transpose()
}

/// Columns `∂x/∂ξ_k`.
pub(super) fn jacobian(nodes: &[Vector3<f64>], sample: &CellSample) -> Matrix3<f64> {
    let mut jacobian = Matrix3::zeros();
    for (node, along) in nodes.iter().zip(&sample.gradients) {
        jacobian += node * Vector3::from(*along).transpose();
    }
    jacobian
}

/// `J⁻ᵀ`, from derivatives on the reference cell to those in space; NaN of a flat cell.
pub(super) fn inverse(jacobian: &Matrix3<f64>) -> Matrix3<f64> {
    jacobian.try_inverse().map_or_else(|| Matrix3::repeat(f64::NAN), |inverse| inverse.transpose())
}
