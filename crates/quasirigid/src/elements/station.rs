use nalgebra::Vector3;

use super::error::{ElementError, ElementId, Field, Problem, at};
use super::{Assembly, End, coefficient};
use crate::model::Marker;

/// Where an external force acts on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// The part it acts on.
    pub on: End,
    /// The place on the carrier (m), in the file's frame; none on a point or node, where the force acts at it.
    pub at: Option<[f64; 3]>,
}

impl Station {
    /// Accepts the station of a force on a body.
    pub(super) fn check(&self, place: ElementId, body: &Assembly) -> Result<(), ElementError> {
        match (self.on, self.at) {
            (End::Carrier, Some(position)) => coefficient::finite(&position).map_err(at(place, Field::At)),
            (End::Carrier, None) => Err(at(place, Field::At)(Problem::NoStation)),
            (End::Point(index), _) if index >= body.points.len() => {
                Err(at(place, Field::On)(Problem::NoSuchPoint { index }))
            }
            (End::Node(node), None) => body.has(node).map_err(at(place, Field::On)),
            (End::Hinged(on), None) => body.has_place(on).map(drop).map_err(at(place, Field::On)),
            (End::Point(_) | End::Node(_) | End::Hinged(_), Some(_)) => {
                Err(at(place, Field::At)(Problem::StationOnPoint))
            }
            (End::Point(_), None) => Ok(()),
        }
    }

    /// The place on the body, from the pole; `moving` gives those that are not on the carrier.
    pub(super) fn marker(
        &self,
        name: &str,
        pole: Vector3<f64>,
        moving: &impl Fn(End) -> Option<Marker>,
    ) -> Marker {
        let on_carrier = || Marker {
            name: name.to_owned(),
            position: (Vector3::from(self.at.unwrap_or_default()) - pole).into(),
            shapes: Vec::new(),
            curvature: Vec::new(),
        };
        moving(self.on).unwrap_or_else(on_carrier)
    }
}
