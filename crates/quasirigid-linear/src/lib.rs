//! Linear algebra of [`quasirigid`](https://docs.rs/quasirigid): symmetric matrices, dense and sparse, their factors and
//! lowest modes.
//!
//! No physics is known here. A crate of its own, because the library beneath, `faer`, takes minutes to compile for each
//! number format that is used; none of its types shows in a signature.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

pub mod cholesky;
pub mod dynamic_stiffness;
pub mod eigen;
pub mod factor;
pub mod krylov;
pub mod lu;
pub mod memory;
pub mod span;
pub mod sparse;
pub mod state_space;
pub mod symmetric;
pub mod threads;
pub mod watch;
