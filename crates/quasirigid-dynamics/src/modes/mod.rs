//! Small motions about a steady spin: relative equilibria, and the modes of the spinning body.

mod blocks;
mod campbell;
mod candidates;
mod cantilever;
mod count;
mod definite;
mod deflation;
mod displacements;
mod driven;
mod equilibrium;
mod error;
mod first_order;
mod forced;
mod frozen_spins;
mod guess;
mod iteration;
mod krylov;
mod lag;
mod mode;
mod nutation;
mod onset;
mod pencil;
mod range;
mod shares;
mod slow;
mod slowest;
mod spectrum;
mod stated;
mod unknowns;

pub use campbell::{CampbellError, SpinEigenvalues, campbell};
pub use cantilever::{CantileverError, CantileverMode, CantileverModes, FreeMode};
pub use equilibrium::{EquilibriumError, NEARLY_EQUAL, RelativeEquilibrium, SpinMagnitude};
pub use error::ModesError;
pub use forced::{
    LinearAccuracy, LinearError, LinearInput, LinearModel, LinearOutput, LinearState, SteadyError,
    SteadyModes, SteadyState, SteadyStateGuess, TruncatedLinearModel, acts,
};
pub use frozen_spins::{FrozenSpin, frozen_spins};
pub use mode::{SpinMode, SpinModes};
pub use onset::{WhirlOnset, whirl_onset};
pub use range::{ModeRange, SlowModes};
pub use stated::{Entries, SpinMatrices};

pub use crate::math::state_space::{
    StateSpace, Truncation, TruncationError, TruncationMethod, TruncationRequest,
};
