//! Errors of closed surfaces: kinds of fault for which triangles enclose no body.
//! Messages count from 1, as files and mesh tools do, the fields from 0; the first fault and the count are enough to mend a surface.

use thiserror::Error;

/// Fault for which triangles enclose no body. Fields count vertices and triangles from 0, messages from 1.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum SurfaceError {
    /// Fewer triangles than a tetrahedron has.
    #[error("{triangles} triangles enclose nothing; a closed surface has at least 4")]
    TooFew {
        /// Number of triangles.
        triangles: usize,
    },
    /// A triangle with a corner that is not in the list of vertices.
    #[error("triangle {} has the corner {}, but there are {vertices} vertices{}", triangle + 1, index.saturating_add(1), among(*count, "triangles"))]
    NoSuchVertex {
        /// The first such triangle.
        triangle: usize,
        /// Index of the corner.
        index: usize,
        /// Number of vertices.
        vertices: usize,
        /// Number of triangles with such a corner.
        count: usize,
    },
    /// A vertex at NaN or at infinity.
    #[error("vertex {} is at no finite place{}", vertex + 1, among(*count, "vertices"))]
    NotFinite {
        /// The first such vertex.
        vertex: usize,
        /// Number of such vertices.
        count: usize,
    },
    /// A triangle without area: a corner twice, or all three on a line to within rounding.
    #[error(
        "triangle {} has no area{}; merge its corners, or take it out and close the gap",
        triangle + 1, among(*count, "triangles")
    )]
    Degenerate {
        /// The first such triangle.
        triangle: usize,
        /// Number of such triangles.
        count: usize,
    },
    /// An edge that belongs to one triangle only.
    #[error(
        "the edge between vertices {} and {} of triangle {} is open{}; fill the hole, and let triangles that meet share their vertices",
        edge[0] + 1, edge[1] + 1, triangle + 1, among(*count, "edges")
    )]
    Open {
        /// Ends of the first such edge, in the direction of its triangle.
        edge: [usize; 2],
        /// Triangle of the edge.
        triangle: usize,
        /// Number of open edges.
        count: usize,
    },
    /// An edge of more than two triangles.
    #[error(
        "the edge between vertices {} and {} belongs to {} triangles, {}{}; two is right: take out walls inside the body, and give bodies that touch vertices of their own",
        edge[0] + 1, edge[1] + 1, triangles.len(), listed(triangles), among(*count, "edges")
    )]
    NonManifold {
        /// Ends of the first such edge.
        edge: [usize; 2],
        /// Triangles of the edge.
        triangles: Vec<usize>,
        /// Number of such edges.
        count: usize,
    },
    /// An edge that both its triangles pass in the same direction, so that one of them is reversed.
    #[error(
        "triangles {} and {} both run from vertex {} to vertex {}{}; turn one of them around",
        triangles[0] + 1, triangles[1] + 1, edge[0] + 1, edge[1] + 1, among(*count, "edges")
    )]
    TwiceOriented {
        /// Ends of the first such edge, in the direction of its triangles.
        edge: [usize; 2],
        /// Triangles of the edge.
        triangles: [usize; 2],
        /// Number of such edges.
        count: usize,
    },
    /// Two triangles that cross or touch where they share no corner, or lie back to back.
    #[error(
        "triangles {} and {} cross or touch{}; a surface must not meet itself: pull them apart, or join the parts into one body",
        triangles[0] + 1, triangles[1] + 1, among(*count, "pairs")
    )]
    SelfIntersecting {
        /// The first such pair.
        triangles: [usize; 2],
        /// Number of such pairs; no more than 1000 are counted.
        count: usize,
    },
    /// The surface looks inward: what it encloses has a negative volume.
    #[error(
        "the surface encloses a negative volume; turn all triangles around, so that they run counterclockwise seen from outside"
    )]
    Inward,
    /// A shell that looks inward, as a cavity does, without being in a body.
    #[error(
        "the shell of triangle {} looks inward like a cavity but lies in no body{}; turn its triangles around",
        triangle + 1, among(*count, "shells")
    )]
    LooseCavity {
        /// A triangle of the first such shell.
        triangle: usize,
        /// Number of such shells.
        count: usize,
    },
    /// A shell that looks outward inside the body, whose volume would count twice.
    #[error(
        "the shell of triangle {} lies inside the body and looks outward{}; turn its triangles around if it is a cavity, else leave it out",
        triangle + 1, among(*count, "shells")
    )]
    Buried {
        /// A triangle of the first such shell.
        triangle: usize,
        /// Number of such shells.
        count: usize,
    },
}

/// Words for an element that is the first of several.
fn among(count: usize, elements: &str) -> String {
    if count > 1 { format!(", the first of {count} such {elements}") } else { String::new() }
}

/// Numbers of elements, from 1.
fn listed(elements: &[usize]) -> String {
    elements.iter().map(|index| (index + 1).to_string()).collect::<Vec<_>>().join(", ")
}
