//! Meshes of cells from files: gmsh, VTK, Abaqus, NASTRAN, Exodus, MED and voxels.

pub(crate) mod abaqus;
mod arrays;
mod draft;
mod exodus;
mod gmsh;
mod kinds;
mod med;
mod nastran;
mod others;
mod problem;
mod sets;
mod voxels;
pub(super) mod vtk;

use std::path::Path;

use quasirigid_mesh::Mesh;

use super::error::{Fault, MeshError, MeshProblem, Part, Place};
use super::file::MAX_FILE;
use crate::nastran::op2;
use crate::pyramid;
use crate::text_file::{FileError, bytes_of, kind_of};
use arrays::{Container, Hdf5, NetCdf};
pub use problem::VolumeProblem;
pub use voxels::VoxelProblem;
pub(crate) use voxels::{DensityRule, VoxelRule};

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
/// - NASTRAN bulk data: solids, plates and lines between grid points in whatever coordinate systems, with `INCLUDE` of files in the
///   folder of the first one or below it, or the geometry of an `OUTPUT2` file. The cells of each property are a set, by its number.
/// - Exodus II, in classic netCDF or netCDF-4. Each block of elements is a set of cells and each set of nodes one of nodes, by its name, or
///   by its number, with `ns` before that of nodes.
/// - MED 3 and 4 of Salome and Code_Aster. Each group of cells or nodes is a set.
/// - Voxels, NumPy `.npy` of three dimensions, NRRD or the pages of a TIFF file: labels, of which 0 is empty, are sets `value=3`.
///
/// Cells are segments, triangles, quadrilaterals, tetrahedra, wedges and hexahedra, of first or second order, pyramids of five nodes
/// are two tetrahedra each; they come out in the node order of [`Shape`](quasirigid_mesh::Shape); cells of one node are left out. Numbers
/// are taken as they are, in the unit of the file. No geometry is checked here.
///
/// # Errors
/// [`MeshError`] says what is wrong and where: by line in a text, by byte in a binary file.
pub fn read_mesh(file: &Path) -> Result<Mesh, MeshError> {
    read_volume(file).map(|read| read.mesh)
}

/// A mesh, and what its file has beyond it.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeFile {
    /// The mesh.
    pub mesh: Mesh,
    /// What was left out or changed in reading, in words with counts.
    pub notes: Vec<String>,
    /// Density (kg/m³) of each cell, where a rule for voxels gave them.
    pub(crate) densities: Option<Vec<f64>>,
}

/// Reads a mesh as [`read_mesh`], with what was left out.
///
/// # Errors
/// Those of [`read_mesh`].
pub fn read_volume(file: &Path) -> Result<VolumeFile, MeshError> {
    read_volume_by(file, &VoxelRule::default())
}

/// Reads a mesh, of voxels by a rule.
///
/// # Errors
/// Those of [`read_mesh`].
pub(crate) fn read_volume_by(file: &Path, rule: &VoxelRule) -> Result<VolumeFile, MeshError> {
    volume_by(file, &bytes_of(file, MAX_FILE)?, rule)
}

/// The mesh in the bytes of a file, whose name gives the folder of included files.
///
/// # Errors
/// Those of [`read_mesh`].
pub fn mesh_of(file: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    volume_of(file, bytes).map(|read| read.mesh)
}

/// The mesh in the bytes of a file, with what was left out.
///
/// # Errors
/// Those of [`read_mesh`].
pub fn volume_of(file: &Path, bytes: &[u8]) -> Result<VolumeFile, MeshError> {
    volume_by(file, bytes, &VoxelRule::default())
}

