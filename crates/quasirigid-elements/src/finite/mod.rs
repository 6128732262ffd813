//! Finite elements: stiffness, mass and geometric stiffness of elastic material between nodes.

pub(crate) mod beam;
mod block;
pub(crate) mod elasticity;
mod element;
mod lumped;
pub(crate) mod shell;
pub(crate) mod solid;

pub(crate) use block::Block;
pub(crate) use element::{Connectivity, Element, LumpedMass, MassLocation, Turn, carried};
pub(crate) use lumped::{Link, Mass, rigid_points};
