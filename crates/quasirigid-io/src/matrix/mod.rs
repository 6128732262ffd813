//! Matrices from finite-element codes, with the degrees of freedom they are about and the places of the nodes.
//!
//! Numbers are taken as they are, in the units of the file; whether a matrix is a mass or a stiffness is for its
//! reader to say. No more memory is taken than a small multiple of the size of the file, whatever the file announces.

mod calculix;
mod coordinates;
mod dof;
pub(crate) mod error;
mod format;
mod harwell;
pub(crate) mod listed;
mod market;
mod mat;
mod nastran;
mod nodes;
pub(crate) mod numpy;
pub(crate) mod op2;
mod op4;
mod row;
pub(crate) mod text;

use std::path::Path;

use crate::nastran::modes;
use crate::text_file::{FileError, bytes_of};
pub use dof::Dof;
pub use error::{MatrixError, MatrixProblem, Place};
use format::{Format, NodeFormat};
pub use nodes::{Node, NodeTable};
pub use row::Row;

/// Largest file that is read (bytes): a stiffness of a hundred million entries as text.
const MAX_FILE: u64 = 4 * 1024 * 1024 * 1024;

/// A matrix as a file has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MatrixFile {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Row and column, from 0, and value of each entry that is not zero: in both triangles, by row and then by
    /// column, each place once, finite.
    pub entries: Vec<(usize, usize, f64)>,
    /// Degree of freedom of each row, in ascending order, where the file names them; a square matrix has the same columns.
    pub labels: Option<Vec<Dof>>,
}

/// Reads a matrix; the beginning of the file tells the format, and its ending where the beginning leaves a doubt.
///
/// - Matrix Market (`%%MatrixMarket`): coordinate or array; real or integer; general, symmetric or skew-symmetric.
/// - NumPy `.npy`, versions 1 to 3: one or two dimensions of `f4`, `f8`, `i4` or `i8`, of either byte order, by rows
///   or by columns; one dimension is a column. `.npz`: several of these, or what `scipy.sparse.save_npz` writes as
///   `csr`, `csc`, `coo` or `bsr`, whose repeated entries are added up.
/// - MATLAB `.mat` of version 5 (`-v6`, `-v7`): real, full or sparse, of any type of number.
/// - CalculiX `SOLVER=MATRIXSTORAGE`, by its ending `.sti` or `.mas`: one triangle; the degrees of freedom are in the `.dof`
///   file beside it, see [`read_dofs`].
/// - Harwell–Boeing: real and assembled, general, symmetric or skew-symmetric.
/// - Abaqus `*MATRIX OUTPUT`: lines `row column value`, or `node component node component value`, with blanks or commas; a
///   triangle alone stands for both.
/// - NASTRAN bulk data with `DMIG` cards, by its beginning or an ending `.bdf`, `.dat`, `.nas`, `.pch` or `.dmig`:
///   real, of form 1, 2, 6 or 9, in fields of 8 or 16 columns or between commas; continuations follow their card. The
///   labels are the points and components that occur, and those of the rows alone where the form is 2 or 9.
/// - NASTRAN `OUTPUT4`, as text or binary of either byte order in words of 32 or 64 bits: real, dense or sparse, with or
///   without `BIGMAT`.
/// - NASTRAN `OUTPUT2`, in words of 32 or 64 bits and either byte order: its matrices by their names, real. Rows of a matrix between all
///   degrees of freedom are named by `EQEXIN`.
/// - Real modes of NASTRAN in `OUTPUT2`, in a print file (`.f06`) or a punch file (`.pch`), of the first subcase that has some:
///   `FREQUENCIES`, a column of angular frequencies (rad/s), and `SHAPES`, with a column for each mode.
///
/// `name` says which of several matrices; it must be given where a `.npz`, `.mat`, `DMIG`, `OUTPUT2` or `OUTPUT4` file has more than
/// one. Upper and lower case are the same in names of NASTRAN.
///
/// # Errors
/// [`MatrixError`] says what is wrong and where: by line in a text, by byte in a binary file.
pub fn read_matrix(file: &Path, name: Option<&str>) -> Result<MatrixFile, MatrixError> {
    matrix_of(file, &bytes_of(file, MAX_FILE)?, name)
}

