//! Matrices, factors, eigenvalues, solutions and truncations, against dense solvers and closed forms.
#![allow(non_snake_case, clippy::unwrap_used)]

mod cholesky;
mod dynamic_stiffness;
mod eigen;
mod factor;
mod krylov;
mod lu;
mod span;
mod state_space;
mod symmetric;
