//! Millions of turns: the torque-free motion in closed form, and what dissipation makes of it on average.

mod evolution;
mod observed;
mod poinsot;

pub use evolution::{Evolution, Stage};
pub use observed::{ObservedError, ObservedPeriods};
pub use poinsot::FreeRotation;
