//! Finite elements: the matrices of a piece of elastic matter between nodes.

pub(super) mod beam;
mod element;
mod lumped;

pub(super) use element::{Element, Grain, Turn};
pub(super) use lumped::{Link, Mass};
