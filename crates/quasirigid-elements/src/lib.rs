//! Parts of a body for [`quasirigid`](https://docs.rs/quasirigid): what a user describes, and how it becomes one flexible body.
//!
//! [`elements`] are points, springs, hinges, beams, plates, solids, surfaces, liquids, rotors and matrices of other programs, assembled
//! into a flexible body; [`problems`] are bodies with known answers. Finite elements, flows in cavities and their component modes stand
//! behind them.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

use quasirigid_body as model;
use quasirigid_math as math;

mod finite;

mod flow;

mod structure;

pub mod elements;

pub mod problems;