/// Name of the column of angular frequencies in a file of modes.
pub(crate) const FREQUENCIES: &str = modes::FREQUENCIES;
/// Name of the matrix of shapes in a file of modes.
pub(crate) const SHAPES: &str = modes::SHAPES;

/// Reads a matrix as [`read_matrix`], and something beside it from the same bytes; where a name is needed and none is given, the usual one
/// is taken if the file has it.
pub(crate) fn read_usual<T>(
    file: &Path,
    [name, usual]: [Option<&str>; 2],
    beside: impl Fn(&[u8]) -> T,
) -> Result<(MatrixFile, T), MatrixError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    let matrix = matrix_of(file, &bytes, name).or_else(|error| match (&error.problem, usual) {
        (MatrixProblem::WhichMatrix { names }, Some(usual)) if names.iter().any(|name| name == usual) => {
            matrix_of(file, &bytes, Some(usual))
        }
        _ => Err(error),
    })?;
    Ok((matrix, beside(&bytes)))
}

/// The matrix in the bytes of a file, whose name tells the format where the bytes do not.
///
/// # Errors
/// Those of [`read_matrix`], except that the file cannot be read.
pub fn matrix_of(file: &Path, bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, MatrixError> {
    let read = || match (Format::of(file, bytes)?, name) {
        (
            Format::Market | Format::Npy | Format::CalculiX | Format::Coordinates | Format::Harwell,
            Some(name),
        ) => Err((Place::File, MatrixProblem::Nameless { name: name.to_owned() })),
        (Format::Market, None) => market::read(bytes),
        (Format::Npy, None) => numpy::read(bytes),
        (Format::CalculiX, None) => calculix::read(bytes),
        (Format::Harwell, None) => harwell::read(bytes),
        (Format::Coordinates, None) => coordinates::read(bytes),
        (Format::Npz, name) => numpy::read_archive(bytes, name),
        (Format::Mat, name) => mat::read(bytes, name),
        (Format::Dmig, name) => nastran::read_dmig(bytes, name),
        (Format::Op4Text, name) => op4::read_text(bytes, name),
        (Format::Op2, name) => op2::read(bytes, name),
        (Format::Printed, name) => op2::read_printed(bytes, name),
        (Format::Op4Binary { big_endian }, name) => op4::read_binary(bytes, big_endian, name),
    };
    read().map_err(FileError::new(file))
}

/// Reads the places of nodes; the ending of the file or its first line tells the format.
///
/// - A table of lines `label x y z`, with commas, semicolons or blanks between them, perhaps below one line of
///   titles; lines that begin with `#` are passed over.
/// - `GRID` cards of NASTRAN bulk data, with their coordinate systems.
/// - `*NODE` blocks of an Abaqus or CalculiX input (`.inp`), in the global system.
///
/// # Errors
/// [`MatrixError`] says what is wrong and on which line.
pub fn read_nodes(file: &Path) -> Result<NodeTable, MatrixError> {
    nodes_of(file, &bytes_of(file, MAX_FILE)?)
}

/// The nodes in the bytes of a file, whose name tells the format where the bytes do not.
///
/// # Errors
/// Those of [`read_nodes`], except that the file cannot be read.
pub fn nodes_of(file: &Path, bytes: &[u8]) -> Result<NodeTable, MatrixError> {
    let read = || match NodeFormat::of(file, bytes)? {
        NodeFormat::Table => nodes::read_table(bytes),
        NodeFormat::Bulk => nodes::read_grid(bytes),
        NodeFormat::Input => nodes::read_input(bytes),
    };
    read().map_err(FileError::new(file))
}

/// Reads the degrees of freedom of the rows of a matrix, in their order: lines `node.component`, as in a `.dof` file of
/// CalculiX, or `node component`.
///
/// # Errors
/// [`MatrixError`] says what is wrong and on which line.
pub fn read_dofs(file: &Path) -> Result<Vec<Dof>, MatrixError> {
    dofs_of(file, &bytes_of(file, MAX_FILE)?)
}

/// The degrees of freedom in the bytes of a file.
///
/// # Errors
/// Those of [`read_dofs`], except that the file cannot be read.
pub fn dofs_of(file: &Path, bytes: &[u8]) -> Result<Vec<Dof>, MatrixError> {
    dof::read(bytes).map_err(FileError::new(file))
}