fn volume_by(file: &Path, bytes: &[u8], rule: &VoxelRule) -> Result<VolumeFile, MeshError> {
    let named = FileError::new(file);
    let format = Format::of(file, bytes).map_err(named)?;
    let (mesh, mut notes) = match format {
        Format::Npy => return voxels::read_npy(bytes, rule).map_err(named),
        Format::Nrrd => return voxels::read_nrrd(file, bytes, rule),
        Format::Tiff => return voxels::read_tiff(bytes, rule).map_err(named),
        _ if rule.density.is_some() => {
            return Err(named((Place::File, VolumeProblem::from(VoxelProblem::NoVoxels).into())));
        }
        Format::Container(container) => of_container(container, bytes).map_err(named)?,
        Format::Gmsh => (gmsh::read(bytes).map_err(named)?, Vec::new()),
        Format::VtkLegacy => (vtk::read_legacy(bytes).map_err(named)?, Vec::new()),
        Format::VtkXml => (vtk::read_xml(bytes).map_err(named)?, Vec::new()),
        Format::Abaqus => abaqus::read(file, bytes)?,
        Format::Nastran => nastran::read(file, bytes)?,
    };
    if mesh.cells.is_empty() {
        return Err(named((Place::File, VolumeProblem::NoCells.into())));
    }
    if format != Format::Nastran {
        notes.extend(pyramid::note(&mesh));
    }
    Ok(VolumeFile { mesh, notes, densities: None })
}

/// The mesh of Exodus or MED in a container.
fn of_container(container: Container, bytes: &[u8]) -> Result<(Mesh, Vec<String>), Fault> {
    let nothing = |container: &'static str| (Place::File, VolumeProblem::NoMeshInside { container }.into());
    if container == Container::NetCdf {
        let file = NetCdf::read(bytes)?;
        return if exodus::is_mesh(&file) { exodus::read(&file) } else { Err(nothing("netCDF")) };
    }
    let file = Hdf5::read(bytes)?;
    if med::is_mesh(&file) {
        med::read(&file)
    } else if exodus::is_mesh(&file) {
        exodus::read(&file)
    } else {
        Err(nothing("HDF5"))
    }
}

/// Format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Container(Container),
    Gmsh,
    VtkLegacy,
    VtkXml,
    Abaqus,
    Nastran,
    Npy,
    Nrrd,
    Tiff,
}

impl Format {
    fn of(file: &Path, bytes: &[u8]) -> Result<Self, Fault> {
        if let Some(container) = Container::of(bytes) {
            return Ok(Self::Container(container));
        }
        let beginning = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
        match beginning {
            [] => Err((Place::File, MeshProblem::Empty)),
            _ if bytes.starts_with(b"\x93NUMPY") => Ok(Self::Npy),
            _ if bytes.starts_with(b"NRRD") => Ok(Self::Nrrd),
            _ if voxels::is_tiff(bytes) => Ok(Self::Tiff),
            _ if op2::Layout::of(bytes).is_some() => Ok(Self::Nastran),
            _ if is_deck(file, beginning) => Ok(Self::Nastran),
            [b'$', ..] => Ok(Self::Gmsh),
            [b'*', ..] => Ok(Self::Abaqus),
            [b'<', ..] => Ok(Self::VtkXml),
            _ if beginning.starts_with(b"# vtk DataFile") => Ok(Self::VtkLegacy),
            _ => Err((Place::File, VolumeProblem::NotAMesh { kind: kind_of(bytes) }.into())),
        }
    }
}

/// Whether a file is bulk data of NASTRAN: no section of gmsh comes first, but a word of a deck or an ending of one.
fn is_deck(file: &Path, beginning: &[u8]) -> bool {
    if [&b"$MeshFormat"[..], b"$Comments", b"$NOD"].iter().any(|word| beginning.starts_with(word)) {
        return false;
    }
    let ending = file.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let lines = beginning.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let mut lines = lines.filter(|line| !line.is_empty() && !line.starts_with(b"$"));
    let Some(first) = lines.next() else { return false };
    if matches!(first, [b'*' | b'<' | b'#', ..]) {
        return false;
    }
    const WORDS: [&[u8]; 13] = [
        b"SOL", b"CEND", b"BEGIN", b"GRID", b"GRDSET", b"INCLUDE", b"NASTRAN", b"ID", b"ASSIGN", b"INIT",
        b"TITLE", b"PARAM", b"MAT1",
    ];
    let word = first.split(|byte| !byte.is_ascii_alphanumeric()).next().unwrap_or_default();
    let system = word.get(..4).is_some_and(|start| start.eq_ignore_ascii_case(b"CORD"));
    ["bdf", "nas", "dat", "blk", "pch"].iter().any(|known| ending.eq_ignore_ascii_case(known))
        || system
        || WORDS.iter().any(|known| word.eq_ignore_ascii_case(known))
}
