//! Motion of a body: full, reduced, rigid.

mod conserved_momentum;
mod control;
mod damped;
mod event;
mod external;
mod form;
mod full;
mod initial_transient;
mod invariant_monitor;
mod layout;
mod momentum_sphere;
mod nutation;
mod position;
mod quadrature;
mod reduced;
mod reduced_stepper;
mod resting;
mod run;
mod scale;
mod slow;
mod spin;
mod spin_path;
mod spin_paths;
mod start;
mod starting;
mod steady;
mod stepper;
mod timing;

pub use crate::math::ode::Checkpoint;
pub use crate::math::simd::Rounding;
pub use crate::model::{Form, Method};
pub use damped::DampedMode;
pub use event::Event;
pub use external::Forced;
pub use full::{FullState, FullStepper, propagate_controlled, propagate_full};
pub(crate) use full::{MotionGuess, PeriodicMotion, periodic_motion};
pub use initial_transient::{BoundaryLayer, FastPart, composite_spin, matched_start};
pub use nutation::{Nutation, Nutations};
pub use reduced::propagate;
pub use reduced_stepper::ReducedStepper;
pub(crate) use run::check_times;
pub use run::{Observer, Options, Outcome, PropagateError, Run, Sample, Scan, Start};
pub use scale::spin_from_rest;
pub use slow::{
    ForcedTorque, MAX_FORCED_ORDER, RigidState, Ringing, SlowEquations, SlowPoint, SlowState, forced_torque,
    load_ratio_at_start, propagate_forced, slow_state_point, takes,
};
pub use spin_path::{SpinPath, spin_path};
pub use spin_paths::spin_paths;
pub use steady::{IsolatedSpin, SteadySpin, SteadySpins, all_steady_spins, steady_spin_near, steady_spins};
pub use stepper::{StepStatus, StepperError};
pub use timing::Missed;
