//! Surfaces from meshes of cells, gmsh, VTK or Abaqus: their faces, with curved ones taken as plane.

use quasirigid_mesh::{Mesh, Shape};

use super::TriangleMesh;
use super::draft::Draft;
use super::error::{Fault, MeshProblem, Place};

/// The faces of a mesh without solid cells.
pub(super) fn surface(mesh: Mesh) -> Result<TriangleMesh, Fault> {
    let mut draft = Draft::new();
    let (mut curved, mut lines) = (0, 0);
    draft.vertices = mesh.nodes;
    let mut corners = Vec::new();
    for cell in &mesh.cells {
        let count = match cell.shape {
            Shape::Line2 | Shape::Line3 => {
                lines += 1;
                continue;
            }
            Shape::Triangle3 | Shape::Triangle6 => 3,
            Shape::Quad4 | Shape::Quad8 | Shape::Quad9 => 4,
            _ => return Err((Place::File, MeshProblem::Solids)),
        };
        curved += usize::from(cell.nodes.len() > count);
        corners.clear();
        corners.extend(cell.nodes[..count].iter().map(|node| u32::try_from(*node).unwrap_or(u32::MAX)));
        draft.polygon(&corners, 0);
    }
    for (count, what) in [(curved, "curved faces taken as plane"), (lines, "lines left out")] {
        if count > 0 {
            draft.remarks.push(format!("{count} {what}"));
        }
    }
    draft.finish(0)
}
