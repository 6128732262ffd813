//! The full stiff system: the reference for the reduced equations. (T1)

mod drives;
mod periodic;
mod propagate;
mod solver;
mod start;
mod stepper;
mod stiff_part;
mod system;

pub use periodic::{MotionGuess, PeriodicMotion, periodic_motion};
pub use propagate::{propagate_controlled, propagate_full};
pub use start::FullState;
pub use stepper::FullStepper;
