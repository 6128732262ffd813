//! Fuzz targets of quasirigid: every reader of what a user writes, and the laws that every body keeps.
//!
//! A target takes bytes and panics where a promise is broken. [`targets::TARGETS`] is the one list: the tests replay the corpus and the
//! regressions of each target and execute some thousands of mutated inputs, the program of this crate does the same for hours, and the folder
//! `fuzz` of the repository hands the targets to libFuzzer.
#![allow(non_snake_case)]

pub mod campaign;
pub mod corpus;
pub mod execution;
mod grammar;
pub mod heap;
mod laws;
pub mod minimize;
pub mod mutation;
pub mod random;
pub mod scratch;
pub mod targets;
pub mod worker;
