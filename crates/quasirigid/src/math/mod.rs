//! Mathematics that knows no physics.

pub mod cholesky;
pub mod eigen;
pub mod polynomial;
pub mod sparse;
pub mod sym;
