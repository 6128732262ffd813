//! Errors of flows in cavities: meshes without a flow, and flows that are not found.
//! Nodes and cells go by the numbers of the user's file, since only there can a mesh be mended.

use thiserror::Error;

use quasirigid_mesh::{MeshFault, Shape};

/// Error of the flow in a cavity. Nodes and cells go by the numbers of their file.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StokesError {
    /// No cell can contain liquid.
    #[error("the mesh of the cavity has no tetrahedra; mesh the volume of the liquid, not its surface alone")]
    NoTetrahedra,
    /// Solid cells that are no tetrahedra.
    #[error(
        "cell {cell} of the cavity is a {shape}{}; liquid needs tetrahedra of 4 or 10 nodes",
        if *count > 1 { format!(", the first of {count} such cells") } else { String::new() }
    )]
    OtherShape {
        /// The first such cell.
        cell: u64,
        /// Shape of the cell.
        shape: Shape,
        /// Number of such cells.
        count: usize,
    },
    /// The tetrahedra describe no body.
    #[error("{}", .0.iter().map(MeshFault::to_string).collect::<Vec<_>>().join("; "))]
    Mesh(Vec<MeshFault>),
    /// A node at a corner of one cell that is in the middle of an edge of another, or in the middle of two edges.
    #[error("node {node} is part of two different edges; refine the cells on both sides of a face alike")]
    Hanging {
        /// The node.
        node: u64,
    },
    /// An edge with different nodes in its middle.
    #[error(
        "the edge between nodes {} and {} has node {} in its middle in one cell and node {} in another; merge the two",
        ends[0], ends[1], middles[0], middles[1]
    )]
    TornEdge {
        /// Ends of the edge.
        ends: [u64; 2],
        /// Middle nodes of the edge.
        middles: [u64; 2],
    },
    /// A face of more than two cells.
    #[error(
        "the face between nodes {}, {} and {} belongs to {count} cells; two of them overlap, leave one out",
        corners[0], corners[1], corners[2]
    )]
    CrowdedFace {
        /// Corners of the face.
        corners: [u64; 3],
        /// Number of cells to which the face belongs.
        count: usize,
    },
    /// Cells between which no liquid passes.
    #[error("the liquid is in {count} pieces that share no face; give each cavity a mesh of its own")]
    Pieces {
        /// Number of pieces.
        count: usize,
    },
    /// All nodes are on walls.
    #[error("every node of the cavity is on a wall, so that nothing can flow; use smaller cells")]
    NoInterior,
    /// Moments too small or too large for floating point.
    #[error("the cavity holds {volume:e} m³, whose moments are out of the range of numbers; check the units")]
    OutOfRange {
        /// Volume (m³).
        volume: f64,
    },
    /// Cells so thin that the equations of the flow cannot be solved.
    #[error(
        "the cells of the cavity near ({:.4e}, {:.4e}, {:.4e}) are too thin for the flow to be found; \
         give them a better shape",
        at[0], at[1], at[2]
    )]
    Singular {
        /// Place of a node of these cells (m).
        at: [f64; 3],
    },
    /// The pressure is not found.
    #[error(
        "after {iterations} iterations the flow in the cavity still has a divergence of {divergence:.1e} of its \
         gradient; give the cells a better shape"
    )]
    NoConvergence {
        /// Iterations.
        iterations: usize,
        /// Divergence relative to the gradient of the flow without pressure, in the mean square.
        divergence: f64,
    },
}
