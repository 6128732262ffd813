use nalgebra::Vector3;

use crate::contribution::{Attachment, Attachments};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::model::Marker;
use crate::number;
use crate::{Assembly, End};

/// Point of application of an external force.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApplicationPoint {
    /// Element on which the force acts.
    pub on: End,
    /// Place on the carrier (m), in the file's frame; none on a point or node, where the force acts at its place.
    pub at: Option<[f64; 3]>,
}

impl ApplicationPoint {
    /// Accepts the point of application of a force on a body.
    pub(crate) fn check(&self, place: ElementId, body: &Assembly) -> Result<(), ElementError> {
        match (self.on, self.at) {
            (End::Carrier, Some(position)) => number::finite(&position).map_err(at(place, Field::AT)),
            (End::Carrier, None) => Err(at(place, Field::AT)(Problem::NoApplicationPoint)),
            (End::Point(index), _) if index >= body.points.len() => {
                Err(at(place, Field::ON)(Problem::NoSuchPoint { index }))
            }
            (End::Node(node), None) => body.has(node).map_err(at(place, Field::ON)),
            (End::Hinged(on), None) => body.has_place(on).map(drop).map_err(at(place, Field::ON)),
            (End::Point(_) | End::Node(_) | End::Hinged(_), Some(_)) => {
                Err(at(place, Field::AT)(Problem::ApplicationPointOnPoint))
            }
            (End::Point(_), None) => Ok(()),
        }
    }

    /// The place on the body, from the pole.
    pub(crate) fn marker(&self, name: &str, pole: Vector3<f64>, attachments: &Attachments) -> Marker {
        match attachments.of(self.on) {
            Ok(attachment) if self.on != End::Carrier => attachment.marker(pole),
            _ => {
                let position = Vector3::from(self.at.unwrap_or_default());
                Attachment { name: name.to_owned(), ..Attachment::at(position, true) }.marker(pole)
            }
        }
    }
}
