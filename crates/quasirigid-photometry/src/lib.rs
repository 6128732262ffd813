//! Brightness of a body in sunlight, seen from far away.
//!
//! - [`Facets`] are the outer surface of a body, with the shadows of one facet on another,
//! - a [`Law`] of scattering gives the light of a facet, and [`magnitude`] that of the body,
//! - [`spectral_lines`] finds the frequencies of a light curve, [`frequency_pairs`] the two of a tumbling body.
//!
//! Equations (O7) to (O17), docs/theory/24-light-curves.md.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

mod error;
mod facets;
mod hapke;
mod lattice;
mod magnitude;
mod phase;
mod scattering;
mod spectrum;

pub use error::PhotometryError;
pub use facets::Facets;
pub use hapke::Hapke;
pub use lattice::{FrequencyPair, LineNumbers, explained, frequency_pairs, numbers_of, tells_numbers};
pub use magnitude::{ASTRONOMICAL_UNIT, SUN_MAGNITUDE, albedo, magnitude};
pub use phase::Phase;
pub use scattering::{Law, LawAt, Scattering};
pub use spectrum::{Line, Spectrum, spectral_lines};
