//! Shapes of cells: kinds of lines, faces and solids, with the order of their nodes.
//! Readers permute the nodes of a format into this order; every table of shape functions depends on it.
//! Orders of VTK and Abaqus.

/// Shape of a cell: its form and its number of nodes.
///
/// Corners come first, then the middles of edges, then of faces, then of the cell. The corners of a solid are the lower
/// face counter-clockwise seen from above, then the upper one in the same order; edges are those of the lower face from
/// its first corner on, then those of the upper face, then the upright ones (of a tetrahedron: 01 12 20 03 13 23). These
/// are the orders of VTK and Abaqus up to quadratic hexahedra with 20 nodes; faces of a hexahedron with 27 nodes:
/// −ξ, +ξ, −η, +η, −ζ, +ζ.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    /// Segment with two nodes.
    Line2,
    /// Segment with a node in its middle.
    Line3,
    /// Triangle.
    Triangle3,
    /// Triangle with nodes in the middles of its edges.
    Triangle6,
    /// Quadrilateral.
    Quad4,
    /// Quadrilateral with nodes in the middles of its edges.
    Quad8,
    /// Quadrilateral with nodes in the middles of its edges and its own.
    Quad9,
    /// Tetrahedron.
    Tet4,
    /// Tetrahedron with nodes in the middles of its edges.
    Tet10,
    /// Wedge.
    Wedge6,
    /// Wedge with nodes in the middles of its edges.
    Wedge15,
    /// Hexahedron.
    Hex8,
    /// Hexahedron with nodes in the middles of its edges.
    Hex20,
    /// Hexahedron with nodes in the middles of its edges, its faces and its own.
    Hex27,
}

impl Shape {
    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        match self {
            Self::Line2 => 2,
            Self::Line3 | Self::Triangle3 => 3,
            Self::Quad4 | Self::Tet4 => 4,
            Self::Triangle6 | Self::Wedge6 => 6,
            Self::Quad8 | Self::Hex8 => 8,
            Self::Quad9 => 9,
            Self::Tet10 => 10,
            Self::Wedge15 => 15,
            Self::Hex20 => 20,
            Self::Hex27 => 27,
        }
    }

    /// Number of corners, which are the first nodes.
    #[must_use]
    pub fn corners(self) -> usize {
        match self {
            Self::Line2 | Self::Line3 => 2,
            Self::Triangle3 | Self::Triangle6 => 3,
            Self::Quad4 | Self::Quad8 | Self::Quad9 | Self::Tet4 | Self::Tet10 => 4,
            Self::Wedge6 | Self::Wedge15 => 6,
            Self::Hex8 | Self::Hex20 | Self::Hex27 => 8,
        }
    }

    /// Dimension: 1 for lines, 2 for faces, 3 for solids.
    #[must_use]
    pub fn dimension(self) -> usize {
        match self {
            Self::Line2 | Self::Line3 => 1,
            Self::Triangle3 | Self::Triangle6 | Self::Quad4 | Self::Quad8 | Self::Quad9 => 2,
            _ => 3,
        }
    }
}

impl std::fmt::Display for Shape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = match self {
            Self::Line2 | Self::Line3 => "line",
            Self::Triangle3 | Self::Triangle6 => "triangle",
            Self::Quad4 | Self::Quad8 | Self::Quad9 => "quadrilateral",
            Self::Tet4 | Self::Tet10 => "tetrahedron",
            Self::Wedge6 | Self::Wedge15 => "wedge",
            Self::Hex8 | Self::Hex20 | Self::Hex27 => "hexahedron",
        };
        write!(f, "{name} of {} nodes", self.nodes())
    }
}
