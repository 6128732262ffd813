//! Reduced motion of a body under external forces, by series in time at each state.

mod equations;
mod flow;
mod load_ratio;
mod motion;
mod oscillator;
mod propagate;
mod ringing;
mod state;
mod system;
mod torque;

pub use equations::SlowEquations;
pub use flow::{MAX_FORCED_ORDER, SlowPoint};
pub use load_ratio::load_ratio_at_start;
pub use propagate::{propagate_forced, takes};
pub use ringing::Ringing;
pub use state::{SlowState, slow_state_point};
pub use torque::{ForcedTorque, RigidState, forced_torque};
