//! Do we get the numbers that others printed?
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod chernousko_1973;
mod common_problem;
mod elliptic;
mod explorer_1;
mod one_sprung_mass;
