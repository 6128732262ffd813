//! Motion of a reduced body.

mod form;
mod propagate;
mod spin;
mod spin_path;
mod start;
mod steady;

pub use form::Form;
pub use propagate::{Observer, Options, Outcome, PropagateError, Run, Sample, SpinState, propagate};
pub use spin_path::{SpinPath, spin_path};
pub use steady::{SteadySpin, steady_spins};
