//! The full stiff system: the truth that the reduced equations are measured against.

mod propagate;
mod solver;
mod start;
mod stiff_part;
mod system;

pub use propagate::propagate_full;
pub use start::FullState;
