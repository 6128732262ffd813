//! Hill's equations of the internal coordinates along a polhode, each answer by a second road.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

#[allow(dead_code)]
#[path = "../laws/support.rs"]
mod support;
#[allow(dead_code)]
#[path = "../laws/transform.rs"]
mod transform;

mod bodies;
mod oracle;

mod full;
mod limits;
mod linear;
