//! Bulk data of NASTRAN: cards of fields, coordinate systems and grid points, which meshes, matrices and models share.
//! (MSC Nastran Quick Reference Guide, *Bulk Data Entries*)

pub(crate) mod bulk;
pub(crate) mod grid;
pub(crate) mod model;
pub(crate) mod modes;
pub(crate) mod op2;
pub(crate) mod printed;
pub(crate) mod sheet;
pub(crate) mod systems;
pub(crate) mod text;
