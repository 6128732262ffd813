//! Initial value problems.

mod dop853;
mod tableau;

pub use dop853::{Dense, Dop853, StepError, System, Work};
