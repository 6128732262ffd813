use crate::Incomplete;
use crate::element::Element;
use crate::model::Rheology;

/// A joint between parts, or between a part and the carrier.
///
/// Both sides move as one rigid piece, but for rotations about the axes of the joint: none for a weld, one for a hinge, three for a ball.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// One side.
    pub from: Anchor,
    /// The other side.
    pub to: Anchor,
    /// Axes of relative rotation, in the file's frame; of any length but zero.
    pub axes: Vec<[f64; 3]>,
    /// Stiffness about each axis (N·m/rad).
    pub stiffness: Vec<f64>,
    /// Damping about each axis (N·m·s/rad).
    pub damping: Vec<f64>,
    /// Rheology of the springs: response to periodic strain, beside the damping.
    pub rheology: Rheology,
}

/// One side of a connection.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum Anchor {
    /// The carrier.
    Carrier,
    /// Nodes of a part, one or more.
    Nodes {
        /// Index of the part.
        part: usize,
        /// Indices of the nodes in it.
        nodes: Vec<usize>,
    },
}

impl Element for Connection {
    fn incomplete(&self) -> Vec<Incomplete> {
        if self.axes.is_empty() { Vec::new() } else { vec![Incomplete::Hinges] }
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        vec![&mut self.rheology]
    }
}
