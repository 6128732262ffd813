//! Meshes of cells, and their checks.

use std::path::Path;

use quasirigid_io::mesh::mesh_of;

/// Words of gmsh files.
pub const GMSH: &[&str] = &[
    "$MeshFormat\n",
    "$EndMeshFormat\n",
    "$Nodes\n",
    "$EndNodes\n",
    "$Elements\n",
    "$EndElements\n",
    "$Entities\n",
    "$EndEntities\n",
    "$PhysicalNames\n",
    "$EndPhysicalNames\n",
    "2.2 0 8\n",
    "4.1 0 8\n",
    "4.1 1 8\n",
    "2.2 1 8\n",
    "4 0 8\n",
    "$Comments\n",
    "$EndComments\n",
];

/// Words of VTK files.
pub const VTK: &[&str] = &[
    "# vtk DataFile Version 4.2\n",
    "BINARY\n",
    "ASCII\n",
    "DATASET UNSTRUCTURED_GRID\n",
    "POINTS ",
    "CELLS ",
    "CELL_TYPES ",
    "CELL_DATA ",
    "POINT_DATA ",
    "SCALARS ",
    "LOOKUP_TABLE default\n",
    "FIELD ",
    "METADATA\n",
    " double\n",
    " vtktypeint64\n",
    "OFFSETS ",
    "CONNECTIVITY ",
    "<VTKFile",
    "<DataArray",
    "</DataArray>",
    "<AppendedData",
    "encoding=\"raw\"",
    "encoding=\"base64\"",
    "format=\"appended\"",
    "offset=\"",
    "type=\"Float64\"",
    "NumberOfPoints=\"",
    "NumberOfCells=\"",
    "NumberOfComponents=\"",
    "vtkZLibDataCompressor",
    "header_type=\"UInt64\"",
    "byte_order=\"BigEndian\"",
];

/// Words of Abaqus files.
pub const ABAQUS: &[&str] = &[
    "*NODE\n",
    "*ELEMENT, TYPE=C3D10\n",
    "*ELEMENT, TYPE=S8R, ELSET=E\n",
    "*NSET, NSET=N\n",
    "*ELSET, ELSET=E, GENERATE\n",
    "*INCLUDE, INPUT=a.inp\n",
    "*PART, NAME=P\n",
    "*END PART\n",
    "*INSTANCE, NAME=I, PART=P\n",
    "*NCOPY\n",
    "*NGEN\n",
    "**",
    ", GENERATE",
    ",",
];

pub fn read(name: &str, bytes: &[u8]) {
    let mesh = match mesh_of(Path::new(name), bytes) {
        Ok(mesh) => mesh,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    assert_eq!(mesh.nodes.len(), mesh.node_labels.len());
    assert!(mesh.nodes.iter().flatten().all(|x| x.is_finite()), "nodes are finite");
    for cell in &mesh.cells {
        assert_eq!(cell.nodes.len(), cell.shape.nodes());
        assert!(cell.nodes.iter().all(|node| *node < mesh.nodes.len()), "nodes of cells exist");
    }
    for set in &mesh.sets {
        assert!(set.nodes.is_sorted_by(|a, b| a < b) && set.cells.is_sorted_by(|a, b| a < b), "sets ascend");
        assert!(set.nodes.last().is_none_or(|node| *node < mesh.nodes.len()), "nodes of sets exist");
        assert!(set.cells.last().is_none_or(|cell| *cell < mesh.cells.len()), "cells of sets exist");
    }
    match mesh.check() {
        Ok(()) => drop(mesh.notes()),
        Err(faults) => assert!(faults.iter().all(|fault| !fault.to_string().is_empty())),
    }
}
