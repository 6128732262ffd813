//! Reduced equations about a steady spin: the spectral submanifold of the nutation, at any ratio of spin to elastic frequency.
//! Where the reduction about rest expands in the angular velocity, this one expands in the nutation; stiff bodies have both.
//! Equations (W1) to (W12), docs/theory/18-submanifolds.md.

mod backbone;
mod crossed_resonances;
mod error;
mod history;
mod masters;
mod observables;
mod power;
mod propagate;
mod range;
mod spin_manifold;
mod steady;

pub use backbone::{Backbone, BackbonePoint};
pub use crossed_resonances::CrossedResonance;
pub use error::SubmanifoldError;
pub use history::{ManifoldRun, ManifoldStart};
pub use masters::{MasterMode, Masters, OuterMode};
pub use power::ManifoldPower;
pub use propagate::propagate_on_manifold;
pub use range::{AmplitudeRange, Defect, MAX_AMPLITUDE};
pub use spin_manifold::{SpinManifold, SpinManifoldPlan};
pub use steady::SteadySpin;

pub use crate::model::MAX_DEGREE;

pub use crate::math::submanifold::{ExpansionError, NearResonance, Ring, Style, Truncated};
