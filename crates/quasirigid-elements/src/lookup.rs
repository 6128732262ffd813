//! Elements of an assembly found by what refers to them.

use nalgebra::Vector3;

use crate::contribution::Attachment;
use crate::element::{AttachmentPoint, Role};
use crate::error::{ElementId, Problem};
use crate::{Assembly, End, NodeRef, PlaceRef};

impl Assembly {
    /// Attachment of an end while nothing moves.
    ///
    /// # Errors
    /// [`Problem`] for an end that the body does not have.
    pub(crate) fn at_rest(&self, end: End) -> Result<Attachment, Problem> {
        Ok(match end {
            End::Carrier if self.carrier.is_none() => return Err(Problem::NoCarrier),
            End::Carrier => Attachment::at(Vector3::zeros(), true),
            End::Point(index) => {
                let point = self.points.get(index).ok_or(Problem::NoSuchPoint { index })?;
                Attachment { name: point.name.clone(), ..Attachment::at(point.position.into(), false) }
            }
            End::Node(node) => {
                self.has(node)?;
                let part = &self.parts[node.part];
                let name = format!("{:?} {}", part.name, part.node_name(node.node));
                let node = part.nodes()[node.node];
                Attachment { name, ..Attachment::at(node.place, node.rotations) }
            }
            End::Hinged(place) => Attachment::at(self.has_place(place)?.into(), true),
        })
    }

    /// Accepts a node that is there.
    pub(crate) fn has(&self, node: NodeRef) -> Result<(), Problem> {
        let part = self.parts.get(node.part).ok_or(Problem::NoSuchPart { index: node.part })?;
        let count = part.count();
        if node.node < count { Ok(()) } else { Err(Problem::NoSuchNode { index: node.node, count }) }
    }

    /// Equilibrium position of a place on an appendage (m), in the file's frame.
    pub(crate) fn has_place(&self, PlaceRef { hinged, place }: PlaceRef) -> Result<[f64; 3], Problem> {
        let hinged = self.hinged.get(hinged).ok_or(Problem::NoSuchPart { index: hinged })?;
        let count = hinged.places.len();
        let (_, position) = hinged.places.get(place).ok_or(Problem::NoSuchNode { index: place, count })?;
        Ok(*position)
    }

    /// Places at which elements act on others.
    pub(crate) fn attachment_points(&self) -> impl Iterator<Item = (ElementId, Role, AttachmentPoint)> + '_ {
        self.each().flat_map(|(id, element)| {
            let role = id.kind.role();
            element.attachment_points().into_iter().map(move |attachment_point| (id, role, attachment_point))
        })
    }
}
