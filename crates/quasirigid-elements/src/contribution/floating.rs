use crate::model::Rheology;
use crate::structure::Structure;
use crate::{End, Problem};

/// Body without a carrier, to whose structure elements add finite elements.
pub(crate) trait Floating {
    /// Node at which an element acts.
    ///
    /// # Errors
    /// [`Problem`] for an end that a body without a carrier does not have.
    fn node_at(&self, end: End) -> Result<usize, Problem>;

    /// Name of a node, for messages.
    fn node_name(&self, node: usize) -> String;

    /// Number of the material with this rheology and without damping of its own.
    fn material(&mut self, rheology: &Rheology) -> usize;

    /// The structure.
    fn structure(&mut self) -> &mut Structure;
}
