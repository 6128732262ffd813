//! The library as a program in Rust uses it.

mod input;
mod programs;
mod serde;
mod threads;
