//! Rotor with friction on its bearing: cyclic coordinates for a flywheel about one axis or a ball about three.
//! Its mass and locked inertia belong to the carrier, so the rotor adds only its coordinates, their coupling and the friction.
//! Equation (C9), docs/theory/13-inside.md.

use nalgebra::Vector3;

use crate::Assembly;
use crate::contribution::Internal;
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::model::{Coordinate, Pair};
use crate::number;
use crate::visual::{Outline, disc};

/// A rotor with friction relative to the carrier: a flywheel in its bearings, a ball in a viscous liquid. (C9)
///
/// The mass of the rotor and, locked, its inertia belong to the carrier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// Unique name.
    pub name: String,
    /// Axes of rotation.
    pub kind: RotorKind,
    /// Moment of inertia about the rotor's axis (kg·m²).
    pub inertia: f64,
    /// Friction coefficient `κ` (N·m·s/rad): the torque per relative speed.
    pub friction: f64,
    /// Speed relative to the carrier at the start (rad/s), one value per axis; none for the speed at which friction leaves the rotor on the
    /// slow manifold.
    pub speed: Option<Vec<f64>>,
}

/// Axes about which a rotor spins.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RotorKind {
    /// One axis of the carrier; any length but zero.
    Flywheel {
        /// Direction of the axis.
        axis: [f64; 3],
    },
    /// Any axis: a ball whose inertia is the same about all.
    Sphere,
}

impl Rotor {
    fn turning(&self, place: ElementId) -> Result<Internal, ElementError> {
        number::positive(self.inertia).map_err(at(place, Field::INERTIA))?;
        number::positive(self.friction).map_err(at(place, Field::FRICTION))?;
        let axes = self.axes().map_err(at(place, Field::AXIS))?;
        if let Some(speed) = &self.speed {
            number::finite(speed).map_err(at(place, Field::SPEED))?;
            if speed.len() != axes.len() {
                let problem = Problem::ValuePerAxis { axes: axes.len(), values: speed.len() };
                return Err(at(place, Field::SPEED)(problem));
            }
        }
        let name = |(i, _): (usize, &Vector3<f64>)| match self.kind {
            RotorKind::Flywheel { .. } => format!("\"{}\"", self.name),
            RotorKind::Sphere => format!("\"{}\" about {}", self.name, ["x", "y", "z"][i]),
        };
        let pair = |j: usize, k: usize| Pair {
            A: self.inertia * axes[j].dot(&axes[k]),
            Z: (self.inertia * axes[j].cross(&axes[k])).into(),
            ..Pair::default()
        };
        let count = axes.len();
        Ok(Internal {
            coordinates: axes
                .iter()
                .enumerate()
                .map(|axis| Coordinate { name: name(axis), unit: "rad" })
                .collect(),
            h: axes.iter().map(|axis| (self.inertia * axis).into()).collect(),
            pairs: (0..count)
                .flat_map(|j| (0..count).map(move |k| (j, k)))
                .map(|(j, k)| (j, k, pair(j, k)))
                .collect(),
            friction: vec![(self.name.clone(), (0..count).map(|j| (j, j, self.friction)).collect())],
            speeds: self.speed.iter().flatten().copied().enumerate().collect(),
            ..Internal::default()
        })
    }

    fn axes(&self) -> Result<Vec<Vector3<f64>>, Problem> {
        match self.kind {
            RotorKind::Flywheel { axis } => Ok(vec![number::unit(axis)?]),
            RotorKind::Sphere => Ok(vec![Vector3::x(), Vector3::y(), Vector3::z()]),
        }
    }
}

impl Element for Rotor {
    /// Disc about the axis of a flywheel, at the centre of the carrier: the model gives it no place.
    fn outline(&self, _: ElementId, body: &Assembly) -> Option<Outline> {
        let RotorKind::Flywheel { axis } = self.kind else { return None };
        disc(body.carrier.as_ref()?, axis)
    }

    fn inner(&self, id: ElementId, _: usize) -> Result<Option<Internal>, ElementError> {
        self.turning(id).map(Some)
    }
}
