//! Model files, records and exports.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

pub mod array_file;
pub mod attitude;
mod deck;
pub mod disk;
pub mod estimate;
pub mod export;
pub mod files_read;
pub mod history_file;
mod inp;
pub mod light_curve;
pub mod matrix;
pub mod measured_file;
pub mod mesh;
pub mod model;
mod nastran;
mod nearest;
mod npy;
pub mod plan;
mod pyramid;
pub mod record;
pub mod study_file;
pub mod table_file;
pub mod text_file;
pub mod units;
pub mod visible;
