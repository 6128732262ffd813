//! Model files, records and exports.
#![allow(non_snake_case)]

pub mod record;
