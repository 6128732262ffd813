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

/// Velocity of a flow at a place, in the unit of the flow.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Velocity {
    pub u: [f64; 3],
    /// `∂u_i/∂x_k`, rows `i` (1/m).
    pub gradient: [[f64; 3]; 3],
}

pub(super) use block::Block;
pub(super) use element::{Element, Grain, Site, Turn};
pub(super) use lumped::{Link, Mass, rigid_points};
