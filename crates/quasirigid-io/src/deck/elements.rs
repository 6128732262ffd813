//! Elements of a deck: solids, plates, beams, rods, bodies at grid points, springs, bushings, and grid points that follow others.
//! They name grid points and properties by number, in the unit of the deck and along the axes of its basic system.

/// A solid cell; a grid point of an edge may be missing.
pub(crate) struct Solid {
    pub label: u64,
    pub property: u64,
    /// Corners of its shape: 4, 5, 6 or 8.
    pub corners: usize,
    /// Grid points in the order of its shape; zero where one is missing.
    pub nodes: Vec<u64>,
    pub line: usize,
}

/// A plate cell.
pub(crate) struct Plate {
    pub label: u64,
    pub property: u64,
    /// Corners: 3 or 4.
    pub corners: usize,
    /// Grid points; zero where one of an edge is missing.
    pub nodes: Vec<u64>,
    /// Angle (degrees) of the material from the first side, or the direction of its axis in the basic system.
    pub angle: f64,
    pub reference: Option<[f64; 3]>,
    pub offset: f64,
    /// Mean of the thicknesses at its corners, where the card has them.
    pub thickness: Option<f64>,
    pub line: usize,
}

/// Direction of the first plane of a beam.
#[derive(Clone, Copy)]
pub(crate) enum Up {
    /// Along the axes of the displacements of the first end.
    Vector([f64; 3]),
    /// Along the axes of the basic system.
    Basic([f64; 3]),
    /// Towards a grid point.
    Point(u64),
}

/// A beam or a rod.
pub(crate) struct Line {
    pub label: u64,
    pub property: u64,
    pub ends: [u64; 2],
    pub up: Option<Up>,
    /// Offsets of the ends, along the axes of their displacements.
    pub offsets: [[f64; 3]; 2],
    /// Components that each end does not bear, 1 to 6 along the beam's axes.
    pub released: [u64; 2],
    pub line: usize,
}

/// A rigid body at a grid point.
pub(crate) struct Tip {
    pub node: u64,
    pub mass: f64,
    /// From the grid point.
    pub offset: [f64; 3],
    /// About the centre of mass.
    pub inertia: [[f64; 3]; 3],
    pub line: usize,
}

/// End of a scalar spring: a grid point and a component from 1.
#[derive(Clone, Copy)]
pub(crate) struct SpringEnd {
    pub node: u64,
    pub component: u64,
}

/// A scalar spring or dashpot.
pub(crate) struct Scalar {
    pub ends: [Option<SpringEnd>; 2],
    /// Stiffness and damping, or the property that has them.
    pub law: Result<[f64; 2], u64>,
    pub line: usize,
}

/// A bushing.
pub(crate) struct Bush {
    pub property: u64,
    pub ends: [u64; 2],
    pub up: Option<Up>,
    /// Axes of its stiffnesses, where they are given.
    pub axes: Option<[[f64; 3]; 3]>,
    /// Place of the elastic centre between the ends, as a share of their distance.
    pub share: f64,
    pub line: usize,
}

/// A spring or dashpot along the line between two grid points.
pub(crate) struct Axial {
    pub ends: [u64; 2],
    /// Stiffness and damping.
    pub law: [f64; 2],
    pub line: usize,
}

/// Grid points that follow another one as a rigid piece, in some components.
pub(crate) struct Stiff {
    pub base: u64,
    pub nodes: Vec<u64>,
    /// Components from 0 that follow.
    pub components: [bool; 6],
    pub line: usize,
}

/// A grid point that follows the weighted mean of others.
pub(crate) struct Mean {
    pub node: u64,
    /// Components from 0 that follow.
    pub components: [bool; 6],
    /// Weight, components and grid points.
    pub others: Vec<(f64, [bool; 6], Vec<u64>)>,
    pub line: usize,
}

/// Term of an equation: the displacement or rotation of a grid point along a vector of the basic system, whose length is the factor.
#[derive(Clone, Copy)]
pub(crate) struct Term {
    pub node: u64,
    pub rotates: bool,
    pub along: [f64; 3],
}

/// Sums of terms that stay zero.
pub(crate) struct Equations {
    /// The grid point that they make follow others, which it does once; none where they only bind components.
    pub follower: Option<u64>,
    pub sums: Vec<Vec<Term>>,
    pub line: usize,
}
