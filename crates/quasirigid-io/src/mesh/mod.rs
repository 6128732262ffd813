//! Surfaces of triangles from files: OBJ, STL, PLY, OFF, VRML, glTF, VTK, plate tables. Meshes of cells from files of gmsh, VTK and
//! Abaqus.
//!
//! Numbers are taken as they are, in the unit of the file; whether the triangles bound a body is for
//! [`repaired`](quasirigid_mesh::surface::repaired) to say. Polygons become triangles in one place, `draft.rs`, which all formats share.
//! No more memory is taken than a small multiple of the size of the file, whatever the file announces.

mod cells;
mod draft;
mod error;
mod file;
mod format;
mod gltf;
mod label;
mod obj;
mod off;
mod plates;
mod ply;
mod row;
mod stl;
mod text;
mod volume;
mod vrml;

use std::path::Path;

use crate::text_file::{FileError, bytes_of};
pub use error::{MeshError, MeshProblem, Part, Place};
use file::MAX_FILE;
use format::Format;
pub use row::Row;
pub(crate) use volume::abaqus as inp;
use volume::vtk;
pub(crate) use volume::{DensityRule, VoxelRule, read_volume_by};
pub use volume::{VolumeFile, VolumeProblem, VoxelProblem, mesh_of, read_mesh, read_volume, volume_of};

/// Triangles as a file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Coordinates of the vertices, finite.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each triangle: indices of vertices, from 0.
    pub triangles: Vec<[usize; 3]>,
    /// Choices of the reader that the file left open, and what of it was left out, each in words.
    pub remarks: Vec<String>,
    /// Length of one unit of the file (m), with who says so: the file itself or its label.
    pub unit: Option<(f64, String)>,
}

/// Reads the triangles of a file; its beginning tells the format, and its ending where the beginning leaves a doubt. A label beside the
/// file, `.lbl` or `.xml`, tells its unit.
///
/// - Wavefront OBJ: `v` and `f`, also with texture and normal or counting back from the last vertex; the rest is ignored. Tables
///   with the same rows, perhaps with their numbers before them. Where a corner is 0, corners count from 0, else from 1.
/// - Plate tables of the Planetary Data System: numbers of vertices and faces, in one line or each before its rows, or left out; then
///   `x y z` and `a b c`, with or without the number of the row before them. Corners count from 0 or 1 as in OBJ.
/// - STL, as text or binary: corners with the same coordinates, bit for bit, become one vertex. Normals are ignored; the order of the
///   corners tells the side.
/// - PLY, as text or binary of either byte order: `x`, `y`, `z` of each `vertex` and the list `vertex_indices` of each
///   `face`, among any other properties and elements.
/// - OFF as text, with normals, colours or texture or none. VRML 1 and 2: every `IndexedFaceSet`; a scene that moves or resizes parts
///   is refused. glTF, JSON or binary: every triangle of the scene, moved by its nodes.
/// - VTK: surfaces, legacy or XML. Faces of meshes of cells of VTK, gmsh and Abaqus.
///
/// # Errors
/// [`MeshError`] says what is wrong and where: by line in a text, by byte in a binary file.
pub fn read_triangles(file: &Path) -> Result<TriangleMesh, MeshError> {
    let mut mesh = triangles_of(file, &bytes_of(file, MAX_FILE)?)?;
    if mesh.unit.is_none() {
        mesh.unit = label::unit(file)?;
    }
    Ok(mesh)
}

/// The triangles in the bytes of a file, whose name tells the format where the bytes do not, and the folder of others that it names.
///
/// # Errors
/// Those of [`read_triangles`], except that the file cannot be read.
pub fn triangles_of(file: &Path, bytes: &[u8]) -> Result<TriangleMesh, MeshError> {
    let named = FileError::new(file);
    let mesh: TriangleMesh = match Format::of(file, bytes).map_err(named)? {
        Format::Obj => obj::read(bytes),
        Format::StlText => stl::read_text(bytes),
        Format::StlBinary => stl::read_binary(bytes),
        Format::Ply => ply::read(bytes),
        Format::Plates => plates::read(bytes),
        Format::Off => off::read(bytes),
        Format::Vrml => vrml::read(bytes),
        Format::Gltf => gltf::read(file, bytes),
        Format::VtkLegacy => vtk::read_legacy_polygons(bytes).and_then(|surface| surface.draft.finish(0)),
        Format::VtkXml => vtk::read_xml_polygons(bytes).and_then(|surface| surface.draft.finish(0)),
        Format::Cells => cells::surface(mesh_of(file, bytes)?),
    }
    .map_err(named)?;
    if mesh.triangles.is_empty() {
        return Err(named((Place::File, MeshProblem::Nothing { part: Part::Faces })));
    }
    Ok(mesh)
}
