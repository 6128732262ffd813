//! Separate bodies of one surface, each with its cavities.

use super::ClosedSurface;
use super::geometry::normalised;
use super::shells::{Shell, shells};
use super::topology;

impl ClosedSurface {
    /// The bodies that the surface bounds, each with its cavities and its own vertices, the largest first.
    #[must_use]
    pub fn separated(&self) -> Vec<Self> {
        // Every edge has two triangles, as it had when the surface was accepted.
        let neighbours = topology::neighbours(&self.triangles).unwrap_or_default();
        let corners = normalised(&self.vertices, &self.triangles);
        let (bodies, cavities): (Vec<Shell>, Vec<Shell>) =
            shells(&corners, &neighbours).into_iter().partition(|shell| shell.volume > 0.0);
        let mut members: Vec<Vec<usize>> = bodies.iter().map(|body| body.triangles.clone()).collect();
        for cavity in &cavities {
            let around = (0..bodies.len()).filter(|body| bodies[*body].surrounds(cavity, &corners));
            let nearest = around.min_by(|a, b| bodies[*a].volume.total_cmp(&bodies[*b].volume));
            members[nearest.unwrap_or_default()].extend(&cavity.triangles);
        }
        let mut parts: Vec<Self> = members.into_iter().map(|members| self.part(members)).collect();
        parts.sort_by(|a, b| b.volume().total_cmp(&a.volume()));
        parts
    }

    /// The surface of some of the triangles, which are whole shells.
    fn part(&self, mut members: Vec<usize>) -> Self {
        members.sort_unstable();
        let triangles: Vec<[usize; 3]> = members.iter().map(|triangle| self.triangles[*triangle]).collect();
        let (vertices, triangles) = used(&self.vertices, triangles);
        Self::accepted(vertices, triangles)
    }
}

/// The vertices that triangles have, in their order, and the triangles with these numbers.
pub(super) fn used(
    vertices: &[[f64; 3]],
    mut triangles: Vec<[usize; 3]>,
) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let mut number = vec![usize::MAX; vertices.len()];
    triangles.iter().flatten().for_each(|corner| number[*corner] = 0);
    let mut kept = Vec::new();
    for (vertex, number) in vertices.iter().zip(&mut number).filter(|(_, number)| **number == 0) {
        *number = kept.len();
        kept.push(*vertex);
    }
    triangles.iter_mut().flatten().for_each(|corner| *corner = number[*corner]);
    (kept, triangles)
}
