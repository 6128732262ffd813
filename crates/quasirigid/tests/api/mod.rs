//! The library as a program in Rust meets it.

mod input;
mod programs;
mod serde;
mod threads;
