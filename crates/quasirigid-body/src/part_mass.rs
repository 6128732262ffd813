use std::ops::Range;

use crate::math::sparse::SparseRows;

/// Mass matrix of one part of a structure, whose coordinates move all of its parts. (M5)
#[derive(Clone, Debug, PartialEq)]
pub struct PartMass {
    /// Name of the part.
    pub name: String,
    /// Mass matrix of the part over the coordinates of the body.
    pub mass: SparseRows<f64>,
}

impl PartMass {
    /// Part mass in a body with these coordinates kept and the others locked.
    pub(super) fn locked(&self, kept: Range<usize>) -> Self {
        Self { name: self.name.clone(), mass: self.mass.block(kept) }
    }
}
