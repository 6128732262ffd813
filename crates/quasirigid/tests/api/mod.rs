//! The library as a program in Rust meets it.

mod input;
mod programs;
#[cfg(feature = "serde")]
mod serde;
mod threads;
