//! Meshes of cells, and their checks.

use std::path::Path;

use quasirigid_io::mesh::mesh_of;
use quasirigid_io::model::deck_notes;

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

/// Words of decks of Abaqus.
pub const DECK: &[&str] = &[
    "*NODE\n",
    "*ELEMENT, TYPE=C3D8, ELSET=E\n",
    "*ELEMENT, TYPE=B31, ELSET=E\n",
    "*ELEMENT, TYPE=SPRINGA, ELSET=S\n",
    "*MATERIAL, NAME=M\n",
    "*ELASTIC, TYPE=ORTHO\n",
    "*DENSITY\n",
    "*SOLID SECTION, ELSET=E, MATERIAL=M, ORIENTATION=O\n",
    "*SHELL SECTION, COMPOSITE, ELSET=E, OFFSET=SPOS\n",
    "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=I\n",
    "*ORIENTATION, NAME=O, SYSTEM=C\n",
    "*SURFACE, NAME=F\n",
    "*TIE, NAME=T\n",
    "*EQUATION\n",
    "*MPC\n",
    "*COUPLING, REF NODE=1, SURFACE=F\n",
    "*KINEMATIC\n",
    "*DISTRIBUTING\n",
    "*RIGID BODY, REF NODE=1, NSET=N\n",
    "*TRANSFORM, NSET=N\n",
    ",",
];

/// Words of NRRD files.
pub const NRRD: &[&str] = &[
    "II*\0\x08\0\0\0",
    "MM\0*\0\0\0\x08",
    "NRRD0004\n",
    "type: uint8\n",
    "sizes: 2 3 4\n",
    "encoding: gzip\n",
    "encoding: text\n",
    "space directions: (1,0,0) (0,1,0) (0,0,1)\n",
    "data file: a.raw\n",
    "\n\n",
];

/// Reads a deck with what is left out.
pub fn deck(bytes: &[u8]) {
    if let Err(error) = deck_notes(Path::new("nowhere/a.inp"), bytes) {
        assert!(!error.to_string().is_empty());
    }
}

/// Words of bulk data of NASTRAN.
pub const NASTRAN: &[&str] = &[
    "BEGIN BULK\n",
    "ENDDATA\n",
    "INCLUDE 'a.bdf'\n",
    "GRID,1,,0.,0.,1.\n",
    "GRID*   ",
    "GRDSET,,5\n",
    "CORD2R,5,,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n",
    "CORD2C,6,5,",
    "CORD1S,7,1,2,3\n",
    "CTETRA,1,1,1,2,3,4\n",
    "CHEXA,2,1,1,2,3,4,5,6,+\n+,7,8\n",
    "CPENTA,",
    "CPYRAM,",
    "CQUAD4,3,2,1,2,3,4\n",
    "CTRIA6,",
    "CBAR,4,3,1,2,1.,0.,0.\n",
    "CONM2,5,1,,3.\n",
    "CBUSH,6,4,1,2,,,,0\n",
    "RBE2,7,1,123456,2,3\n",
    "RBE3,8,,1,123456,1.,123,2,3\n",
    "PBEAM,",
    "PBARL,3,1,,L\n",
    "PCOMP,2\n",
    "PSHELL,2,1,.1\n",
    "MAT1,1,7.+10,,.3,2700.\n",
    "\t",
    ",",
    "+",
    "*",
];

/// Words of Exodus files.
pub const EXODUS: &[&str] =
    &["CDF\u{1}", "CDF\u{2}", "CDF\u{5}", "connect1", "coordx", "elem_type", "PYRAMID", "HEX"];

/// Words of MED files.
pub const MED: &[&str] = &["ENS_MAA", "FAS", "NOE", "MAI", "COO", "NOD", "FAM", "NUM", "PY5", "HE8", "GRO"];

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
