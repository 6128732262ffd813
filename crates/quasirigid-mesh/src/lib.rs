//! Meshes of [`quasirigid`](https://docs.rs/quasirigid): cells between nodes, for finite elements, with their shapes,
//! quadrature points and checks.
//!
//! - [`meshing`] fills a shape with curved quadratic tetrahedra,
//! - [`surface`] integrates over the bodies that closed surfaces of triangles enclose.
//!
//! Like `quasirigid-math` below it, the crate contains no physics.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

mod check;
mod fault;
mod functions;
mod geometry;
pub mod meshing;
mod note;
mod repair;
mod rules;
mod samples;
mod shape;
pub mod surface;

pub use fault::MeshFault;
pub(crate) use functions::EDGES;
pub use functions::MAX_NODES;
pub use note::MeshNote;
pub use samples::{CellSample, Rule};
pub use shape::Shape;

/// Nodes and the cells between them, with the numbers and names that their file gave them.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Places of the nodes.
    pub nodes: Vec<[f64; 3]>,
    /// Number of each node in its file.
    pub node_labels: Vec<u64>,
    /// Cells: solids, faces and lines, in the order of the file.
    pub cells: Vec<Cell>,
    /// Named groups of nodes and cells.
    pub sets: Vec<Set>,
}

/// A cell between nodes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Number of the cell in the file.
    pub label: u64,
    /// Shape of the cell.
    pub shape: Shape,
    /// Indices of the nodes, in the order of [`Shape`].
    pub nodes: Box<[usize]>,
}

/// A named group of nodes and cells; one of the two is often empty.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Set {
    /// Name of the set; where the file has only a number, the number.
    pub name: String,
    /// Indices of nodes, ascending.
    pub nodes: Vec<usize>,
    /// Indices of cells, ascending.
    pub cells: Vec<usize>,
}
