//! Mathematics that knows no physics.

pub mod bisection;
pub mod cholesky;
pub mod dynamic_stiffness;
pub mod eigen;
pub mod elliptic;
pub mod expression;
pub mod factor;
pub mod krylov;
pub mod mesh;
pub mod ode;
mod parts;
pub mod polynomial;
pub mod quadrature;
pub mod rotation;
pub mod scalar;
pub mod simd;
pub mod span;
pub mod sparse;
pub mod surface;
pub mod sym;
pub mod symmetric;
pub mod taylor;
