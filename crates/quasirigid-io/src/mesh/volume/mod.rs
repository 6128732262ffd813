//! Meshes of cells from files: gmsh, VTK and Abaqus.

mod abaqus;
mod draft;
mod gmsh;
mod problem;
mod sets;
pub(super) mod vtk;

use std::path::Path;

use quasirigid_mesh::Mesh;

use super::error::{Fault, MeshError, MeshProblem, Part, Place};
use super::file::MAX_FILE;
use crate::text_file::{FileError, bytes_of, kind_of};
pub use problem::VolumeProblem;

/// Reads the nodes, cells and sets of a file, whose beginning tells the format.
///
/// - gmsh `.msh` 2.2 and 4.1, text or binary of either byte order, and 4.0 as text. Physical groups become sets
///   with their name, or their number where they have none: a set of a group of curves, surfaces or volumes has
///   cells, one of points has nodes. Groups of several dimensions with the same name are one set.
/// - VTK, unstructured grids: legacy `.vtk`, text or binary, up to version 5; `.vtu`, text, base64 or raw, plain or
///   compressed by zlib, of either byte order, in one piece or more. Each value of an array of whole numbers, one
///   per cell, becomes a set, `material=3`; arrays of more than a thousand values number the cells and become none.
/// - Abaqus and CalculiX `.inp`: the mesh of one part, with `*INCLUDE` of files named from the folder of the first
///   one. Sets keep the spelling they first have; capitals do not matter. Nodes stand before the cells that name
///   them, and both before the sets. Of a range, a set has what exists.
///
/// Cells are segments, triangles, quadrilaterals, tetrahedra, wedges and hexahedra, of first or second order, and
/// come out in the node order of [`Shape`](quasirigid_mesh::Shape); cells of one node are left out. Numbers
/// are taken as they are, in the unit of the file. No geometry is checked here.
///
/// # Errors
/// [`MeshError`] says what is wrong and where: by line in a text, by byte in a binary file.
pub fn read_mesh(file: &Path) -> Result<Mesh, MeshError> {
    mesh_of(file, &bytes_of(file, MAX_FILE)?)
}

/// The mesh in the bytes of a file, whose name gives the folder of included files.
///
/// # Errors
/// Those of [`read_mesh`].
pub fn mesh_of(file: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let named = FileError::new(file);
    let mesh = match Format::of(bytes).map_err(named)? {
        Format::Gmsh => gmsh::read(bytes).map_err(named)?,
        Format::VtkLegacy => vtk::read_legacy(bytes).map_err(named)?,
        Format::VtkXml => vtk::read_xml(bytes).map_err(named)?,
        Format::Abaqus => abaqus::read(file, bytes)?,
    };
    if mesh.cells.is_empty() {
        return Err(named((Place::File, VolumeProblem::NoCells.into())));
    }
    Ok(mesh)
}

/// Format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Gmsh,
    VtkLegacy,
    VtkXml,
    Abaqus,
}

impl Format {
    fn of(bytes: &[u8]) -> Result<Self, Fault> {
        let beginning = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
        match beginning {
            [] => Err((Place::File, MeshProblem::Empty)),
            [b'$', ..] => Ok(Self::Gmsh),
            [b'*', ..] => Ok(Self::Abaqus),
            [b'<', ..] => Ok(Self::VtkXml),
            _ if beginning.starts_with(b"# vtk DataFile") => Ok(Self::VtkLegacy),
            _ => Err((Place::File, VolumeProblem::NotAMesh { kind: kind_of(bytes) }.into())),
        }
    }
}
