//! Beam element: straight, in space, two nodes with six degrees of freedom each, a translation (m) and a rotation vector (rad), both in the
//! axes of the body; first those of the first node.

mod element;
mod error;
mod forces;
mod geometric;
mod interpolation;
mod lumped_masses;
mod mass;
mod section;
mod stiffness;
#[cfg(test)]
mod tests;

pub(crate) use element::{Beam, BeamMaterial};
pub use error::{BeamError, Quantity};
pub use section::{Section, SectionShape};

use nalgebra::{SMatrix, SVector};

/// A symmetric matrix over the coordinates of both nodes.
type Matrix12 = SMatrix<f64, 12, 12>;
/// Coordinates of both nodes.
type Vector12 = SVector<f64, 12>;
