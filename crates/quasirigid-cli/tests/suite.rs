//! Every test of the program in one program, which is linked once.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod cli;
mod support;
