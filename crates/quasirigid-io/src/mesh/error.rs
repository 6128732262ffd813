//! Errors of surface meshes: the problem, the place in the file, the advice.
//! Every message ends with a remedy or a question; variants of volume meshes are in their own enum and pass through unchanged.

use std::fmt;
use std::io::ErrorKind;

use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

use super::volume::VolumeProblem;

pub(super) use super::row::Row;
pub use crate::text_file::Place;
use crate::text_file::{self, FileError, ReadProblem, Unread};
use crate::visible::Excerpt;

/// A file from which no mesh can be read, with the place and the problem.
pub type MeshError = FileError<MeshProblem>;

/// A problem at a place of a file that is yet to be named.
pub(super) type Fault = text_file::Fault<MeshProblem>;

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
            Self::Elements(name) => write!(f, "elements {:?}", Excerpt::from(name.as_str())),
            Self::Nodes => write!(f, "nodes"),
            Self::Cells => write!(f, "cells"),
            Self::Entities => write!(f, "entities"),
            Self::Names => write!(f, "names"),
            Self::Values(name) => write!(f, "values of {:?}", Excerpt::from(name.as_str())),
        }
    }
}

/// Problem of a file of triangles.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MeshProblem {
    /// A file that cannot be read at all.
    #[error("{kind}; is the name right, and is the file readable?")]
    Unreadable {
        /// Error kind that the operating system reports.
        kind: ErrorKind,
    },
    /// A folder in place of a file.
    #[error("this is a folder; give the file of the mesh inside it")]
    Folder,
    /// A pipe, a device or the like in place of a file.
    #[error("this is not a regular file but a pipe or a device, which may never end; give a file")]
    NoFile,
    /// Contents that take more memory than there is.
    #[error("{0}; reduce what the file holds")]
    Memory(TooMuchMemory),
    /// A file above the largest size that is read.
    #[error("the file is larger than {} MiB, the most that is read; make the mesh coarser", limit / (1024 * 1024))]
    TooLarge {
        /// Largest size that is read (bytes).
        limit: u64,
    },
    /// A file without bytes.
    #[error("the file is empty; was its download cut off?")]
    Empty,
    /// A file whose beginning and name are those of no known format.
    #[error(
        "the file is {kind}, which is not a known surface format; give an OBJ, STL, PLY, OFF, VRML, glTF or VTK file, or a plate table"
    )]
    NotAMesh {
        /// What the file is; nothing of it is quoted.
        kind: &'static str,
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
        found: Excerpt,
        /// Kind of line expected there.
        row: Row,
    },
    /// Too few values on a line, or too many.
    #[error("{found} values; {row}")]
    Values {
        /// Number of values found.
        found: usize,
        /// Kind of line expected there.
        row: Row,
    },
    /// A line that has no place here.
    #[error("{found:?} is not allowed here; {row}")]
    Unexpected {
        /// The line.
        found: Excerpt,
        /// Kind of line expected here.
        row: Row,
    },
    /// A coordinate that is NaN or infinite.
    #[error("the coordinate {found} is not finite; leave out this vertex and its faces, and close the gap")]
    NotFinite {
        /// The coordinate.
        found: Excerpt,
    },
    /// A corner that is no vertex.
    #[error("there is no vertex {found}; {vertices} vertices are numbered from {first} here")]
    NoSuchVertex {
        /// The corner as the file names it.
        found: Excerpt,
        /// Number of the first vertex, 0 or 1.
        first: usize,
        /// Number of vertices, up to here where corners count back.
        vertices: usize,
    },
    /// A facet that is no triangle, where nothing else is allowed.
    #[error("a facet of {found} corners; STL has triangles only")]
    Facet {
        /// Number of corners.
        found: usize,
    },
    /// A file that ends early.
    #[error("the file ends after {found} of {announced} {part}; was it cut off, or is the number wrong?")]
    Cut {
        /// Part that is missing.
        part: Part,
        /// Number that the file announces.
        announced: u64,
        /// Number found.
        found: u64,
    },
    /// A file that goes on too long.
    #[error("more follows the {announced} {part} announced; is that number right?")]
    Surplus {
        /// Part that was to be the last.
        part: Part,
        /// Number that the file announces.
        announced: u64,
    },
    /// A file that ends within a facet.
    #[error("the file ends without endsolid; was it cut off?")]
    NoEnd,
    /// A row whose number is not the next one.
    #[error("number {found} appears where {expected} should; rows are numbered from 0 or 1 without a gap")]
    Numbering {
        /// The number of the row.
        found: Excerpt,
        /// Number that the row should have.
        expected: u64,
    },
    /// A line of a PLY header that cannot be understood.
    #[error(
        "{found:?} is not allowed here in a PLY header; after ply come format (ascii, binary_little_endian or \
         binary_big_endian) 1.0, element NAME COUNT, property TYPE NAME or property list TYPE TYPE NAME, end_header"
    )]
    Header {
        /// The line.
        found: Excerpt,
    },
    /// A PLY file whose header does not end.
    #[error("the header has no end_header; was the file cut off?")]
    NoHeaderEnd,
    /// A PLY file whose elements lack coordinates or corners.
    #[error("the {part} lack {}; add it when you export the surface", if *part == Part::Faces { "the list vertex_indices" } else { "x, y or z" })]
    NoProperty {
        /// The elements.
        part: Part,
    },
    /// A length that no list can have.
    #[error("a list cannot have {found} entries; is the header right about the types?")]
    ListLength {
        /// The length.
        found: Excerpt,
    },
    /// A file without vertices, faces or another part.
    #[error("the file has no {part}; export the surface as triangles")]
    Nothing {
        /// Part that is missing.
        part: Part,
    },
    /// A file that ends within braces.
    #[error("the file ends within {braces} pairs of braces; was it cut off?")]
    Unclosed {
        /// Pairs that are open.
        braces: usize,
    },
    /// A node of a scene that moves or resizes its children.
    #[error("{:?} moves or resizes a part of the scene; export the shape in its own axes", field.as_str())]
    Moved {
        /// Field of the node.
        field: String,
    },
    /// A glTF file that cannot be used.
    #[error("this glTF cannot be used: {cause}; export the shape again without extensions")]
    Gltf {
        /// Cause.
        cause: Excerpt,
    },
    /// A mesh of solids in place of a surface.
    #[error("the mesh has solid cells; give it to a [[solid]], or export its surface alone")]
    Solids,
    /// A label with several units of length.
    #[error("the label {label:?} has lengths in {} and in {}; write `unit` in the model", units[0], units[1])]
    Units {
        /// Name of the label.
        label: String,
        /// Two of the units.
        units: [String; 2],
    },
    /// A problem that only meshes of cells have.
    #[error(transparent)]
    Volume(#[from] VolumeProblem),
}

impl ReadProblem for MeshProblem {
    fn unread(unread: Unread, limit: u64) -> Self {
        match unread {
            Unread::Unreadable(kind) => Self::Unreadable { kind },
            Unread::Folder => Self::Folder,
            Unread::NoFile => Self::NoFile,
            Unread::TooLarge => Self::TooLarge { limit },
        }
    }

    fn not_text(byte: u8) -> Self {
        Self::NotText { byte }
    }
}
