//! External forces: what acts on a body from outside, in numbers that may be series in time.

mod apply;
mod field;
mod gravity;
mod law;
mod orbit;
mod pose;

pub use apply::{KinematicState, Loads};
pub use field::MagneticField;
pub use law::{Axes, Force, ForceLaw, Wave};
pub use orbit::{Orbit, OrbitPoint};
pub use pose::Pose;
