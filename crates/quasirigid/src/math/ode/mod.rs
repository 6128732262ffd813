//! Initial value problems.

mod dop853;
mod integrate;
mod tableau;

pub use dop853::{Dense, Dop853, StepError, System, Work};
pub use integrate::{Ending, Watcher, integrate};
