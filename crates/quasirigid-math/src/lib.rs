//! Mathematics of [`quasirigid`](https://docs.rs/quasirigid) without physics: vectors and symmetric matrices, rotations, homogeneous
//! polynomials and their series, elliptic functions, quadrature, integrators of differential equations, and formulas that users write.
//!
//! The linear algebra of `quasirigid-linear` is shown here beside it, so that one name reaches both.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

pub mod arnoldi;
pub mod bisection;
pub mod blocks;
pub mod chebyshev;
pub mod connected_components;
pub mod derivative;
pub mod elliptic;
pub mod expression;
pub mod gmres;
pub mod lanes;
pub mod least_squares;
pub mod nonnegative;
pub mod ode;
pub mod periodic;
pub mod polynomial;
pub mod quadrature;
pub mod random;
pub mod rotation;
pub mod scalar;
pub mod simd;
pub mod sphere;
pub mod spherical_harmonics;
pub mod stopwatch;
pub mod submanifold;
pub mod sym3;
pub mod taylor;
pub mod vec3;

/// Whether the compiler optimised what computes; if not, an answer is the same and takes some ten times as long.
pub const OPTIMIZED: bool = cfg!(optimized);

pub use quasirigid_linear::{
    cholesky, dynamic_stiffness, eigen, factor, krylov, lu, memory, span, sparse, state_space, symmetric,
    threads, watch,
};
