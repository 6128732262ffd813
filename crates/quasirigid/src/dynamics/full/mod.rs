//! The full stiff system: the truth that the reduced equations are measured against.

mod layout;
mod propagate;
mod solver;
mod start;
mod system;

pub use propagate::{FullOptions, propagate_full};
pub use solver::Method;
pub use start::FullState;
