//! Matrices of finite-element programs, their nodes and degrees of freedom.

use std::path::Path;

use quasirigid_io::matrix::{dofs_of, matrix_of, nodes_of};

/// Words of Harwell–Boeing files.
pub const HARWELL: &[&str] = &[
    "title\n             4             1             1             2             0\n",
    "RUA                        2             3             4             0\n",
    "RSA",
    "(4I3)           (4I3)           (2E12.4)\n",
    "  1  2  4  5\n",
    " -1.5000E+00",
];

/// Words of Matrix Market files.
pub const MARKET: &[&str] = &[
    "%%MatrixMarket matrix coordinate real general\n",
    "%%MatrixMarket matrix array real symmetric\n",
    "skew-symmetric",
    "integer",
    "pattern",
    "complex",
    "hermitian",
    "%",
];
/// Words of NumPy files.
pub const NUMPY: &[&str] = &[
    "\u{93}NUMPY",
    "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }",
    "'<i8'",
    "'>f4'",
    "'|O'",
    "True",
    "(0,)",
    "(18446744073709551615, 2)",
    "PK\u{3}\u{4}",
    "PK\u{1}\u{2}",
    "PK\u{5}\u{6}",
    ".npy",
    "indptr",
    "indices",
    "data",
    "shape",
    "format",
];
/// Words of printed and punched modes.
pub const PRINTED: &[&str] = &[
    "R E A L   E I G E N V A L U E S\n",
    "R E A L   E I G E N V E C T O R   N O .   1\n",
    "1 1 4.0 2.0 0.3 1.0 4.0\n",
    "7 G 1.0 2.0 3.0 4.0 5.0 6.0\n",
    "$EIGENVECTOR\n",
    "$EIGENVALUE =  4.0  MODE =  1\n",
    "-CONT-  1.0 2.0 3.0\n",
];
/// Words of NASTRAN bulk data.
pub const DMIG: &[&str] = &[
    "DMIG,",
    "DMIG*   ",
    "DMIG    KAAX    ",
    "       0       6       1       0",
    "*       ",
    "+",
    ",",
    "$",
    "ENDDATA",
    "1.0-3",
    "BEGIN BULK\n",
];
/// Words of node tables.
pub const NODES: &[&str] = &["GRID,", "GRID*   ", "GRDSET", "*NODE\n", "# ", ";", "\t", "CORD2R,"];

/// Reads a file that has one matrix, and the matrix of a name where one is given.
pub fn read(file: &str, bytes: &[u8], name: Option<&str>) {
    read_matrix(file, bytes, None);
    if name.is_some() {
        read_matrix(file, bytes, name);
    }
}

fn read_matrix(file: &str, bytes: &[u8], name: Option<&str>) {
    let matrix = match matrix_of(Path::new(file), bytes, name) {
        Ok(matrix) => matrix,
        Err(error) => return assert!(error.to_string().starts_with(file), "{error}"),
    };
    let inside = |(row, column, value): &(usize, usize, f64)| {
        *row < matrix.rows && *column < matrix.columns && value.is_finite() && *value != 0.0
    };
    assert!(matrix.entries.iter().all(inside), "entries are inside and finite");
    let places = matrix.entries.iter().map(|(row, column, _)| (row, column));
    assert!(places.is_sorted_by(|a, b| a < b), "each place once, in order");
    if let Some(labels) = &matrix.labels {
        assert_eq!(labels.len(), matrix.rows);
    }
}

/// Nodes, whose beginning or name tells the format: all three names.
pub fn nodes(bytes: &[u8]) {
    for name in ["a.csv", "a.inp", "a.bdf"] {
        match nodes_of(Path::new(name), bytes) {
            Ok(table) => {
                let finite = |node: &quasirigid_io::matrix::Node| node.place.iter().all(|x| x.is_finite());
                assert!(table.nodes().iter().all(finite), "nodes are finite");
            }
            Err(error) => assert!(error.to_string().starts_with(name), "{error}"),
        }
    }
}

pub fn dofs(bytes: &[u8]) {
    if let Err(error) = dofs_of(Path::new("a.dof"), bytes) {
        assert!(error.to_string().starts_with("a.dof"), "{error}");
    }
}
