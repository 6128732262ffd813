//! Outlines of parts: beams as lines, panels and solids as their boundary, matrices and modes as points.

use std::f64::consts::PI;

use super::{Frame, Member, Part, PartKind};
use crate::End;
use crate::NodeRef;
use crate::visual::{Outline, Vertex, boundary, thinned};
use quasirigid_mesh::Mesh;

/// Most nodes of matrices and modes that are drawn, evenly among all.
const MOST_NODES: usize = 2_500;

impl Part {
    /// Outline of the part on its nodes; `part` is its index.
    pub(super) fn drawn(&self, part: usize) -> Outline {
        let at = |node: usize| Vertex::At(End::Node(NodeRef { part, node }));
        match &self.kind {
            PartKind::Frame(frame) => Outline {
                vertices: (0..frame.places().len()).map(at).collect(),
                lines: frame.lines(),
                radius: frame.members.iter().filter_map(Member::radius).reduce(f64::max),
                ..Outline::default()
            },
            PartKind::Solid(solid) => surface(&solid.mesh, 3, at),
            PartKind::Panel(panel) => surface(&panel.mesh, 2, at),
            PartKind::Mixed(mixed) => drawn(&mixed.mesh, at),
            PartKind::Matrices(_) | PartKind::Modes(_) => {
                let count = self.count();
                let step = count.div_ceil(MOST_NODES).max(1);
                Outline { vertices: (0..count).step_by(step).map(at).collect(), ..Outline::default() }
            }
        }
    }
}

/// Boundary of the cells of a dimension.
fn surface(mesh: &Mesh, dimension: usize, at: impl Fn(usize) -> Vertex) -> Outline {
    let cells = (0..mesh.cells.len()).filter(|cell| mesh.cells[*cell].shape.dimension() == dimension);
    let (kept, triangles) = thinned(&mesh.nodes, &boundary(mesh, cells));
    Outline { vertices: kept.into_iter().map(at).collect(), triangles, ..Outline::default() }
}

/// Boundary of the solids of a mesh, or its faces where it has no solids; else its lines.
fn drawn(mesh: &Mesh, at: impl Fn(usize) -> Vertex) -> Outline {
    let highest = mesh.cells.iter().map(|cell| cell.shape.dimension()).max().unwrap_or(0);
    if highest > 1 {
        return surface(mesh, highest, at);
    }
    Outline {
        vertices: (0..mesh.nodes.len()).map(at).collect(),
        lines: mesh.cells.iter().map(|cell| [cell.nodes[0], cell.nodes[1]]).collect(),
        ..Outline::default()
    }
}

impl Frame {
    /// Lines between successive nodes of the members.
    fn lines(&self) -> Vec<[usize; 2]> {
        let mut inner = self.nodes.len();
        let mut lines = Vec::new();
        for Member { ends: [start, end], elements, .. } in &self.members {
            let steps = elements.saturating_sub(1);
            let chain: Vec<usize> =
                std::iter::once(*start).chain(inner..inner + steps).chain([*end]).collect();
            inner += steps;
            lines.extend(chain.windows(2).map(|pair| [pair[0], pair[1]]));
        }
        lines
    }
}

impl Member {
    /// Radius of a round rod with the area of the section (m).
    fn radius(&self) -> Option<f64> {
        let section = self.section.section(self.material.poisson).ok()?;
        Some((section.area / PI).sqrt())
    }
}
