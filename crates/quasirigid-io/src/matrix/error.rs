//! Errors of matrix files, node tables and lists of degrees of freedom: the problem, the place in the file, the advice.
//! Every message ends with a remedy or a question; tests/data/matrix/errors.txt holds them word for word.

use std::io::ErrorKind;

use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

use super::Dof;
pub(crate) use super::row::Row;

use crate::mesh::MeshProblem;
pub use crate::text_file::Place;
use crate::text_file::{self, FileError, ReadProblem, Unread};
use crate::visible::Excerpt;

/// A file from which no matrix, nodes or degrees of freedom can be read, with the place and the problem.
pub type MatrixError = FileError<MatrixProblem>;

/// A problem at a place of a file that is yet to be named.
pub(crate) type Fault = text_file::Fault<MatrixProblem>;

/// Problem of a file of a matrix, of nodes or of degrees of freedom.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MatrixProblem {
    /// A file that cannot be read at all.
    #[error("{kind}; is the name right, and is the file readable?")]
    Unreadable {
        /// Error kind that the operating system reports.
        kind: ErrorKind,
    },
    /// A folder in place of a file.
    #[error("this is a folder; give the file inside it")]
    Folder,
    /// A pipe, a device or the like in place of a file.
    #[error("this is not a regular file but a pipe or a device, which may never end; give a file")]
    NoFile,
    /// Contents that take more memory than there is.
    #[error("{0}; reduce what the file holds")]
    Memory(TooMuchMemory),
    /// A file above the largest size that is read.
    #[error("more than {} MiB, the most that is read; reduce the model", limit / (1024 * 1024))]
    TooLarge {
        /// Largest size that is read (bytes).
        limit: u64,
    },
    /// An archive that unpacks to far more than it has.
    #[error("the archive unpacks to more than {} MiB, a hundred times its size; save the matrix as a sparse one, or without compression", limit / (1024 * 1024))]
    Inflated {
        /// Largest size that is unpacked (bytes).
        limit: u64,
    },
    /// A file without contents.
    #[error("the file is empty; was it cut off in writing or copying?")]
    Empty,
    /// A file whose beginning and name are those of no known format.
    #[error(
        "the file is {kind}, which is not a known matrix format; give a Matrix Market, .npy, .npz or .mat file, lines of *MATRIX OUTPUT, \
         .sti or .mas of CalculiX, or DMIG cards or OUTPUT4 of NASTRAN"
    )]
    NotAMatrix {
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
    #[error("{found:?} is not a number that is allowed here; {row}")]
    NotANumber {
        /// The word.
        found: Excerpt,
        /// Kind of line expected there.
        row: Row,
    },
    /// A number that is NaN or infinite.
    #[error("{found} is not finite; did the program that wrote it fail?")]
    NotFinite {
        /// The number.
        found: Excerpt,
    },
    /// Too few values, or too many.
    #[error("{found} values; {row}")]
    Values {
        /// Number of values found.
        found: usize,
        /// Kind of line expected there.
        row: Row,
    },
    /// Something that has no place here.
    #[error("{found:?} is not allowed here; {row}")]
    Unexpected {
        /// Text found there.
        found: Excerpt,
        /// Kind of line expected there.
        row: Row,
    },
    /// A row or column 0 where they count from 1.
    #[error("a row or column 0; they are numbered from 1 here")]
    Zero,
    /// A complex matrix.
    #[error("the matrix is complex; write the real matrix of mass, damping or stiffness")]
    Complex,
    /// A matrix without values.
    #[error("the file has the pattern of a matrix only; write it with its values, as real")]
    Pattern,
    /// A symmetric matrix that is not square.
    #[error("{rows} rows and {columns} columns; a symmetric matrix is square")]
    NotSquare {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
    /// A matrix without rows or columns.
    #[error("a matrix of {rows} rows and {columns} columns has no entries; was the right matrix written?")]
    Void {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
    /// An entry outside the matrix.
    #[error(
        "row {row}, column {column} lies outside a matrix of {rows} rows and {columns} columns; are its sizes right?"
    )]
    Outside {
        /// Row of the entry, from 1.
        row: usize,
        /// Column of the entry, from 1.
        column: usize,
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
    /// Two values for one place.
    #[error(
        "row {row}, column {column} has a value already; give each place one value, and one triangle of a \
         symmetric matrix"
    )]
    Twice {
        /// The row, from 1.
        row: usize,
        /// The column, from 1.
        column: usize,
    },
    /// A diagonal entry of a skew-symmetric matrix.
    #[error("row {row} has an entry on the diagonal; a skew-symmetric matrix has zeros there")]
    SkewDiagonal {
        /// The row, from 1.
        row: usize,
    },
    /// Rows without a diagonal entry in a format that has them all.
    #[error(
        "{diagonals} entries on the diagonal of {size} rows; CalculiX writes all, so was the file cut off?"
    )]
    NoDiagonal {
        /// Number of rows.
        size: usize,
        /// Number of diagonal entries.
        diagonals: usize,
    },
    /// A file that ends early.
    #[error("the file ends after {found} of {announced} entries; was it cut off, or is the number wrong?")]
    Cut {
        /// Number that the file announces.
        announced: u64,
        /// Number found.
        found: u64,
    },
    /// A file that ends within a matrix.
    #[error("the file ends within a matrix; was it cut off?")]
    CutMatrix,
    /// A file that goes on too long.
    #[error("more follows the {announced} entries announced; is that number right?")]
    Surplus {
        /// Number that the file announces.
        announced: u64,
    },
    /// A name for the only matrix of a file.
    #[error("this format has one matrix without a name; leave out the name {name:?}")]
    Nameless {
        /// The name that was asked for.
        name: String,
    },
    /// No matrix of that name.
    #[error("there is no matrix {name:?}; the file has {}", listed(.names))]
    NoSuchMatrix {
        /// The name that was asked for.
        name: String,
        /// Names of the matrices in the file.
        names: Vec<String>,
    },
    /// Several matrices, and no name.
    #[error("the file has {}; name one of them", listed(.names))]
    WhichMatrix {
        /// Names of the matrices in the file.
        names: Vec<String>,
    },
    /// A name that appears twice.
    #[error("a second matrix {name:?}; give each matrix a name of its own")]
    SameName {
        /// The name.
        name: String,
    },
    /// A NumPy file of an unknown version.
    #[error("version {major} of .npy is not known; write version 1 with numpy.save")]
    NumpyVersion {
        /// Number of the version before the point.
        major: u8,
    },
    /// A NumPy header that cannot be understood.
    #[error(
        "{found:?} is not an .npy header; it has descr, fortran_order and shape, as numpy.save writes them"
    )]
    NumpyHeader {
        /// The header, or its beginning.
        found: Excerpt,
    },
    /// A kind of number that is not read.
    #[error("numbers of type {found}; write float64 with numpy.save, or int32 or int64 for indices")]
    NumpyType {
        /// The type as NumPy names it.
        found: Excerpt,
    },
    /// An array of another form.
    #[error("an array of shape {}; {wanted} is needed here", shape(.found))]
    NumpyShape {
        /// Lengths of the array.
        found: Vec<usize>,
        /// Lengths that are needed.
        wanted: String,
    },
    /// An array with more or fewer bytes than its shape tells.
    #[error("{found} bytes of numbers where the shape and type need {announced}; is the file damaged?")]
    NumpyLength {
        /// Number of bytes that the header needs.
        announced: u64,
        /// Number of bytes found.
        found: u64,
    },
    /// A MAT file of version 7.3.
    #[error("a MAT file of version 7.3, which is HDF5 inside; save it with '-v7'")]
    NewerMat,
    /// A MAT file without a matrix.
    #[error("the file has no matrix of numbers; structures, cells and texts are not read")]
    NoMatMatrix,
    /// An unknown type of number in a MAT file.
    #[error("numbers of the type {found} are not known; was the file damaged?")]
    MatType {
        /// Type of the data element.
        found: u32,
    },
    /// An archive that cannot be read.
    #[error(
        "the archive cannot be read ({detail}); write it again with numpy.savez or scipy.sparse.save_npz"
    )]
    Archive {
        /// Error of the decompressor, or the missing file.
        detail: String,
    },
    /// A sparse matrix that lacks a part.
    #[error("the sparse matrix has no array {part:?}; write it with scipy.sparse.save_npz")]
    SparsePart {
        /// The array.
        part: String,
    },
    /// A sparse matrix of another format.
    #[error("the sparse format {found:?} is not read; convert the matrix with tocsr() before save_npz")]
    SparseFormat {
        /// The format as SciPy names it.
        found: Excerpt,
    },
    /// Pointers of a sparse matrix that do not ascend from 0 to the number of entries.
    #[error(
        "{found} stands among the row or column pointers; they ascend from 0 to {entries}, the number of entries"
    )]
    SparsePointer {
        /// The pointer.
        found: i64,
        /// The number of indices.
        entries: usize,
    },
    /// An index that is negative.
    #[error("the index {found} is negative; is the file damaged?")]
    SparseIndex {
        /// The index.
        found: i64,
    },
    /// A property or a material that no card has.
    #[error(
        "no card that is read has the {kind} {label}; is an included file missing, or is it of another kind?"
    )]
    NoCardOf {
        /// What is missing.
        kind: &'static str,
        /// Its number.
        label: u64,
    },
    /// Nodes or elements of a deck of Abaqus that cannot be read.
    #[error("{0}")]
    Inp(Box<MeshProblem>),
    /// A set, a surface, a material or an orientation that no keyword defines.
    #[error("no {kind} {name:?} is defined; is the name right, and is no included file missing?")]
    NoNamed {
        /// What is missing.
        kind: &'static str,
        /// Its name.
        name: Excerpt,
    },
    /// A material without constants that are read.
    #[error(
        "the material {name:?} has no *ELASTIC that is read; give ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC or LAMINA constants"
    )]
    NoElastic {
        /// Its name.
        name: Excerpt,
    },
    /// A section of beams that is not carried.
    #[error("beams with the section {name:?} are not read; RECT, CIRC, PIPE, BOX, I, L and GENERAL are")]
    BeamSection {
        /// Its name.
        name: Excerpt,
    },
    /// A deck without elements that are read.
    #[error(
        "the deck has no solid, plate, beam, rod or body that is read; are its elements in another file?"
    )]
    NoElements,
    /// A deck without mass.
    #[error(
        "nothing of the deck has mass: neither its materials by a density (RHO, *DENSITY), nor its properties, nor a body (CONM2, *MASS); give the densities"
    )]
    NoMass,
    /// An element without one of its corners.
    #[error("element {element} lacks a corner; was a continuation left out?")]
    NoCorner {
        /// The element.
        element: u64,
    },
    /// A grid point that no card has.
    #[error("no card gives the grid point or node {node}; is an included file missing?")]
    NoGrid {
        /// The grid point.
        node: u64,
    },
    /// A material without moduli.
    #[error("the material {material} has neither E nor G; give one of them")]
    NoModulus {
        /// The material.
        material: u64,
    },
    /// A ply without a thickness.
    #[error("a ply of the property {property} has no thickness; give it one")]
    NoThickness {
        /// The property.
        property: u64,
    },
    /// A material of solids that couples stretches and shears.
    #[error(
        "the material {material} has no three planes of symmetry in its axes; turn CORDM to them, or give MAT11"
    )]
    NoSymmetry {
        /// The material.
        material: u64,
    },
    /// A laminated solid that cannot be divided into its plies.
    #[error(
        "the laminated solid {element} is no CHEXA of 8 or CPENTA of 6 points with edges along the stack; mesh its plies, or correct PSDIR \
         and CORDM of PCOMPS"
    )]
    Layered {
        /// The element.
        element: u64,
    },
    /// A file without the mass and modes of a structure that is held at its base.
    #[error("{what}")]
    Sheet {
        /// What is wrong.
        what: &'static str,
    },
    /// A property without a material.
    #[error("the property {property} names no material; give it one")]
    NoMaterialOf {
        /// The property.
        property: u64,
    },
    /// A mean of grid points without weights.
    #[error(
        "the RBE3 of grid point {node} has grid points without a weight before them; it is written weight, components, points"
    )]
    NoWeighted {
        /// The grid point that follows.
        node: u64,
    },
    /// Two definitions of one coordinate system.
    #[error("a second coordinate system {system}; give each a number of its own")]
    SystemTwice {
        /// The system.
        system: u64,
    },
    /// A coordinate system that no card defines.
    #[error("no card defines the coordinate system {system}; is a CORD card or an included file missing?")]
    NoSuchSystem {
        /// The system.
        system: u64,
    },
    /// Coordinate systems that define each other.
    #[error(
        "the coordinate system {system} hangs on itself, or on more than {limit} others; correct the CORD cards"
    )]
    SystemCircle {
        /// The system.
        system: u64,
        /// Longest chain.
        limit: usize,
    },
    /// A grid point of a coordinate system that does not exist.
    #[error(
        "the coordinate system {system} needs the grid point {node}, which no card has; was it left out?"
    )]
    SystemGrid {
        /// The system.
        system: u64,
        /// The grid point.
        node: u64,
    },
    /// A coordinate system whose three points are in a line.
    #[error(
        "the three points of the coordinate system {system} are in a line; its plane needs a third direction"
    )]
    SystemFlat {
        /// The system.
        system: u64,
    },
    /// An included file outside the folder of the deck.
    #[error(
        "INCLUDE {file:?} is not in the folder of this file or below it; copy it there and name it from there"
    )]
    IncludeElsewhere {
        /// The file.
        file: Excerpt,
    },
    /// Files that include each other.
    #[error("{file:?} is included within itself, or more than {limit} files deep")]
    IncludeDeep {
        /// The file.
        file: Excerpt,
        /// The greatest depth.
        limit: usize,
    },
    /// Rows along the axes of a local system that are not all there.
    #[error(
        "node {node} counts its displacements in a local system, but not all three of them have rows; give all three, or none"
    )]
    PartOfSystem {
        /// The node.
        node: u64,
    },
    /// A matrix of an unknown form.
    #[error(
        "form {found} is not read; write the matrix as square (1), rectangular (2 or 9) or symmetric (6)"
    )]
    Form {
        /// The form.
        found: Excerpt,
    },
    /// A matrix of an unknown type of number.
    #[error("type {found} is not known; 1 and 2 are real numbers of single and double precision")]
    Type {
        /// The type.
        found: Excerpt,
    },
    /// Columns without a header.
    #[error("no header DMIG {name} 0 ...; add the card that tells the form of the matrix")]
    NoHeader {
        /// The matrix.
        name: String,
    },
    /// No `DMIG` card at all.
    #[error("there is no DMIG card; request the matrix with EXTSEOUT(DMIGPCH), or give the file that has it")]
    NoDmig,
    /// Columns that do not fill a rectangular matrix.
    #[error(
        "{found} columns where the header of {name} announces {announced}; give a column of zeros one entry 0."
    )]
    DmigColumns {
        /// The matrix.
        name: String,
        /// Number that the header announces.
        announced: u64,
        /// Number of columns with entries.
        found: u64,
    },
    /// Two values for one place of a `DMIG` matrix.
    #[error(
        "row {row}, column {column} has a value already; give each place one value, and one triangle of a \
         symmetric matrix"
    )]
    DmigTwice {
        /// The row.
        row: Dof,
        /// The column.
        column: Dof,
    },
    /// A record that does not end where it should.
    #[error(
        "a record announces {announced} bytes, and {found} can be here; was the file cut off, or changed as text?"
    )]
    Record {
        /// Length that the record announces (bytes).
        announced: u64,
        /// Length that is possible there (bytes).
        found: u64,
    },
    /// An `OUTPUT2` file without geometry.
    #[error("the file has no geometry, only {}; write it with PARAM,POST,-1 or take the deck", listed(names))]
    NoGeometry {
        /// Names of its data blocks.
        names: Vec<String>,
    },
    /// A table of modes of which no column can be made.
    #[error(
        "the file has no table of real modes; print or punch the eigenvalues and eigenvectors of SOL 103"
    )]
    NoModes,
    /// A component that does not exist.
    #[error("component {found}; 1 to 3 are displacements and 4 to 6 rotations")]
    Component {
        /// The component.
        found: Excerpt,
    },
    /// A degree of freedom that appears twice.
    #[error("{dof} appears twice; a matrix has one row for each degree of freedom")]
    DofTwice {
        /// The degree of freedom.
        dof: Dof,
    },
    /// A node that appears twice.
    #[error("node {node} appears twice; give each node one place")]
    NodeTwice {
        /// Label of the node.
        node: u64,
    },
    /// A node in coordinates of its own.
    #[error(
        "{found} places or moves nodes in a coordinate system of its own; write them in the global system"
    )]
    OwnSystem {
        /// Card or parameter that asks for the system.
        found: Excerpt,
    },
    /// No nodes.
    #[error("the file has no nodes; give a table label x y z, GRID cards or a *NODE block")]
    NoNodes,
}

impl ReadProblem for MatrixProblem {
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

/// Names in the order of a file, at most eight.
fn listed(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().take(8).map(|name| format!("{name:?}")).collect();
    match names.len() {
        0 => "none".to_owned(),
        1..=8 => shown.join(", "),
        more => format!("{} and {} more", shown.join(", "), more - 8),
    }
}

/// Lengths as NumPy writes them.
fn shape(lengths: &[usize]) -> String {
    let lengths: Vec<String> = lengths.iter().map(usize::to_string).collect();
    format!("({})", lengths.join(", "))
}
