//! Every test of the program in one program, which is linked once: what its users meet, and what others printed.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod cli;
mod published;
mod support;
