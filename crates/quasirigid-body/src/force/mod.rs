//! External forces on a body, for scalars that may be series in time. (F1) to (F14)

mod apply;
mod felt;
mod field;
mod gravity;
mod law;
mod orbit;
mod pose;
mod timing;

#[doc(hidden)]
pub use apply::Felt;
pub use apply::{KinematicState, Loads};
pub use field::MagneticField;
pub use law::{Axes, Force, ForceLaw, Wave};
#[doc(hidden)]
pub use law::{PLACE, TIME, VARIABLES};
pub use orbit::{Orbit, OrbitPoint};
pub use pose::Pose;
pub use timing::{Interpolation, Timetable, TimingProblem, Windows};
