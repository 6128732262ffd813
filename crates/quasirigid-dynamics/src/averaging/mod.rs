//! Millions of revolutions: the torque-free motion in closed form, and what dissipation makes of it on average.

mod budget;
mod drift;
mod eddy_torque;
mod ellipsoids;
mod euler_angles;
mod evolution;
mod flow;
mod harmonic_resonance;
mod harmonics;
mod hill;
mod interpolated;
mod levels;
mod loaded_modes;
mod materials;
mod observed;
mod poinsot;
mod power;
mod published;
mod response;
mod separatrix;
mod slow_torque;
mod source;

pub use drift::{Drift, DriftHistory, DriftLimits, DriftState, DriftStopReason, SeparatrixPassage};
pub use eddy_torque::EddyTorque;
pub use ellipsoids::{
    EllipsoidLoss, EllipsoidPassage, EllipsoidRefusal, Wobble, WobblingEllipsoid, ellipsoid_passages,
};
pub use euler_angles::EulerAngles;
pub use evolution::{Elapsed, Evolution, RotationState};
pub use flow::MaterialFlow;
pub use harmonic_resonance::HarmonicResonance;
pub use harmonics::Harmonic;
pub use hill::{Floquet, HillError, HillResponse, ParametricResonance, PeriodicResponse};
pub use interpolated::InterpolatedPower;
pub use levels::{
    Level, LevelError, LevelEvolution, LevelPassage, LevelRow, LevelStopReason, Separatrix, Until, Way,
};
pub use materials::DrivenMaterial;
pub use observed::{ObservedError, ObservedPeriods};
pub(crate) use poinsot::is_turning_steadily;
pub use poinsot::{FreeRotation, FreeRotationError};
pub use power::{MeanPower, PolynomialPower};
pub use published::{DAMPING_ESTIMATES, DampingEstimate, SmallBody, ball_radius, spin_barrier};
pub use response::Response;
pub use separatrix::constant_beyond;
pub use slow_torque::{SlowTorque, Unaveraged};
pub use source::{EvolutionError, PowerSource, harmonic_power};
