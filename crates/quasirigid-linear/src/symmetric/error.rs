//! Errors of patterns, and of matrices added on them.

use thiserror::Error;

/// A symmetric sparse matrix cannot be built.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SymmetricError {
    /// The list of first unknowns falls or is empty.
    #[error(
        "node {node} would begin at unknown {first} after one that begins at {before}; number the unknowns node by node"
    )]
    Unordered {
        /// Place of the number in the list.
        node: usize,
        /// First unknown of this node.
        first: u32,
        /// First unknown of the node before.
        before: u32,
    },
    /// An element names a node that does not exist.
    #[error("element {element} joins node {node}, but there are {count} nodes, counted from 0")]
    Node {
        /// Place of the element in the list.
        element: usize,
        /// Node it names.
        node: u32,
        /// Number of nodes.
        count: usize,
    },
    /// An element matrix has the wrong number of entries.
    #[error(
        "an element of {unknowns} unknowns has a matrix of {entries} entries; it needs {unknowns} x {unknowns}"
    )]
    Shape {
        /// Unknowns of the element.
        unknowns: usize,
        /// Entries of its matrix.
        entries: usize,
    },
    /// An entry has no place in the pattern.
    #[error("row {row}, column {column} has no place in the pattern; no element joins these two unknowns")]
    Outside {
        /// Row, the larger of the two.
        row: u32,
        /// Column.
        column: u32,
    },
    /// Two matrices that are to be added have different patterns.
    #[error(
        "matrices of {left} and {right} unknowns on different patterns cannot be added; build both on one pattern"
    )]
    Patterns {
        /// Unknowns of the first matrix.
        left: usize,
        /// Unknowns of the second.
        right: usize,
    },
}
