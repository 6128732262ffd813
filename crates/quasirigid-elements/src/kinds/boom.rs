//! Boom that is run out or drawn in: a uniform line of mass of a prescribed length, with a mass at its tip. (T11)

use nalgebra::{Matrix3, Vector3};

use crate::Assembly;
use crate::contribution::MovingBody;
use crate::contribution::{Field as Shape, Piece};
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, at};
use crate::kinds::prescribed::PrescribedMotion;
use crate::model::Coordinate;
use crate::number;
use crate::visual::{Outline, Vertex};

/// Straight boom on the carrier whose length a drive prescribes: its mass is spread evenly along it at all times, as if it stretched. (T11)
///
/// Without a mass of its own it is a rail, on which the mass at the tip runs. It does not bend.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Boom {
    /// Unique name.
    pub name: String,
    /// Place of the root (m), in the file's frame.
    pub position: [f64; 3],
    /// Direction from the root to the tip, any length but zero.
    pub direction: [f64; 3],
    /// Mass spread along the boom (kg), zero or more.
    pub mass: f64,
    /// Mass at the tip (kg), zero or more.
    pub tip_mass: f64,
    /// Length (m).
    pub length: PrescribedMotion,
}

impl Boom {
    fn moved(&self, id: ElementId) -> Result<MovingBody, ElementError> {
        let direction = number::unit(self.direction).map_err(at(id, Field::DIRECTION))?;
        number::finite(&self.position).map_err(at(id, Field::POSITION))?;
        for (mass, field) in [(self.mass, Field::MASS), (self.tip_mass, Field::new("tip_mass"))] {
            if mass != 0.0 {
                number::mass(mass).map_err(at(id, field))?;
            }
        }
        number::mass(self.mass + self.tip_mass).map_err(at(id, Field::MASS))?;
        self.length.check().map_err(at(id, Field::new("length")))?;
        // places in shares of the length
        let piece = Piece {
            mass: self.mass + self.tip_mass,
            first: (0.5 * self.mass + self.tip_mass) * direction,
            second: (self.mass / 3.0 + self.tip_mass) * direction * direction.transpose(),
        };
        let law = self.length.law().cloned();
        let coordinates =
            law.iter().map(|_| Coordinate { name: format!("{:?} length", self.name), unit: "m" });
        let driven = usize::from(law.is_some());
        Ok(MovingBody {
            piece,
            base: self.position.into(),
            pose: self.length.constant().unwrap_or(0.0) * Matrix3::identity(),
            shapes: vec![Shape::linear(Matrix3::identity()); driven],
            curvature: vec![vec![Shape::constant(Vector3::zeros()); driven]; driven],
            axes: Vec::new(),
            oriented: false,
            coordinates: coordinates.collect(),
            marker: (self.name.clone(), direction),
            places: Vec::new(),
            law,
        })
    }
}

impl Element for Boom {
    /// Line from the root to the tip.
    fn outline(&self, _: ElementId, _: &Assembly) -> Option<Outline> {
        let root = Vector3::from(self.position);
        let tip = root + number::unit(self.direction).ok()?;
        let vertices = vec![Vertex::Still(self.position), Vertex::Own(tip.into())];
        Some(Outline { vertices, lines: vec![[0, 1]], ..Outline::default() })
    }

    fn moving_body(&self, id: ElementId) -> Result<Option<MovingBody>, ElementError> {
        self.moved(id).map(Some)
    }
}
