//! Initial value problems.

mod age;
mod checkpoint;
mod dop853;
mod dop853_lanes;
mod dop853_tableau;
mod ensemble;
mod integrate;
mod radau;
mod radau_iteration;
mod radau_lanes;
mod radau_predictor;
mod radau_search;
mod radau_shifts;
mod radau_stages;
mod radau_tableau;
mod stiff;
mod stretch;
mod system;

pub use checkpoint::Checkpoint;
pub use dop853::Dop853;
pub use dop853_lanes::{LaneStart, LaneSystem};
pub use ensemble::{LaneRun, integrate_lanes};
pub use integrate::{StepObserver, StopReason, integrate, integrate_until};
pub use radau::Radau;
pub use stiff::Stiff;
pub use stretch::{StepRule, Stretch};
pub use system::{DenseOutput, Solver, State, StepError, System, Work};
