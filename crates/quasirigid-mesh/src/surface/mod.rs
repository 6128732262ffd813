//! Closed surfaces of triangles, and exact integrals over the bodies inside them.

mod closed;
mod crossing;
mod error;
mod facets;
mod geometry;
mod holes;
mod moments;
mod parts;
mod proximity;
mod repair;
mod shells;
mod sight;
#[cfg(test)]
pub(crate) mod testing;
mod topology;
mod tree;
#[cfg(feature = "serde")]
mod written;

pub use closed::ClosedSurface;
pub use error::SurfaceError;
pub use facets::{Facet, Facets};
pub use holes::Hole;
pub use moments::Moments;
pub(crate) use proximity::Proximity;
pub use proximity::{NearestTriangles, nearest_weights};
pub use repair::{LARGEST_SHARE, Repairs, Unclosed, Unrepaired, closing, repaired};
pub use sight::Sight;
