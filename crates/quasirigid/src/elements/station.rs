use nalgebra::Vector3;

use super::assembly::at;
use super::error::{ElementError, Field, Place, Problem};
use super::{End, coefficient};
use crate::model::Marker;

/// Where an external force acts on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// The part it acts on.
    pub on: End,
    /// The place on the carrier (m), in the file's frame; none on a point, where the force acts at the point itself.
    pub at: Option<[f64; 3]>,
}

impl Station {
    /// Accepts the station of a force on a body with this many points.
    pub(super) fn check(&self, place: Place, points: usize) -> Result<(), ElementError> {
        match (self.on, self.at) {
            (End::Carrier, Some(position)) => coefficient::finite(&position).map_err(at(place, Field::At)),
            (End::Carrier, None) => Err(at(place, Field::At)(Problem::NoStation)),
            (End::Point(index), _) if index >= points => {
                Err(at(place, Field::On)(Problem::NoSuchPoint { index }))
            }
            (End::Point(_), Some(_)) => Err(at(place, Field::At)(Problem::StationOnPoint)),
            (End::Point(_), None) => Ok(()),
        }
    }

    /// The place on the body, from the pole; `points` are the markers of its points.
    pub(super) fn marker(
        &self,
        place: Place,
        name: &str,
        points: &[Marker],
        pole: Vector3<f64>,
    ) -> Result<Marker, ElementError> {
        self.check(place, points.len())?;
        Ok(match self.on {
            End::Point(index) => points[index].clone(),
            End::Carrier => Marker {
                name: name.to_owned(),
                position: (Vector3::from(self.at.unwrap_or_default()) - pole).into(),
                shapes: Vec::new(),
            },
        })
    }
}
