//! Mathematics that knows no physics.

pub mod bisection;
pub mod chebyshev;
pub mod elliptic;
pub mod expression;
pub mod gmres;
pub mod mesh;
pub mod meshing;
pub mod ode;
pub(crate) mod parts;
pub mod polynomial;
pub mod quadrature;
pub mod rotation;
pub mod scalar;
pub mod simd;
pub mod sphere;
pub mod surface;
pub mod sym;
pub mod taylor;

pub use quasirigid_linear::{
    cholesky, dynamic_stiffness, eigen, factor, krylov, lu, memory, span, sparse, symmetric, watch,
};
