//! Flows of viscous and of ideal liquids in cavities: finite elements in a mesh, polynomials of the meridian of a cavity of revolution.

mod incompressible;
pub(crate) mod potential_flow;
pub(crate) mod revolution;
pub(crate) mod stokes;

/// Velocity of a flow at a place, in the unit of the flow.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Velocity {
    pub u: [f64; 3],
    /// `∂u_i/∂x_k`, rows `i` (1/m).
    pub gradient: [[f64; 3]; 3],
}
