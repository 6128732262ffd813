//! Attitude ephemeris messages of CCSDS as keywords and values: CCSDS 504.0-B-1 (version 1.0) and 504.0-B-2 (version 2.0).
//! A quaternion of a message turns the axes of its origin frame into those of its destination frame, scalar last; rates are in degrees per
//! second.

mod read;
mod segment;
mod write;

pub use read::read;
pub use write::write;

/// Version of the messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    One,
    Two,
}
