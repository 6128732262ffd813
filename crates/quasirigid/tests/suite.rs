//! Every test of the physics crate in one program, which is linked once: a folder for each question.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod support;

mod api;
mod hill;
mod inside;
mod laws;
mod levels;
mod published;
mod structures;
mod submanifold;
