//! Solid elements: tetrahedra, wedges and hexahedra, linear and quadratic.
//!
//! All matrices follow from the slopes of the shape functions, integrated by points. Against locking of thin or nearly incompressible
//! bodies:
//!
//! - the hexahedron of 8 nodes has quadratic displacements of its own, condensed out, so that it bends;
//! - the dilatation of hexahedra of 20 and 27 nodes is linear over the cell;
//! - tetrahedra of 10 and wedges of 15 nodes need nothing: nearly incompressible material costs them one order.
//!
//! Tetrahedra of 4 nodes and wedges of 6 are too stiff in bending, and lock where the material is nearly incompressible. The cells are
//! those that [`Mesh::check`](quasirigid_mesh::Mesh::check) accepts; matrices of others may contain NaN.

mod bending;
mod dilatation;
mod geometric;
mod lumped_masses;
mod mass;
mod slopes;
mod stiffness;

pub(crate) use geometric::geometric;
pub(crate) use lumped_masses::lumped_masses;
pub(crate) use mass::mass;
pub(crate) use stiffness::stiffness;

#[cfg(test)]
mod tests;
