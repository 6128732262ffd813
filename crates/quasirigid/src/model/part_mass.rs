use std::ops::Range;

use crate::math::sparse::SparseRows;

/// Mass matrix of one part of a structure, whose coordinates move all of its parts. (M5)
#[derive(Clone, Debug, PartialEq)]
pub struct PartMass {
    /// Name of the part.
    pub name: String,
    /// Its mass over the coordinates of the body.
    pub mass: SparseRows<f64>,
}

impl PartMass {
    /// The same in a body that keeps these coordinates and locks the others.
    pub(super) fn locked(&self, kept: Range<usize>) -> Self {
        Self { name: self.name.clone(), mass: self.mass.block(kept) }
    }
}
