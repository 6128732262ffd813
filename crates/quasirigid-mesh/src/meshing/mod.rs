//! Meshes of curved quadratic tetrahedra, for shapes with a name and for any closed surface.
//!
//! Shapes with a name are divided into cells that a smooth map bends: [`cuboid`], [`ellipsoid`], [`cylinder`],
//! [`annulus`], [`ring`], [`shell`]. They are centred at the origin. Their `resolution` is the number of cells across
//! the narrowest width, and the others are about as long as those are wide; an `exponent` above one makes the cells at
//! the walls thinner than those in the middle, `1 − (1 − x)^exponent` from the middle (0) to a wall (1). Middles of
//! edges lie where the map puts the middle of the straight edge, those on a wall therefore on the wall.
//!
//! The body inside any closed surface of triangles is filled by [`inside`]; [`graded`] makes the cells finer at a neck that [`necks`]
//! finds.

mod cuboid;
mod cylinder;
mod ellipsoid;
mod error;
mod fineness;
mod fit;
mod graded;
mod inside;
mod jacobian;
mod lattice;
mod necks;
mod pattern;
mod quadratic;
mod ring;
mod round;
mod shell;
mod simplices;
mod slivers;
mod stencils;
#[cfg(test)]
mod testing;
mod topology;
mod wall;

pub use cuboid::cuboid;
pub use cylinder::{annulus, cylinder};
pub use ellipsoid::ellipsoid;
pub use error::MeshingError;
pub use graded::{GradedMesh, graded};
pub use inside::inside;
pub use necks::{Neck, necks};
pub use ring::ring;
pub use round::icosahedron;
pub use shell::shell;
