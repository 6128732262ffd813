//! Removal of slivers: small cells that are not connected to any body.

use super::MeshingError;
use super::jacobian::six_volumes;
use super::simplices::Simplices;
use quasirigid_math::connected_components::connected_components;

/// Share of the volume of all cells below which a connected part is a sliver.
const SLIVER: f64 = 1e-3;

/// Cells without slivers: parts that share no node with the largest ones, of which there are as many as `bodies`. Slivers remain in tips
/// that are thinner than a cell.
///
/// # Errors
/// [`MeshingError::Severed`] where such a part is no sliver; suggests twice the `resolution`.
pub(super) fn without_slivers(
    Simplices { points, cells }: Simplices<4, 3>,
    bodies: usize,
    resolution: usize,
) -> Result<Simplices<4, 3>, MeshingError> {
    let pairs = cells.iter().flat_map(|[a, b, c, d]| [[*a, *b], [*a, *c], [*a, *d]]);
    let parts = connected_components(points.len(), pairs);
    let mut part_of = vec![0; points.len()];
    for (number, part) in parts.iter().enumerate() {
        part.iter().for_each(|point| part_of[*point] = number);
    }
    let mut volumes = vec![0.0; parts.len()];
    for cell in &cells {
        volumes[part_of[cell[0]]] += six_volumes(cell.map(|corner| points[corner]));
    }
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by(|a, b| volumes[*b].total_cmp(&volumes[*a]));
    let least = SLIVER * volumes.iter().sum::<f64>();
    let large = volumes.iter().filter(|volume| **volume >= least).count();
    if large > bodies {
        return Err(MeshingError::Severed { parts: large, bodies, resolution: resolution.saturating_mul(2) });
    }
    let mut kept = vec![false; parts.len()];
    order.iter().take(bodies).for_each(|part| kept[*part] = true);
    let mut number = vec![0; points.len()];
    let mut left = Vec::with_capacity(points.len());
    for (point, place) in points.into_iter().enumerate().filter(|(point, _)| kept[part_of[*point]]) {
        number[point] = left.len();
        left.push(place);
    }
    let cells = cells.into_iter().filter(|cell| kept[part_of[cell[0]]]);
    Ok(Simplices { points: left, cells: cells.map(|cell| cell.map(|corner| number[corner])).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tetrahedra of some sizes, side by side.
    fn row(sizes: &[f64]) -> Simplices<4, 3> {
        let corners = |(k, size): (usize, &f64)| {
            let (x, size) = (2.0 * k as f64, *size);
            [[x, 0.0, 0.0], [x + size, 0.0, 0.0], [x, size, 0.0], [x, 0.0, size]]
        };
        let points = sizes.iter().enumerate().flat_map(corners).collect();
        let cells = (0..sizes.len()).map(|k| [0, 1, 2, 3].map(|corner| 4 * k + corner)).collect();
        Simplices { points, cells }
    }

    #[test]
    fn slivers_go_and_bodies_stay() {
        let left = without_slivers(row(&[0.05, 0.9, 0.09, 1.0, 0.04]), 2, 7).unwrap();
        assert_eq!(left.cells, [[0, 1, 2, 3], [4, 5, 6, 7]]);
        assert_eq!([left.points[1], left.points[4]], [[2.9, 0.0, 0.0], [6.0, 0.0, 0.0]]);
        let left = without_slivers(row(&[0.05, 0.9, 0.09, 1.0]), 3, 7).unwrap();
        assert_eq!((left.points.len(), left.cells.len()), (12, 3));
        assert!(without_slivers(row(&[]), 1, 7).unwrap().cells.is_empty());
    }

    #[test]
    fn a_part_that_is_no_sliver_is_refused() {
        let refusal = without_slivers(row(&[1.0, 0.11, 0.09]), 1, 7);
        assert_eq!(refusal.err(), Some(MeshingError::Severed { parts: 2, bodies: 1, resolution: 14 }));
    }
}
