//! Finite elements: the matrices of a piece of elastic matter between nodes.

pub(super) mod beam;
mod block;
pub(super) mod elasticity;
mod element;
mod incompressible;
mod lumped;
pub(super) mod revolution;
pub(super) mod shell;
pub(super) mod solid;
pub(super) mod stokes;

pub(super) use block::Block;
pub(super) use element::{Element, Grain, Site, Turn};
pub(super) use lumped::{Link, Mass, rigid_points};
