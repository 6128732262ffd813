//! What a body *is*.

mod equations;
mod flexible;
pub mod force;
mod inertia;
mod invariants;
mod kinetics;
mod principal;
mod reduced;
mod support;

pub use equations::Motion;
pub use flexible::{Coordinate, FlexibleBody, FlexibleError, Marker, Parts};
pub use inertia::{Inertia, InertiaError};
pub use invariants::{Invariants, Pair};
pub use kinetics::{Kinetics, Velocities};
pub use principal::{Polhode, Principal};
pub use reduced::ReducedBody;
pub use support::Support;
