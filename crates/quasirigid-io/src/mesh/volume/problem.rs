//! Errors of meshes of cells.
//! Apart from the errors of surfaces because no surface file can have them; every message ends with a remedy or a question.

use std::path::PathBuf;

use thiserror::Error;

use super::Part;
use super::voxels::VoxelProblem;
use crate::matrix::MatrixProblem;
use crate::visible::Excerpt;

/// Problem of a file of nodes and cells.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum VolumeProblem {
    /// A file whose beginning is that of no known format.
    #[error(
        "the file is {kind}, which is not a known mesh format; give a .msh file of gmsh, .vtk or \
         .vtu of VTK, .inp of Abaqus or CalculiX, .bdf or .op2 of NASTRAN, .exo of Exodus, .med, or voxels as .npy, .nrrd or .tif"
    )]
    NotAMesh {
        /// What the file is; nothing of it is quoted.
        kind: &'static str,
    },
    /// Voxels that cannot be read.
    #[error(transparent)]
    Voxels(#[from] VoxelProblem),
    /// A card of NASTRAN or an array of NumPy that cannot be read.
    #[error(transparent)]
    Card(#[from] MatrixProblem),
    /// A file without cells.
    #[error(
        "the file has no cells; were they left out when it was written, perhaps for lack of physical groups?"
    )]
    NoCells,
    /// A version of a format that is not read.
    #[error("{found:?} is not read; save gmsh meshes as version 2.2 or 4.1, VTK grids as version 2 to 5")]
    Version {
        /// The version, or what stands in its place.
        found: Excerpt,
    },
    /// A cell that is none of the shapes.
    #[error(
        "cells of type {found} are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of \
         first or second order are, but no wedges of 18 nodes"
    )]
    Kind {
        /// Type of the cell, as the file says it, with its name where that is known.
        found: Excerpt,
    },
    /// A coordinate that is NaN or infinite.
    #[error(
        "the coordinate {found} of node {node} is not finite; correct it, or leave out the node and its cells"
    )]
    NotFinite {
        /// The node.
        node: u64,
        /// The coordinate.
        found: Excerpt,
    },
    /// Two nodes or cells with one number.
    #[error("the number {label} appears twice among the {part}; renumber them")]
    Twice {
        /// Nodes or cells.
        part: Part,
        /// The number.
        label: u64,
    },
    /// A cell that names a node that does not exist.
    #[error("cell {cell} names node {node}, which is not among the nodes before it; was the node left out?")]
    NoSuchNode {
        /// The cell.
        cell: u64,
        /// The node.
        node: u64,
    },
    /// A set that names a member that does not exist.
    #[error("the set {set:?} names {label}, which is not among the {part} before it; was it left out?")]
    NoSuchMember {
        /// The set.
        set: String,
        /// Nodes or cells.
        part: Part,
        /// The member, a number or the name of a set.
        label: String,
    },
    /// Sets with too many members.
    #[error("the sets have more than {limit} members together; leave out those that are not needed")]
    Members {
        /// Most members of all sets.
        limit: usize,
    },
    /// A number that is none of a node, a cell or a count.
    #[error("{found} is not a number of nodes or cells; is the file damaged?")]
    Label {
        /// The number.
        found: i64,
    },
    /// A cell with too few or too many nodes.
    #[error("{found} nodes for a {shape}; is the type of the cell right?")]
    NodeCount {
        /// Number of nodes that the file has.
        found: u64,
        /// Shape of the cell.
        shape: String,
    },
    /// A line that is no beginning of a gmsh section.
    #[error(
        "{found:?} is not allowed here; a gmsh file begins with $MeshFormat and has sections $Name to $EndName"
    )]
    Section {
        /// The line.
        found: Excerpt,
    },
    /// A section that does not end.
    #[error("the section ${section} does not end; was the file cut off?")]
    NoSectionEnd {
        /// Name of the section.
        section: String,
    },
    /// A section that ends early.
    #[error("the section ends after {found} of {announced} {part}; is the number wrong?")]
    Short {
        /// Part that is missing.
        part: Part,
        /// Number that the section announces.
        announced: u64,
        /// Number found.
        found: u64,
    },
    /// A mesh in parts for several computers.
    #[error("the mesh is partitioned; save it without partitions")]
    Partitioned,
    /// An entity of a gmsh file that is not among its entities.
    #[error("there is no entity {tag} of dimension {dimension} in $Entities; were they left out?")]
    NoSuchEntity {
        /// 0 for points to 3 for volumes.
        dimension: i64,
        /// Number of the entity.
        tag: i64,
    },
    /// A line that is not known in a VTK file.
    #[error(
        "{found:?} is not allowed here; a VTK file of cells has ASCII or BINARY, DATASET UNSTRUCTURED_GRID, POINTS, \
         CELLS and CELL_TYPES, then CELL_DATA and POINT_DATA"
    )]
    Keyword {
        /// The line.
        found: Excerpt,
    },
    /// A VTK file without something that cells need.
    #[error("the file ends without {keyword}; was it cut off?")]
    Missing {
        /// The keyword.
        keyword: Excerpt,
    },
    /// A type of number that is not read.
    #[error("values of type {found:?} are not read; save them as numbers")]
    Scalar {
        /// The type.
        found: Excerpt,
    },
    /// A file that is no XML.
    #[error("the XML is damaged at column {column}; was the file cut off, or not written by VTK?")]
    Xml {
        /// Column of the line, from 1.
        column: u32,
    },
    /// An element or attribute that a `.vtu` file lacks or that cannot be understood.
    #[error(
        "<{element}> lacks {missing}, or it cannot be understood; save an unstructured grid by a program based on VTK"
    )]
    Attribute {
        /// The element.
        element: String,
        /// The attribute or the element within it.
        missing: String,
    },
    /// An array whose text is no base64.
    #[error("the array {array:?} is not base64 text, or it is cut off; was the file edited?")]
    Base64 {
        /// Name.
        array: String,
    },
    /// An array whose compressed bytes are damaged.
    #[error("block {block} of the array {array:?} cannot be decompressed; is the file damaged?")]
    Compressed {
        /// Name.
        array: String,
        /// The block, from 0.
        block: u64,
    },
    /// An array that decompresses to more than it may.
    #[error(
        "array {array:?} decompresses to more than {limit} bytes, which is more than its cells and points need; is the file damaged?"
    )]
    Inflated {
        /// Name.
        array: String,
        /// Bytes that the array may have.
        limit: u64,
    },
    /// An HDF5 container that cannot be read.
    #[error(
        "the HDF5 container cannot be read: {detail}; is the file damaged, or was a filter used that others lack?"
    )]
    Hdf5 {
        /// What is wrong.
        detail: Excerpt,
    },
    /// An HDF5 container for a program that reads none.
    #[error(
        "the file is HDF5, as MED and netCDF-4 are, and this program was built without it; build it with `--features hdf5`, \
         or save the mesh in another format"
    )]
    WithoutHdf5,
    /// A container that is neither Exodus nor MED.
    #[error(
        "the {container} file has neither the variables of Exodus nor the mesh of MED; save the mesh as one of them"
    )]
    NoMeshInside {
        /// netCDF or HDF5.
        container: &'static str,
    },
    /// A compression that is not read.
    #[error("the compression {found:?} is not read; save with zlib or without compression")]
    Compressor {
        /// Name.
        found: Excerpt,
    },
    /// An array with a wrong number of values.
    #[error("the array {array:?} has {found} values instead of {expected}; is the file damaged?")]
    ArrayLength {
        /// Name.
        array: String,
        /// Number found.
        found: u64,
        /// Number of values expected.
        expected: u64,
    },
    /// Offsets of cells that do not rise.
    #[error(
        "the nodes of cell {cell} end at {end}, of {total} and after {start}; offsets must rise up to the last"
    )]
    Offset {
        /// The cell, from 0.
        cell: u64,
        /// Index of the first node of the cell.
        start: u64,
        /// Index after the last node of the cell.
        end: u64,
        /// Number of values found.
        total: u64,
    },
    /// Data of an Abaqus file that make or move nodes and cells and are not read.
    #[error(
        "{found} is not read, and without it the mesh would be another; save a flattened file with every node and cell"
    )]
    Generated {
        /// The keyword, with the parameter that matters.
        found: Excerpt,
    },
    /// A keyword of an Abaqus file without a parameter that it needs.
    #[error("*{keyword} lacks {parameter}=; add it")]
    Parameter {
        /// The keyword.
        keyword: Excerpt,
        /// The parameter.
        parameter: String,
    },
    /// Files that include each other.
    #[error("{} is included within itself, or more than {limit} files deep", file.display())]
    Include {
        /// The file.
        file: PathBuf,
        /// The greatest depth.
        limit: usize,
    },
}
