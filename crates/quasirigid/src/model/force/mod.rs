//! External forces on a body, for scalars that may be series in time. (F1) to (F12)

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
