//! Mean of the motions of nodes: the rigid motion nearest to them by least squares.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};

use super::Weighted;
use crate::structure::Constraint;

/// Share of the largest eigenvalue below which the other nodes do not determine a motion of their mean, which is then zero.
const UNDETERMINED: f64 = 1e-10;

/// Constraint of a node on the rigid motion nearest to the weighted motions of other nodes:
/// `u = (Σ w s sᵀ)⁺ Σ w s (d·uᵢ)`, `s = (d, r × d)`.
pub(super) fn mean(node: usize, others: &[Weighted], places: &[[f64; 3]], first: usize) -> Constraint {
    let arm = |other: &Weighted| Vector3::from(places[other.node]) - Vector3::from(places[node]);
    let distances = others.iter().map(|other| arm(other).norm());
    let length = distances.sum::<f64>() / others.len().max(1) as f64;
    let length = if length > 0.0 { length } else { 1.0 };
    let mut turns: BTreeMap<usize, bool> = BTreeMap::new();
    for other in others {
        *turns.entry(other.node).or_default() |= !other.rotations.is_empty();
    }
    let (mut columns, mut starts) = (Vec::new(), BTreeMap::new());
    for (node, turns) in turns {
        starts.insert(node, columns.len());
        columns.extend((0..if turns { 6 } else { 3 }).map(|component| (node, component)));
    }
    let mut normal = Matrix6::zeros();
    let mut right = DMatrix::zeros(6, columns.len());
    for other in others {
        let mut add = |row: Vector6<f64>, weight: f64, direction: [f64; 3], from: usize| {
            normal += weight * row * row.transpose();
            for (axis, share) in direction.iter().enumerate() {
                let mut sum = right.column_mut(starts[&other.node] + from + axis);
                sum += weight * share * row;
            }
        };
        for direction in &other.displacements {
            let d = Vector3::from(*direction);
            let moment = arm(other).cross(&d) / length;
            add(Vector6::new(d.x, d.y, d.z, moment.x, moment.y, moment.z), other.weight, *direction, 0);
        }
        for axis in &other.rotations {
            let [x, y, z] = *axis;
            let turned = [length * x, length * y, length * z];
            add(Vector6::new(0.0, 0.0, 0.0, x, y, z), other.weight, turned, 3);
        }
    }
    let eigen = normal.symmetric_eigen();
    let least = UNDETERMINED * eigen.eigenvalues.amax();
    let inverse = (0..6).filter(|k| eigen.eigenvalues[*k] > least).fold(Matrix6::zeros(), |sum, k| {
        let v = eigen.eigenvectors.column(k);
        sum + v * v.transpose() / eigen.eigenvalues[k]
    });
    let mut shares = DMatrix::from_fn(6, columns.len(), |i, j| {
        (0..6).map(|k| inverse[(i, k)] * right[(k, j)]).sum::<f64>()
    });
    shares.rows_mut(3, 3).scale_mut(length.recip());
    let columns =
        columns.into_iter().map(|(node, component): (usize, usize)| (first + node, component)).collect();
    Constraint::Shaped { columns, shares }
}
