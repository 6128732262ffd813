//! Motion of a body for [`quasirigid`](https://docs.rs/quasirigid): reduced equations, histories, modes, averages.
//!
//! The modules stand in the order the data flows: [`reduction`] derives the reduced equations, [`dynamics`] integrates them and the full
//! stiff system, [`modes`] has the small motions about a steady spin and [`submanifold`] the reduced equations there, [`averaging`]
//! follows the secular evolution, [`secular`] judges and measures it, [`verification`] compares.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

use quasirigid_body as model;
#[cfg(test)]
use quasirigid_elements as elements;
#[cfg(test)]
use quasirigid_elements::problems;
use quasirigid_math as math;

pub mod reduction;

pub mod dynamics;

pub mod averaging;

pub mod modes;

pub mod submanifold;

pub mod secular;

pub mod verification;
