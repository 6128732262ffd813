//! Every test of the program in one program, which is linked once: the command line, and published cases.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod cli;
mod published;
mod support;
