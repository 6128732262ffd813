//! A run record as one self-contained HTML page.
//!
//! The page reads from the top like an answer: may the numbers be trusted, what happened to the spin, how it happened,
//! and then every table needed to check it. It asks the network for nothing, and needs nothing but the
//! [`RunRecord`](quasirigid_io::record::RunRecord), so a report can be remade years after the run.
//!
//! Charts are written as SVG here and not by a plotting library: their colours are CSS classes, so that one file serves
//! light, dark and print; their text keeps its size while the plot narrows to a telephone; and their curves are thinned
//! by pixel column, which keeps every extreme of a history of any length.
#![allow(non_snake_case)]
#![cfg_attr(test, allow(clippy::unwrap_used))]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

mod charts;
mod columns;
mod comparison;
mod figure;
mod figures;
mod gltf;
mod motion;
mod number;
mod packed;
mod page;
mod png;
mod sections;
mod sphere;
mod study;
mod verdict;
mod viewer;

pub use comparison::{Compared, comparison_page};
pub use figures::fill_map::fill_map_picture;
pub use figures::fit::{FitColumn, fit_picture};
pub use figures::light_curve::light_curve_picture;
pub use figures::tornado::tornado_picture;
pub use figures::yorp::yorp_picture;
pub use figures::{figure_names, picture};
pub use gltf::{GltfOptions, gltf, revolutions_per_frame};
pub use page::page;
pub use png::{PngError, png};
pub use sphere::sphere_picture;
pub use study::study_page;
