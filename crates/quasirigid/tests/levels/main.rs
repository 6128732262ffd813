//! Steady spins and ageing along the levels of the slow energy, for moments that are nearly equal: against integrations, against
//! averages along rigid polhodes, and laws.

#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

#[path = "../laws/support.rs"]
#[allow(dead_code)]
mod support;
#[path = "../laws/transform.rs"]
#[allow(dead_code)]
mod transform;

mod bodies;
mod criteria;
mod follow;
mod polhodes;
mod steady;
