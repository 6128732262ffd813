//! Material point on straight paths: free, on a line or in a plane of the carrier.
//! The constraint leaves unit vectors as its shapes, so its coordinates are displacements along them and need no equation of constraint.

use nalgebra::{Matrix3, Vector3};

use crate::Assembly;
use crate::contribution::MovingBody;
use crate::contribution::{Field as Shape, Piece};
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::model::Coordinate;
use crate::number;
use crate::visual::{Outline, Vertex};

/// Material point with its equilibrium position and the directions that ideal constraints leave free (paper, §1).
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Unique name.
    pub name: String,
    /// Mass (kg).
    pub mass: f64,
    /// Equilibrium position (m), in the file's frame.
    pub position: [f64; 3],
    /// Directions in which the point can be displaced from it.
    pub motion: PointMotion,
}

/// Directions in which a point can move relative to the carrier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointMotion {
    /// Every direction: three coordinates.
    Free,
    /// Along a line with this direction (any length but zero): one coordinate.
    Line([f64; 3]),
    /// In a plane with this normal (any length but zero): two coordinates.
    Plane([f64; 3]),
}

/// Share of a displacement across the free directions up to which it is along them.
const ALONG: f64 = 1e-6;

impl Point {
    /// Coordinates of a displacement of the point (m, file's axes), or of its rate.
    ///
    /// # Errors
    /// [`Problem::Barred`] if the constraints bar it, and errors of the free directions themselves.
    pub fn coordinates_of(&self, displacement: [f64; 3]) -> Result<Vec<f64>, Problem> {
        number::finite(&displacement)?;
        let displacement = Vector3::from(displacement);
        let directions = self.directions()?;
        let coordinates: Vec<f64> = directions.iter().map(|(e, _)| e.dot(&displacement)).collect();
        let left: Vector3<f64> = directions.iter().zip(&coordinates).map(|((e, _), q)| *q * e).sum();
        if (displacement - left).amax() <= ALONG * displacement.amax() {
            Ok(coordinates)
        } else {
            Err(Problem::Barred { left: left.into() })
        }
    }

    /// Unit vectors along which the point moves, with the name of each.
    pub(crate) fn directions(&self) -> Result<Vec<(Vector3<f64>, &'static str)>, Problem> {
        Ok(match self.motion {
            PointMotion::Free => vec![(Vector3::x(), "x"), (Vector3::y(), "y"), (Vector3::z(), "z")],
            PointMotion::Line(direction) => vec![(number::unit(direction)?, "along its line")],
            PointMotion::Plane(normal) => {
                let normal = number::unit(normal)?;
                let first = least_axis(normal).cross(&normal).normalize();
                vec![(first, "in its plane, first"), (normal.cross(&first), "in its plane, second")]
            }
        })
    }

    fn moved(&self, place: ElementId) -> Result<MovingBody, ElementError> {
        number::mass(self.mass).map_err(at(place, Field::MASS))?;
        number::finite(&self.position).map_err(at(place, Field::POSITION))?;
        let directions = self.directions().map_err(at(place, Field::MOTION))?;
        let still = vec![Shape::constant(Vector3::zeros()); directions.len()];
        Ok(MovingBody {
            piece: Piece::point(self.mass),
            base: self.position.into(),
            pose: Matrix3::identity(),
            shapes: directions.iter().map(|(direction, _)| Shape::constant(*direction)).collect(),
            curvature: vec![still; directions.len()],
            axes: Vec::new(),
            oriented: false,
            coordinates: directions
                .iter()
                .map(|(_, axis)| Coordinate { name: format!("\"{}\" {axis}", self.name), unit: "m" })
                .collect(),
            marker: (self.name.clone(), Vector3::zeros()),
            places: Vec::new(),
            law: None,
        })
    }
}

impl Element for Point {
    fn outline(&self, _: ElementId, _: &Assembly) -> Option<Outline> {
        Some(Outline { vertices: vec![Vertex::Own(self.position)], ..Outline::default() })
    }

    fn moving_body(&self, id: ElementId) -> Result<Option<MovingBody>, ElementError> {
        self.moved(id).map(Some)
    }
}

/// The axis of the frame that is farthest from a direction.
fn least_axis(direction: Vector3<f64>) -> Vector3<f64> {
    let mut axis = Vector3::zeros();
    axis[direction.iamin()] = 1.0;
    axis
}
