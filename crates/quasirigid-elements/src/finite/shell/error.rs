//! Errors of shells: cells and layers from which no element can be made.
//! Checked before any matrix is made: a cell of no area or a concave corner would give a singular Jacobian, not a message.

use thiserror::Error;

use quasirigid_mesh::Shape;

/// Error of a shell that no structure can have.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ShellError {
    /// The cell is no triangle of three or quadrilateral of four nodes.
    #[error(
        "a shell is a triangle of 3 or a quadrilateral of 4 nodes, not a {shape}; refine or split the cell"
    )]
    Shape {
        /// Shape of the cell.
        shape: Shape,
    },
    /// The cell has another number of nodes than its shape.
    #[error("a {shape} was given {found} nodes")]
    Nodes {
        /// Shape of the cell.
        shape: Shape,
        /// Number of nodes given.
        found: usize,
    },
    /// The corners enclose no area, or are not finite.
    #[error("an area of {area} m² has a longest side of {side} m; merge the nodes or remove the cell")]
    Area {
        /// The area (m²).
        area: f64,
        /// The longest side (m).
        side: f64,
    },
    /// A corner of a quadrilateral is not convex.
    #[error("the angle at node {node} is 180 degrees or more; order the nodes around the cell, or split it")]
    Concave {
        /// Number of the node in the cell, from 1.
        node: usize,
    },
    /// The direction of the layers is along the normal.
    #[error(
        "only {share} of the reference direction is in the plane of the element; choose one along the surface"
    )]
    Reference {
        /// Share of the direction in the plane.
        share: f64,
    },
    /// The displacement does not have six numbers per node.
    #[error("the displacement has {found} numbers where the nodes have {expected}")]
    Displacement {
        /// Expected length.
        expected: usize,
        /// Length found.
        found: usize,
    },
    /// A constant of a layer that must be positive is not.
    #[error("ply {}: {name} = {value}; it must be positive and finite", ply + 1)]
    Positive {
        /// Index of the layer.
        ply: usize,
        /// The constant.
        name: Constant,
        /// Value given.
        value: f64,
    },
    /// Poisson's ratio of a layer would make energy negative.
    #[error("ply {}: Poisson's ratio nu12 = {value}; its square must be below E1/E2 = {limit}", ply + 1)]
    Poisson {
        /// Index of the layer.
        ply: usize,
        /// The ratio.
        value: f64,
        /// Bound of the square of the ratio.
        limit: f64,
    },
    /// An angle or offset is not finite.
    #[error("{name} = {value}; it must be finite")]
    NotFinite {
        /// The number.
        name: Constant,
        /// Value given.
        value: f64,
    },
}

/// A number that describes a layer or its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constant {
    /// Young's modulus along the fibres.
    E1,
    /// Young's modulus across the fibres.
    E2,
    /// Shear modulus in the plane.
    G12,
    /// Transverse shear modulus along the fibres.
    G13,
    /// Transverse shear modulus across the fibres.
    G23,
    /// Density.
    Density,
    /// Thickness.
    Thickness,
    /// Angle.
    Angle,
    /// Offset of the mid-surface from the nodes.
    Offset,
}

impl std::fmt::Display for Constant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::E1 => "E1",
            Self::E2 => "E2",
            Self::G12 => "G12",
            Self::G13 => "G13",
            Self::G23 => "G23",
            Self::Density => "density",
            Self::Thickness => "thickness",
            Self::Angle => "angle",
            Self::Offset => "offset of the mid-surface",
        })
    }
}
