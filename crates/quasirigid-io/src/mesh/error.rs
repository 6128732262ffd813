use std::fmt;
use std::io::ErrorKind;
use std::path::PathBuf;

use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

use super::volume::VolumeProblem;

/// A file from which no mesh can be read: where, and what is wrong there.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}{place}: {problem}", file.display())]
pub struct MeshError {
    /// The file.
    pub file: PathBuf,
    /// Where in it.
    pub place: Place,
    /// What is wrong.
    pub problem: MeshProblem,
}

/// What is wrong at a place of a file that is yet to be named.
pub(super) type Fault = (Place, MeshProblem);

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The whole of it.
    File,
    /// A line of a text, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(f, ":{line}"),
            Self::Byte(byte) => write!(f, ": byte {byte}"),
        }
    }
}

/// Things that a file announces and then lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// Vertices.
    Vertices,
    /// Faces.
    Faces,
    /// Elements of a PLY file that are neither, by their name.
    Elements(String),
    /// Nodes of cells.
    Nodes,
    /// Cells.
    Cells,
    /// Points, curves, surfaces and volumes of a gmsh file.
    Entities,
    /// Names of groups in a gmsh file.
    Names,
    /// Values of an array, by its name.
    Values(String),
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertices => write!(f, "vertices"),
            Self::Faces => write!(f, "faces"),
            Self::Elements(name) => write!(f, "elements {name:?}"),
            Self::Nodes => write!(f, "nodes"),
            Self::Cells => write!(f, "cells"),
            Self::Entities => write!(f, "entities"),
            Self::Names => write!(f, "names"),
            Self::Values(name) => write!(f, "values of {name:?}"),
        }
    }
}

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
    /// An element of a PLY file.
    PlyElement,
    /// The first line of a gmsh file.
    GmshFormat,
    /// The name of a group in a gmsh file.
    GmshName,
    /// How many follow in a section of a gmsh file.
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
            Self::PlateCounts => "the first line has the number of vertices, then perhaps the number of faces",
            Self::PlateCount => "the line after the vertices has the number of faces",
            Self::PlateVertex => "a vertex is written number x y z, as often as the first line says",
            Self::PlateFace => "a face is written number a b c",
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
            Self::VtkKeyword => "here stands a keyword, perhaps with name, type and number of the values after it",
            Self::VtkValue => "an array has as many numbers as its line announces, of the type it announces",
            Self::InpNode => "a node is written number, x, y, z",
            Self::InpCell => "a cell is written number, nodes, with a comma at the end of a line that continues",
            Self::InpSet => "a set lists numbers or names of other sets, with commas between",
            Self::InpRange => "a range is written first, last, step",
        })
    }
}

/// What is wrong with a file of triangles.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MeshProblem {
    /// It cannot be read at all.
    #[error("{kind}; is the name right, and may the file be read?")]
    Unreadable {
        /// What the operating system says.
        kind: ErrorKind,
    },
    /// It is a folder.
    #[error("this is a folder; give the file of the mesh inside it")]
    Folder,
    /// It is a pipe, a device or the like.
    #[error("this is no file on a disk but a pipe or a device, which may never end; give a file")]
    NoFile,
    /// What it holds takes more memory than there is.
    #[error("{0}; reduce what the file holds")]
    Memory(TooMuchMemory),
    /// It is larger than any mesh.
    #[error("the file is larger than {} MiB, the most that is read; make the mesh coarser", limit / (1024 * 1024))]
    TooLarge {
        /// Largest size that is read (bytes).
        limit: u64,
    },
    /// It has no bytes.
    #[error("the file is empty; was its download cut off?")]
    Empty,
    /// Neither its beginning nor its name is that of a known format.
    #[error(
        "the file begins with {start:?}, as no surface known here does; give an OBJ, STL or PLY file, or a plate table"
    )]
    NotAMesh {
        /// Its first characters.
        start: String,
    },
    /// A byte that no text has.
    #[error("the byte 0x{byte:02X} is not UTF-8 text; save the text as UTF-8, or is the file damaged?")]
    NotText {
        /// The byte.
        byte: u8,
    },
    /// A word that should be a number.
    #[error("{found:?} is not a number; {row}")]
    NotANumber {
        /// The word.
        found: String,
        /// What the line should be.
        row: Row,
    },
    /// Too few values on a line, or too many.
    #[error("{found} values; {row}")]
    Values {
        /// How many there are.
        found: usize,
        /// What the line should be.
        row: Row,
    },
    /// A line that has no place here.
    #[error("{found:?} cannot stand here; {row}")]
    Unexpected {
        /// The line.
        found: String,
        /// What stands here.
        row: Row,
    },
    /// A coordinate that is NaN or infinite.
    #[error("the coordinate {found} is not finite; leave out this vertex and its faces, and close the gap")]
    NotFinite {
        /// The coordinate.
        found: String,
    },
    /// A corner that is no vertex.
    #[error("there is no vertex {found}; {vertices} vertices count from {first} here")]
    NoSuchVertex {
        /// The corner as the file names it.
        found: String,
        /// Number of the first vertex, 0 or 1.
        first: usize,
        /// How many vertices there are, up to here where corners count back.
        vertices: usize,
    },
    /// A face without area.
    #[error("a face of {found} corners; give it three or more, or leave it out")]
    Corners {
        /// How many it has.
        found: usize,
    },
    /// A facet that is no triangle, where nothing else is allowed.
    #[error("a facet of {found} corners; STL has triangles only")]
    Facet {
        /// How many corners it has.
        found: usize,
    },
    /// A file that ends early.
    #[error("the file ends after {found} of {announced} {part}; was it cut off, or is the number wrong?")]
    Cut {
        /// What is missing.
        part: Part,
        /// How many the file announces.
        announced: u64,
        /// How many it has.
        found: u64,
    },
    /// A file that goes on too long.
    #[error("more follows the {announced} {part} announced; is that number right?")]
    Surplus {
        /// What was to be the last.
        part: Part,
        /// How many the file announces.
        announced: u64,
    },
    /// A file that ends within a facet.
    #[error("the file ends without endsolid; was it cut off?")]
    NoEnd,
    /// A row that does not come in its turn.
    #[error("number {found} stands where {expected} should; rows count from 1 without a gap")]
    Numbering {
        /// The number of the row.
        found: String,
        /// Its turn.
        expected: u64,
    },
    /// A line of a PLY header that cannot be understood.
    #[error(
        "{found:?} cannot stand here in a PLY header; after ply come format (ascii, binary_little_endian or \
         binary_big_endian) 1.0, element NAME COUNT, property TYPE NAME or property list TYPE TYPE NAME, end_header"
    )]
    Header {
        /// The line.
        found: String,
    },
    /// A PLY file whose header does not end.
    #[error("the header has no end_header; was the file cut off?")]
    NoHeaderEnd,
    /// A PLY file whose elements lack what makes a surface.
    #[error("the {part} lack {}; add it when you export the surface", if *part == Part::Faces { "the list vertex_indices" } else { "x, y or z" })]
    NoProperty {
        /// The elements.
        part: Part,
    },
    /// A length that no list can have.
    #[error("a list cannot have {found} entries; is the header right about the types?")]
    ListLength {
        /// The length.
        found: String,
    },
    /// Nothing to read.
    #[error("the file has no {part}; export the surface as triangles")]
    Nothing {
        /// What is missing.
        part: Part,
    },
    /// What only meshes of cells have.
    #[error(transparent)]
    Volume(#[from] VolumeProblem),
}
