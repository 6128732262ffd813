//! Closed surfaces of triangles, and exact integrals over what they enclose.

mod closed;
mod error;
mod geometry;
mod moments;
mod shells;
mod topology;

pub use closed::ClosedSurface;
pub use error::SurfaceError;
pub use moments::Moments;
