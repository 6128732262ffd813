//! Surfaces of triangles from files: OBJ, STL, PLY and plate tables. Meshes of cells from files of gmsh, VTK and
//! Abaqus.
//!
//! Numbers are taken as they are, in the unit of the file; whether the triangles bound a body is for
//! [`ClosedSurface`](quasirigid_mesh::surface::ClosedSurface) to say. Polygons become fans of triangles about their
//! first corner. No more memory is taken than a small multiple of the size of the file, whatever the file announces.

mod error;
mod file;
mod format;
mod obj;
mod plates;
mod ply;
mod row;
mod stl;
mod text;
mod volume;

use std::path::Path;

use crate::text_file::{FileError, bytes_of};
pub use error::{MeshError, MeshProblem, Part, Place};
use file::MAX_FILE;
use format::Format;
pub use row::Row;
pub use volume::{VolumeFile, VolumeProblem, mesh_of, read_mesh, read_volume, volume_of};

/// Triangles as a file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Coordinates of the vertices, finite.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each triangle: indices of vertices, from 0.
    pub triangles: Vec<[usize; 3]>,
}

/// Reads the triangles of a file; its beginning tells the format, and its ending (`.obj`, `.stl`, `.ply`, or `.tab`,
/// `.plt` for plate tables, which may also be `.txt`) where the beginning leaves a doubt.
///
/// - Wavefront OBJ: `v` and `f`, also with texture and normal or counting back from the last vertex; the rest is ignored.
/// - STL, as text or binary: corners with the same coordinates, bit for bit, become one vertex. Corners that are only
///   close stay apart, so that the surface is open there. Normals are ignored; the order of the corners tells the side.
/// - PLY, as text or binary of either byte order: `x`, `y`, `z` of each `vertex` and the list `vertex_indices` of each
///   `face`, among any other properties and elements.
/// - Plate tables of the Planetary Data System: the number of vertices, perhaps of plates beside it, then `number x y z`,
///   then the number of plates if it is still to come, then `number a b c`; all count from 1.
///
/// # Errors
/// [`MeshError`] says what is wrong and where: by line in a text, by byte in a binary file.
pub fn read_triangles(file: &Path) -> Result<TriangleMesh, MeshError> {
    triangles_of(file, &bytes_of(file, MAX_FILE)?)
}

/// The triangles in the bytes of a file, whose name tells the format where the bytes do not.
///
/// # Errors
/// Those of [`read_triangles`], except that the file cannot be read.
pub fn triangles_of(file: &Path, bytes: &[u8]) -> Result<TriangleMesh, MeshError> {
    let read = || match Format::of(file, bytes)? {
        Format::Obj => obj::read(bytes),
        Format::StlText => stl::read_text(bytes),
        Format::StlBinary => stl::read_binary(bytes),
        Format::Ply => ply::read(bytes),
        Format::Plates => plates::read(bytes),
    };
    let named = FileError::new(file);
    let mesh: TriangleMesh = read().map_err(named)?;
    if mesh.triangles.is_empty() {
        return Err(named((Place::File, MeshProblem::Nothing { part: Part::Faces })));
    }
    Ok(mesh)
}

impl TriangleMesh {
    /// Adds a polygon as a fan of triangles about its first corner.
    fn fan(&mut self, corners: &[usize]) -> Result<(), MeshProblem> {
        let [first, second, rest @ ..] = corners else {
            return Err(MeshProblem::Corners { found: corners.len() });
        };
        if rest.is_empty() {
            return Err(MeshProblem::Corners { found: corners.len() });
        }
        let mut before = *second;
        for corner in rest {
            self.triangles.push([*first, before, *corner]);
            before = *corner;
        }
        Ok(())
    }
}
