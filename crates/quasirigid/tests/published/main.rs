//! Do we get the numbers that others printed?
#![allow(non_snake_case)]

mod chernousko_1973;
mod explorer_1;
mod one_sprung_mass;
