//! Faults of a mesh: kinds of error for which it describes no body.
//! Each kind carries the first place and the count, by the numbers of the user's file: a mesh is mended where it was made.

use thiserror::Error;

use super::Shape;

/// Fault for which a mesh describes no body. Nodes and cells go by the numbers of their file.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshFault {
    /// Nodes and their numbers do not match.
    #[error("there are {nodes} nodes but {labels} numbers of nodes; give each node its own")]
    Labels {
        /// Number of nodes.
        nodes: usize,
        /// Number of labels.
        labels: usize,
    },
    /// A node at NaN or at infinity.
    #[error("node {node} is at no finite place{}", among(*count, "nodes"))]
    NotFinite {
        /// The first such node.
        node: u64,
        /// Number of such nodes.
        count: usize,
    },
    /// A cell with more or fewer nodes than its shape has.
    #[error("cell {cell} has {found} nodes, but a {shape} was announced{}", among(*count, "cells"))]
    NodeCount {
        /// The first such cell.
        cell: u64,
        /// Shape of the cell.
        shape: Shape,
        /// Number of nodes found.
        found: usize,
        /// Number of such cells.
        count: usize,
    },
    /// A cell with a node that is not in the list.
    #[error("cell {cell} has the node at place {} of the list, which holds {nodes}{}", index.saturating_add(1), among(*count, "cells"))]
    NoSuchNode {
        /// The first such cell.
        cell: u64,
        /// Index of the node.
        index: usize,
        /// Number of nodes.
        nodes: usize,
        /// Number of such cells.
        count: usize,
    },
    /// A node that a cell has twice.
    #[error("cell {cell} ({shape}) has node {node} twice{}; use the shape with fewer nodes", among(*count, "cells"))]
    NodeTwice {
        /// The first such cell.
        cell: u64,
        /// Shape of the cell.
        shape: Shape,
        /// The node.
        node: u64,
        /// Number of such cells.
        count: usize,
    },
    /// Two cells of the same nodes, which would count twice.
    #[error("cells {} and {} have the same nodes{}; leave one of them out", cells[0], cells[1], among(*count, "pairs"))]
    CellTwice {
        /// The first such pair.
        cells: [u64; 2],
        /// Number of such pairs.
        count: usize,
    },
    /// A cell so thin somewhere that its Jacobian vanishes to within rounding.
    #[error(
        "cell {cell} ({shape}) is flat near {}: {thickness:.1e} times as thick as it is long{}; move its nodes apart or leave it out",
        place(*at), among(*count, "cells")
    )]
    Flat {
        /// The first such cell.
        cell: u64,
        /// Shape of the cell.
        shape: Shape,
        /// Thickness over length, in the reference cell's axes.
        thickness: f64,
        /// The place.
        at: [f64; 3],
        /// Number of such cells.
        count: usize,
    },
    /// A cell that is inside out, wholly or at a corner; of faces and lines, folded over.
    #[error(
        "cell {cell} ({shape}) is inside out near {}: {thickness:.2} times as thick as it is long{}; {}",
        place(*at), among(*count, "cells"),
        if *wholly { "list its nodes in the order of its shape" } else { "move the node that went too far back" }
    )]
    InsideOut {
        /// The first such cell.
        cell: u64,
        /// Shape of the cell.
        shape: Shape,
        /// Thickness over length, in the reference cell's axes, negative.
        thickness: f64,
        /// The place.
        at: [f64; 3],
        /// Whether the cell is inside out everywhere.
        wholly: bool,
        /// Number of such cells.
        count: usize,
    },
}

/// Words for an element that is the first of several.
pub(super) fn among(count: usize, elements: &str) -> String {
    if count > 1 { format!(", the first of {count} such {elements}") } else { String::new() }
}

fn place([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4e}, {y:.4e}, {z:.4e})")
}
