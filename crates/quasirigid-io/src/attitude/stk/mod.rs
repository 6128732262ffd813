//! Attitude files of STK (`.a`). A quaternion turns the coordinate axes into those of the body, and angular velocities are in body axes, in
//! degrees per second.

mod read;
mod write;

pub use read::read;
pub use write::write;
