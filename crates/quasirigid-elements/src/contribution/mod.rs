//! Contributions of elements to a body: pieces of mass, coordinates, matrices and places, which an element gives and the assembly sums.

mod affine;
mod attachment;
mod exact;
mod floating;
mod internal;
mod modal_body;
mod moving_body;
mod single_element;
mod slow_liquid;
mod system_matrices;

pub(crate) use affine::{Field, Piece};
pub(crate) use attachment::{Attachment, Attachments};
pub(crate) use exact::Exact;
pub(crate) use floating::Floating;
pub(crate) use internal::Internal;
pub(crate) use modal_body::ModalBody;
pub(crate) use moving_body::MovingBody;
pub(crate) use single_element::{SingleElementBody, WholeBody};
pub use slow_liquid::SlowLiquid;
pub(crate) use system_matrices::Matrices;

/// Choice of the coordinates of parts of finite elements.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PartReduction {
    /// Order to which the slow manifold of the parts is exact, 3 or more.
    pub order: usize,
    /// Number of lowest modes of vibration beside these coordinates.
    pub modes: usize,
}

impl Default for PartReduction {
    fn default() -> Self {
        Self { order: 3, modes: 0 }
    }
}

/// What a build makes beside the body.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BuildOptions {
    /// Errors of given approximations.
    pub errors: bool,
    /// Visual geometry.
    pub visuals: bool,
}
