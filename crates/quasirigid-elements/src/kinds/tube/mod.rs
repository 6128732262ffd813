//! Closed circular tube, partly full: one slug of liquid that slides along the ring by any angle, braked by the wall.
//! The slug is a rigid arc on a hinge at the centre of the ring, without a spring.
//! Equations (U10) to (U14), docs/theory/21-slosh.md.

mod error;
mod outline;
mod slug;

use nalgebra::Vector3;

use crate::Assembly;
use crate::contribution::{Internal, MovingBody};
use crate::element::{Element, ElementSite};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::kinds::tank::{TankContents, TankError};
use crate::model::{Friction, Rheology};
use crate::number;
use crate::structure::Block;
use crate::visual::Outline;

pub use error::TubeError;
pub use slug::Slug;

/// Closed circular tube that is partly full of a liquid: a ring damper. (U10)–(U14)
///
/// The mass of the liquid is added to the carrier's.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// Unique name.
    pub name: String,
    /// Mean radius of the ring (m).
    pub radius: f64,
    /// Inner radius of the tube (m).
    pub tube_radius: f64,
    /// Centre of the ring (m), in the file's frame.
    pub center: [f64; 3],
    /// Axis of the ring, in the file's frame; any length but zero.
    pub axis: [f64; 3],
    /// Direction (file's frame) from the centre to the middle of the liquid at rest, as far as it is across the axis; none for that of the
    /// x axis, or of the y axis where that is nearer to right angles with the axis.
    pub towards: Option<[f64; 3]>,
    /// Amount of liquid.
    pub contents: TankContents,
    /// Density of the liquid (kg/m³).
    pub density: f64,
    /// Kinematic viscosity of the liquid (m²/s).
    pub viscosity: f64,
    /// Surface tension (N/m); none for that of water, 0.07 N/m, where it is judged whether the liquid fills the tube.
    pub surface_tension: Option<f64>,
    /// Whether the liquid is held where it lies at rest, as a rigid part of the carrier.
    pub held: bool,
}

/// Key of the radius of the tube.
const TUBE_RADIUS: Field = Field::new("tube_radius");
/// Key of the fill.
const FILL: Field = Field::new("fill");
/// Key of the mass of the liquid.
const LIQUID_MASS: Field = Field::new("liquid_mass");
/// Key of the direction of the liquid.
const TOWARDS: Field = Field::new("towards");
/// Key of the surface tension.
const SURFACE_TENSION: Field = Field::new("surface_tension");
/// Greatest radius of the tube over that of the ring.
const MOST_CURVED: f64 = 0.2;
/// Sine of the angle between the axis and the direction of the liquid below which that has none across the axis.
const ALONG: f64 = 1e-6;

impl Tube {
    /// The slug, after a check of the values.
    pub(crate) fn slug(&self, id: ElementId) -> Result<Slug, ElementError> {
        number::positive(self.radius).map_err(at(id, Field::RADIUS))?;
        number::positive(self.tube_radius).map_err(at(id, TUBE_RADIUS))?;
        number::finite(&self.center).map_err(at(id, Field::CENTER))?;
        number::positive(self.density).map_err(at(id, Field::DENSITY))?;
        number::positive(self.viscosity).map_err(at(id, Field::VISCOSITY))?;
        self.surface_tension.map_or(Ok(()), number::positive).map_err(at(id, SURFACE_TENSION))?;
        let curvature = self.tube_radius / self.radius;
        if curvature > MOST_CURVED {
            let error = TubeError::Thick { curvature, most: MOST_CURVED };
            return Err(at(id, TUBE_RADIUS)(Problem::Tube(error)));
        }
        let axis = number::unit(self.axis).map_err(at(id, Field::AXIS))?;
        let towards = self.side(axis).map_err(at(id, TOWARDS))?;
        let slug = Slug::of(self, self.fill(id)?, [axis.into(), towards.into()]);
        let bad = [slug.liquid_mass, slug.friction.unit, slug.friction.reynolds];
        match bad.into_iter().find(|value| !value.is_normal()) {
            Some(value) => Err(at(id, Field::RADIUS)(Problem::NotFinite { value })),
            None => Ok(slug),
        }
    }

    /// Unit vector from the centre to the middle of the liquid.
    fn side(&self, axis: Vector3<f64>) -> Result<Vector3<f64>, Problem> {
        let nearer =
            if axis.x.abs() <= axis.y.abs().max(axis.z.abs()) { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let given = number::unit(self.towards.unwrap_or(nearer))?;
        let across = given - axis * axis.dot(&given);
        if across.norm() < ALONG { Err(Problem::Tube(TubeError::AlongAxis)) } else { Ok(across.normalize()) }
    }

    /// Share of the tube that is full.
    fn fill(&self, id: ElementId) -> Result<f64, ElementError> {
        let most = self.density * slug::capacity(self.radius, self.tube_radius);
        let refused = |field: Field, error: TankError| Err(at(id, field)(error.into()));
        match self.contents {
            TankContents::Fill(fill) if fill > 0.0 && fill < 1.0 => Ok(fill),
            TankContents::Fill(fill) => refused(FILL, TankError::Fill { fill }),
            TankContents::Mass(mass) => {
                number::mass(mass).map_err(at(id, LIQUID_MASS))?;
                if mass >= most {
                    refused(LIQUID_MASS, TankError::Overfull { mass, most })
                } else {
                    Ok(mass / most)
                }
            }
        }
    }
}

impl Element for Tube {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        self.slug(id).err().into_iter().collect()
    }

    fn outline(&self, id: ElementId, _: &Assembly) -> Option<Outline> {
        self.drawn(id)
    }

    fn moving_body(&self, id: ElementId) -> Result<Option<MovingBody>, ElementError> {
        if self.held { Ok(None) } else { self.slug(id).map(|slug| Some(slug.moving_body())) }
    }

    fn inner(&self, id: ElementId, _: usize) -> Result<Option<Internal>, ElementError> {
        if !self.held {
            return Ok(None);
        }
        Ok(Some(Internal { rigid: vec![self.slug(id)?.frozen()], ..Internal::default() }))
    }

    /// Laminar friction, which is what small motions meet. (U10)
    fn block(&self, site: &ElementSite<'_>) -> Result<Option<Block>, ElementError> {
        if self.held {
            return Ok(None);
        }
        let law = self.slug(site.id)?.friction;
        Ok(Some(Block {
            name: self.name.clone(),
            columns: vec![site.start],
            stiffness: vec![vec![0.0]],
            damping: vec![vec![law.at_rest()]],
            rheology: Rheology::Elastic,
        }))
    }

    /// What turbulence and the curvature of the tube add. (U12)
    fn friction(&self, site: &ElementSite<'_>) -> Result<Option<Friction>, ElementError> {
        if self.held {
            return Ok(None);
        }
        let law = self.slug(site.id)?.friction;
        Ok(Some(Friction { name: self.name.clone(), coordinate: site.start, law }))
    }
}
