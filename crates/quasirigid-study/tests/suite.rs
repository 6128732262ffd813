//! Every test of what a study answers in one program, which is linked once.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod study;
mod support;
