//! Motion of a body: full, reduced, rigid.

mod form;
mod full;
mod propagate;
mod spin;
mod spin_path;
mod start;
mod steady;

pub use form::Form;
pub use full::{FullOptions, FullState, Method, propagate_full};
pub use propagate::{Observer, Options, Outcome, PropagateError, Run, Sample, SpinState, propagate};
pub use spin_path::{SpinPath, spin_path};
pub use steady::{SteadySpin, steady_spins};
