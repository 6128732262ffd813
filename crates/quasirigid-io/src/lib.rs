//! Model files, records and exports.
#![allow(non_snake_case)]

pub mod export;
pub mod matrix;
pub mod mesh;
pub mod model;
mod nearest;
pub mod record;
pub mod text_file;
pub mod units;
