//! Model files, records and exports.
#![allow(non_snake_case)]

pub mod export;
mod file;
pub mod matrix;
pub mod mesh;
pub mod model;
mod nearest;
pub mod record;
pub mod units;
