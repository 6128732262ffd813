//! Mean of the motions of nodes: the rigid motion nearest to them by least squares.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};

use super::Weighted;
use crate::structure::Constraint;

/// Share of the largest eigenvalue below which the other nodes do not determine a motion of their mean, which is then zero.
const UNDETERMINED: f64 = 1e-10;

/// Spread of the other nodes over the size of their coordinates up to which they are at one place: their displacements turn nothing.
const ONE_PLACE: f64 = 1e-9;

/// Constraint of a node on the rigid motion nearest to the weighted motions of other nodes:
/// `(u, θ) = (Σ w s sᵀ)⁺ Σ w s (d·uᵢ)`, `s = (d, r × d)`, about the centroid of the others, so that what they do not turn keeps its rotation
/// at zero and moves with them.
pub(super) fn mean(node: usize, others: &[Weighted], places: &[[f64; 3]], first: usize) -> Constraint {
    let place = |node: usize| Vector3::from(places[node]);
    let weight: f64 = others.iter().map(|other| other.weight).sum();
    let middle = others.iter().map(|other| other.weight * place(other.node)).sum::<Vector3<f64>>() / weight;
    let distances = others.iter().map(|other| (place(other.node) - middle).norm());
    let length = distances.sum::<f64>() / others.len().max(1) as f64;
    let spread = length > ONE_PLACE * middle.norm();
    let length = if spread { length } else { 1.0 };
    let arm = |other: &Weighted| if spread { place(other.node) - middle } else { Vector3::zeros() };
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
    let carried = (place(node) - middle).cross_matrix() * shares.rows(3, 3);
    let mut displacements = shares.rows_mut(0, 3);
    displacements -= carried;
    let columns =
        columns.into_iter().map(|(node, component): (usize, usize)| (first + node, component)).collect();
    Constraint::Shaped { columns, shares }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(places: &[[f64; 3]]) -> DMatrix<f64> {
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let other =
            |node| Weighted { node, weight: 2.0, displacements: unit.to_vec(), rotations: Vec::new() };
        let others: Vec<Weighted> = (1..places.len()).map(other).collect();
        match mean(0, &others, places, 0) {
            Constraint::Shaped { shares, .. } => shares,
            other => panic!("{other:?}"),
        }
    }

    /// What displacements do not turn moves with them whole, also where rounding parts the places.
    #[test]
    fn a_point_at_one_other_point_moves_with_it() {
        for gap in [0.0, 1e-13, 1e-11] {
            let place = [3.0, -2.0, 7.0];
            let found = shares(&[place, [place[0] + gap, place[1] - gap, place[2]]]);
            let off = (found.rows(0, 3) - DMatrix::<f64>::identity(3, 3)).amax();
            assert!(off < 1e-12 && found.rows(3, 3).amax() < 1e-12, "{found}");
        }
    }

    /// Rigid motions of the others are those of the node, wherever it is.
    #[test]
    fn a_mean_follows_rigid_motions() {
        let places =
            [[9.0, 5.0, -4.0], [3.0, -2.0, 7.0], [3.5, -2.0, 7.0], [3.0, -1.0, 7.2], [4.0, -3.0, 6.0]];
        let found = shares(&places);
        let (shift, turn) = (Vector3::new(0.3, -1.0, 0.2), Vector3::new(-0.5, 0.1, 0.7));
        let moved = |place: &[f64; 3]| shift + turn.cross(&Vector3::from(*place));
        let others: Vec<f64> =
            places[1..].iter().flat_map(|place| moved(place).iter().copied().collect::<Vec<_>>()).collect();
        let of = found * nalgebra::DVector::from(others);
        let expected = moved(&places[0]);
        for axis in 0..3 {
            assert!(
                (of[axis] - expected[axis]).abs() < 1e-12 && (of[3 + axis] - turn[axis]).abs() < 1e-12,
                "{of}"
            );
        }
    }
}
