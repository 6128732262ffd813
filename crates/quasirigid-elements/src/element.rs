//! Element of a body: the contributions of each kind to an assembly. A new kind is a file with this trait and a line in the list of
//! kinds in [`elements`](super).

use super::contribution::{
    Attachment, Attachments, BuildOptions, Floating, Internal, ModalBody, MovingBody, WholeBody,
};
use super::error::{ElementError, ElementId, Field, Problem, at};
use super::material::Material;
use super::visual::Outline;
use super::{Assembly, End, Incomplete, PartReduction};
use crate::model::{Friction, Rheology};
use crate::structure::Block;

/// Element that may have a name.
pub(crate) trait Named {
    /// Name; empty without one.
    fn name(&self) -> &str {
        ""
    }
}

/// Element of a body; each kind implements the methods that concern it.
pub(crate) trait Element: Named {
    /// More specific words for the element than those of its kind.
    fn words(&self) -> Option<&'static str> {
        None
    }

    /// Errors of the element's own values, and of its references to others: by default those of its mass and of its motion. Parts and
    /// connections constrain each other, and are checked together.
    fn check(&self, id: ElementId, _body: &Assembly) -> Vec<ElementError> {
        self.moving_body(id).err().into_iter().chain(self.inner(id, 0).err()).collect()
    }

    /// Material of a body that consists of this element alone.
    fn homogeneous(&self) -> Option<&Material> {
        None
    }

    /// Whole body made of this element.
    fn whole(
        &self,
        _id: ElementId,
        _reduction: PartReduction,
        _asked: BuildOptions,
    ) -> Result<Option<WholeBody>, ElementError> {
        Ok(None)
    }

    /// Terms that the model of the element leaves out of the equations.
    fn incomplete(&self) -> Vec<Incomplete> {
        Vec::new()
    }

    /// Rheologies of the element's materials, in the order in which the model file gives them.
    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        Vec::new()
    }

    /// Attachment points: places of other elements at which the element acts.
    fn attachment_points(&self) -> Vec<AttachmentPoint> {
        Vec::new()
    }

    /// What a viewer draws of the element; none of one that is not seen.
    fn outline(&self, _id: ElementId, _body: &Assembly) -> Option<Outline> {
        None
    }

    /// Rigid piece of mass with coordinates of its own.
    fn moving_body(&self, _id: ElementId) -> Result<Option<MovingBody>, ElementError> {
        Ok(None)
    }

    /// Piece of mass on the carrier with coordinates but no shapes.
    fn modal_body(&self, _id: ElementId) -> Result<Option<ModalBody>, ElementError> {
        Ok(None)
    }

    /// Internal motion in the carrier; `order` is that to which the slow manifold is wanted.
    fn inner(&self, _id: ElementId, _order: usize) -> Result<Option<Internal>, ElementError> {
        Ok(None)
    }

    /// Stiffness and damping over the coordinates of the body. (I9)
    fn block(&self, _site: &ElementSite<'_>) -> Result<Option<Block>, ElementError> {
        Ok(None)
    }

    /// Friction of a coordinate beyond that of the block. (U12)
    fn friction(&self, _site: &ElementSite<'_>) -> Result<Option<Friction>, ElementError> {
        Ok(None)
    }

    /// Action of the element's load at rest. (I10)
    fn preload(&self, _site: &ElementSite<'_>) -> Result<Option<Preload>, ElementError> {
        Ok(None)
    }

    /// Adds the finite elements of the element to the structure of a body without a carrier.
    fn afloat(&self, _id: ElementId, _body: &mut dyn Floating) -> Result<(), ElementError> {
        Ok(())
    }
}

/// Place of an element among the others of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A whole body; no other element but forces may stand beside it.
    Whole,
    /// Mass on the carrier, or afloat.
    Mass,
    /// Mass on the carrier alone; an error without one is about this key.
    OnCarrier(Field),
    /// Internal rotor, wheel or liquid of the carrier; an error without one is about this key.
    Inside(Field),
    /// Force between other elements.
    Link,
    /// External force.
    External,
}

/// Place at which an element acts on another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AttachmentPoint {
    /// Key of the model file that names the place.
    pub field: Field,
    /// The place.
    pub end: End,
    /// Whether a moment acts there beside a force.
    pub moment: bool,
}

/// Element on a body with a carrier: its identity, its coordinates and the places of the others.
pub(super) struct ElementSite<'a> {
    pub id: ElementId,
    /// Name of the element as a dissipator.
    pub name: &'a str,
    /// First coordinate of the element.
    pub start: usize,
    /// Places of other elements.
    pub attachments: &'a Attachments,
}

/// Load of an element at rest.
pub(super) struct Preload {
    /// Stiffness that the load gives, across its line and along curved paths.
    pub block: Block,
    /// Generalised force, coordinate by coordinate.
    pub forces: Vec<(usize, f64)>,
}

impl ElementSite<'_> {
    /// Attachments of the ends of a link.
    pub fn ends(&self, from: End, to: End) -> Result<[&Attachment; 2], ElementError> {
        joined(self.id, [from, to], |end| self.attachments.of(end))
    }
}

/// The ends of a link, each found by its place.
///
/// # Errors
/// [`ElementError`] for an end that does not exist, and for two that are the same.
pub(super) fn joined<T>(
    id: ElementId,
    [from, to]: [End; 2],
    find: impl Fn(End) -> Result<T, Problem>,
) -> Result<[T; 2], ElementError> {
    let ends = [find(from).map_err(at(id, Field::FROM))?, find(to).map_err(at(id, Field::TO))?];
    if from == to { Err(at(id, Field::TO)(Problem::SameEnds)) } else { Ok(ends) }
}

impl AttachmentPoint {
    /// Place at which a force acts.
    pub fn force(field: Field, end: End) -> Self {
        Self { field, end, moment: false }
    }
}

impl Role {
    /// Whether the name must be unique: links of one name are one dissipator, and nothing refers to the others by theirs.
    pub fn is_unique(self) -> bool {
        matches!(self, Self::Mass | Self::OnCarrier(_) | Self::Inside(_))
    }

    /// Error of an element on or in a carrier where there is none.
    pub fn needs_carrier(self) -> Option<(Field, Problem)> {
        match self {
            Self::OnCarrier(field) => Some((field, Problem::NoCarrier)),
            Self::Inside(field) => Some((field, Problem::InsideNothing)),
            Self::Whole | Self::Mass | Self::Link | Self::External => None,
        }
    }
}
