//! External forces on a body, for scalars that may be series in time. (F1) to (F33)

mod apply;
mod conductor;
mod conic;
mod eddy;
mod ephemeris;
mod felt;
mod field;
mod gravity;
mod igrf;
mod law;
mod mean_field;
mod mean_sunlight;
mod orbit;
mod pose;
mod sunlight;
mod timing;
mod trajectory;

#[doc(hidden)]
pub use apply::Felt;
pub use apply::{KinematicState, Loads};
pub use conductor::Conductor;
pub(crate) use conductor::MAGNETIC_CONSTANT;
pub use conic::Conic;
pub use ephemeris::{Ephemeris, EphemerisProblem};
pub use field::MagneticField;
pub use igrf::EarthField;
pub use law::{Axes, Force, ForceLaw, Wave};
#[doc(hidden)]
pub use law::{PLACE, TIME, VARIABLES};
pub use mean_sunlight::{MeanSunlight, MeanTorque, ThermalSurface};
pub use orbit::{Oblateness, Orbit, OrbitPoint};
pub use pose::Pose;
pub use sunlight::{SOLAR_CONSTANT, SPEED_OF_LIGHT, SunPath, SunlightLoads, light_pressure};
pub use timing::{Interpolation, Timetable, TimingProblem, Windows};
pub use trajectory::Trajectory;
