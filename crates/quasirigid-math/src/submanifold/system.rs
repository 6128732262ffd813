//! Polynomial systems in momenta, `d/dt P(x) = F(x)`.

use super::ring::{Ring, Truncated};

/// System `d/dt P(x) = F(x)` whose momenta `P` and forces `F` are polynomials of the state, (W1).
///
/// The same polynomials serve every ring: without variables they give values, of degree one derivatives, of a higher degree expansions.
pub trait PolynomialSystem {
    /// Number of components of the state.
    fn size(&self) -> usize;

    /// Momenta and forces where the components of the state are these polynomials.
    fn equations(&self, ring: &Ring, x: &[Truncated]) -> Equations;

    /// Size of each component: a unit in which all are comparable.
    fn scales(&self) -> Vec<f64>;

    /// Quantity that the motion conserves, as a polynomial of the momenta; its level is kept exactly by the expansion.
    fn conserved(&self, ring: &Ring, momenta: &[Truncated]) -> Option<Truncated> {
        let _ = (ring, momenta);
        None
    }
}

/// Momenta and forces, one of each for every component.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Momenta `P`.
    pub momenta: Vec<Truncated>,
    /// Forces `F`.
    pub forces: Vec<Truncated>,
}
