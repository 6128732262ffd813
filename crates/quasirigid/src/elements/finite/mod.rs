//! Finite elements: the matrices of a piece of elastic matter between nodes.

pub(super) mod beam;
mod element;
pub(super) mod elasticity;
mod lumped;
pub(super) mod solid;

pub(super) use element::{Element, Grain, Turn};
pub(super) use lumped::{Link, Mass};
