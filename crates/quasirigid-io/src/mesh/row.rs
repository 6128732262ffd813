//! Kinds of lines in files of meshes.

use std::fmt;

use super::error::MeshProblem;
use crate::text_file::Line;

/// A kind of line in a text, whose text says how it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// A vertex of an OBJ file.
    ObjVertex,
    /// A face of an OBJ file.
    ObjFace,
    /// A corner in an STL file.
    StlVertex,
    /// Any line of an STL file.
    Stl,
    /// The first line of a plate table.
    PlateCounts,
    /// The line between the vertices and the faces of a plate table.
    PlateCount,
    /// A vertex of a plate table.
    PlateVertex,
    /// A face of a plate table.
    PlateFace,
    /// The beginning of an OFF file.
    OffHeader,
    /// A vertex of an OFF file.
    OffVertex,
    /// A face of an OFF file.
    OffFace,
    /// Values of a VRML file.
    Vrml,
    /// An element of a PLY file.
    PlyElement,
    /// The first line of a gmsh file.
    GmshFormat,
    /// The name of a group in a gmsh file.
    GmshName,
    /// The count at the beginning of a section of a gmsh file.
    GmshCount,
    /// A point, curve, surface or volume of a gmsh file.
    GmshEntity,
    /// The beginning of a block of nodes or cells in a gmsh file.
    GmshBlock,
    /// A node of a gmsh file.
    GmshNode,
    /// A cell of a gmsh file.
    GmshCell,
    /// A line of a VTK file that announces values.
    VtkKeyword,
    /// A value of a VTK file.
    VtkValue,
    /// A node of an Abaqus file.
    InpNode,
    /// A cell of an Abaqus file.
    InpCell,
    /// The place of an instance in an Abaqus file.
    InpPlace,
    /// A list of members in an Abaqus file.
    InpSet,
    /// A range of members in an Abaqus file.
    InpRange,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ObjVertex => "a vertex is written v x y z",
            Self::ObjFace => "a face is written f a b c, or f a/t/n b/t/n c/t/n",
            Self::StlVertex => "a corner is written vertex x y z",
            Self::Stl => "a facet is written facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet",
            Self::PlateCounts => {
                "the first line has the number of vertices, then perhaps the number of faces"
            },
            Self::PlateCount => "the line after the vertices has the number of faces",
            Self::PlateVertex => {
                "a vertex is written number x y z, or x y z, alike in all rows, as often as the first line says"
            },
            Self::PlateFace => "a face is written number a b c, or a b c, alike in all rows",
            Self::OffHeader => "OFF is followed by the numbers of vertices, faces and edges; OFF in four or more dimensions and binary OFF are not read",
            Self::OffVertex => "a vertex is written x y z, then colours or normals",
            Self::OffFace => "a face is written n and its n corners, then colours",
            Self::Vrml => "point has three numbers for each vertex, coordIndex the corners of each face and -1, and braces are closed",
            Self::PlyElement => "the line of an element has one value for each of its properties, and lists begin with their length",
            Self::GmshFormat => "$MeshFormat is followed by version, 0 for text or 1 for binary, 8",
            Self::GmshName => "the name of a group is written dimension number \"name\"",
            Self::GmshCount => {
                "the section begins with the number of things in it, after that of the blocks in version 4"
            }
            Self::GmshEntity => "an entity is written number box groups, with the number of groups before them",
            Self::GmshBlock => "a block begins with dimension and number of its entity, what is in it, and how many",
            Self::GmshNode => "a node is written number x y z",
            Self::GmshCell => "a cell is written number nodes, with type and tags before the nodes in version 2.2",
            Self::VtkKeyword => "a keyword is expected here, perhaps with name, type and number of the values after it",
            Self::VtkValue => "an array has as many numbers as its line announces, of the type it announces",
            Self::InpNode => "a node is written number, x, y, z",
            Self::InpCell => "a cell is written number, nodes, with a comma at the end of a line that continues",
            Self::InpPlace => {
                "an instance is placed by a line x, y, z and perhaps one with two points of an axis and an angle in degrees"
            }
            Self::InpSet => "a set lists numbers or names of other sets, with commas between",
            Self::InpRange => "a range is written first, last, step",
        })
    }
}

impl Line for Row {
    type Problem = MeshProblem;

    fn not_a_number(self, found: String) -> MeshProblem {
        MeshProblem::NotANumber { found: found.into(), row: self }
    }

    fn not_finite(self, found: String) -> MeshProblem {
        MeshProblem::NotFinite { found: found.into() }
    }
}
