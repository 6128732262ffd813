//! Spin of almost rigid bodies: reduction, validity and propagation after Chernousko (1978).
#![allow(non_snake_case)]

pub mod dynamics;
pub mod elements;
pub mod math;
pub mod model;
pub mod problems;
pub mod reduction;
