//! The library as a program in Rust meets it.

mod input;
mod threads;
