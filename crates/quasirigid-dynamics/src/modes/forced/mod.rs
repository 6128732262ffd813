//! Bodies under moments and on fixed or driven supports: steady states, and the modes about them. (M6)–(M8)

mod error;
mod frame_rotation;
mod linear;
mod mode;
mod newton;
mod pencil;
mod reduced;
mod slopes;
mod spectrum;
mod state;
mod steadiness;
mod system;
mod timed;
mod whole_body_names;

pub use error::SteadyError;
pub use linear::{
    LinearAccuracy, LinearError, LinearInput, LinearModel, LinearOutput, LinearState, TruncatedLinearModel,
};
pub use mode::SteadyModes;
pub use state::{SteadyState, SteadyStateGuess, acts};
