//! Spectral submanifolds: invariant manifolds of a polynomial system, tangent to a few modes of an equilibrium, degree by degree.
//!
//! The system has the form `d/dt P(x) = F(x)` with polynomial momenta `P` and forces `F`, `F(x₀) = 0`. The manifold is `x = W(z)`, the motion
//! on it `ż = R(z)`; one complex coordinate `z_k` for each master mode `λ_k`. (W1), docs/theory/18-submanifolds.md.

mod eigenpair;
mod expansion;
mod homological;
mod linear_part;
mod manifold;
mod ring;
mod system;

pub use eigenpair::Eigenpair;
pub use expansion::{ExpansionError, Plan, Style, expand};
pub use linear_part::{LinearMode, LinearPart};
pub use manifold::{InvariantManifold, Master, Monomials, NearResonance, Residual};
pub use ring::{Ring, Truncated};
pub use system::{Equations, PolynomialSystem};
