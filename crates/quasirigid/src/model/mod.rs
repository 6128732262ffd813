//! What a body *is*.

mod advection;
mod curved;
mod dissipator;
mod equations;
mod flexible;
pub mod force;
mod inertia;
mod invariants;
mod kinetics;
pub(crate) mod liquid;
mod part_mass;
mod paths;
mod principal;
mod reduced;
mod rheology;
mod spinning;
mod support;
mod watched;
mod wheels;

pub use advection::Advection;
pub use dissipator::Dissipator;
pub use equations::Motion;
pub use flexible::{Coordinate, FlexibleBody, FlexibleError, Lossy, Marker, Parts};
pub use inertia::{Inertia, InertiaError};
pub use invariants::{Invariants, Pair};
pub use kinetics::{Kinetics, Velocities};
pub use liquid::{LiquidFlow, LiquidMemory};
pub use part_mass::PartMass;
pub use paths::CurvedPaths;
pub use principal::{Mode, Polhode, Principal};
pub use reduced::ReducedBody;
pub use rheology::{Measured, Rheology, RheologyError};
pub use spinning::{BalancedSpin, SpinCoefficients};
pub use support::Support;
pub use watched::{Displaced, HINGE_RANGE, Hinge, RANGE, Reach, Watched};
pub use wheels::{DrivenWheel, Wheels};
