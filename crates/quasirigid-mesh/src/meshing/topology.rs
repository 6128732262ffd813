//! Topology of a mesh against that of the surface that it fills.

use std::collections::{HashMap, HashSet};

use super::MeshingError;
use crate::surface::ClosedSurface;

/// Corners of the faces of a tetrahedron.
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// Accepts cells whose wall has the Euler characteristic of the surface, 2 less twice the number of handles: a ring that cells tear where
/// it is thinner than they are, and arms that they join across a gap, are other bodies.
///
/// # Errors
/// [`MeshingError::Torn`]; suggests twice the `resolution`.
pub(super) fn same_topology(
    surface: &ClosedSurface,
    cells: &[[usize; 4]],
    resolution: usize,
) -> Result<(), MeshingError> {
    let (found, expected) = (characteristic(&wall(cells)), characteristic(surface.triangles()));
    if found == expected {
        return Ok(());
    }
    Err(MeshingError::Torn { found, expected, resolution: resolution.saturating_mul(2) })
}

/// Faces of one cell only.
fn wall(cells: &[[usize; 4]]) -> Vec<[usize; 3]> {
    let mut single: HashMap<[usize; 3], [usize; 3]> = HashMap::new();
    for cell in cells {
        for corners in FACES {
            let face = corners.map(|corner| cell[corner]);
            let mut key = face;
            key.sort_unstable();
            if single.remove(&key).is_none() {
                single.insert(key, face);
            }
        }
    }
    single.into_values().collect()
}

/// Corners less edges plus triangles.
fn characteristic(triangles: &[[usize; 3]]) -> i64 {
    let corners: HashSet<usize> = triangles.iter().flatten().copied().collect();
    let sides = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let edges: HashSet<[usize; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    corners.len() as i64 - edges.len() as i64 + triangles.len() as i64
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::{MeshingError, graded, inside};
    use super::*;
    use crate::surface::testing::{ball, turned};

    /// A ring around z with the radius of its tube at each angle.
    fn ring(unit: f64, tube: impl Fn(f64) -> f64) -> ClosedSurface {
        let (steps, around) = (36, 10);
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..steps {
            let angle = TAU * i as f64 / steps as f64;
            for j in 0..around {
                let turn = TAU * j as f64 / around as f64;
                let r = 1.0 + tube(angle) * turn.cos();
                vertices.push(turned(unit)([r * angle.cos(), r * angle.sin(), tube(angle) * turn.sin()]));
                let at = |i: usize, j: usize| around * (i % steps) + j % around;
                triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        ClosedSurface::new(vertices, triangles).unwrap()
    }

    #[test]
    fn a_ring_is_filled_as_a_ring_or_refused() {
        for unit in [1e-4, 1.0, 1e4] {
            let even = ring(unit, |_| 0.3);
            assert_eq!(characteristic(even.triangles()), 0);
            assert!(inside(&even, 20).is_ok() && graded(&even, None, 6000).is_ok());
            // Thin at one place: its volume is there all the same.
            let thin = ring(unit, |angle| 0.3 * (1.0 - 0.75 * (-8.0 * (angle - 3.0).powi(2)).exp()));
            for refusal in [inside(&thin, 14), graded(&thin, None, 5000).map(|found| found.mesh)] {
                assert!(
                    matches!(refusal, Err(MeshingError::Torn { expected: 0, .. })),
                    "{:?}",
                    refusal.err()
                );
            }
        }
    }

    #[test]
    fn cells_that_share_a_corner_or_an_edge_alone_are_torn() {
        let surface = ball(3, turned(1.0));
        assert_eq!(same_topology(&surface, &[[0, 1, 2, 3], [0, 2, 1, 4]], 5), Ok(()));
        for cells in [[[0, 1, 2, 3], [0, 4, 5, 6]], [[0, 1, 2, 3], [0, 1, 4, 5]]] {
            let refusal = same_topology(&surface, &cells, 5);
            assert_eq!(refusal, Err(MeshingError::Torn { found: 3, expected: 2, resolution: 10 }));
        }
    }
}
