//! A body as the user describes it, and the flexible body made of it.

mod carried;
mod floating;
mod held;
mod homogeneous;
mod mover;
mod names;
mod net;
mod rheologies;

use nalgebra::Vector3;

pub(super) use floating::Exact;
pub(super) use mover::Mover;

use super::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use super::part::{Connection, NodeRef, Part};
use super::{
    Carrier, Cavity, Condensation, Ellipsoid, End, Hinged, PlaceRef, Point, Resolution, Rotor, SlowLiquid,
    Spring, Station, Surface, Wheel, coefficient, force,
};
use crate::model::force::Force;
use crate::model::{FlexibleBody, Marker, Support};
use net::Net;

/// A body as the user describes it: a carrier with points, springs, hinged appendages and parts of finite elements on it,
/// or a body without a carrier that is elastic throughout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembly {
    /// The rigid body that carries everything else; none of a body that is elastic throughout.
    pub carrier: Option<Carrier>,
    /// Ellipsoids, each of them a whole body.
    pub ellipsoids: Vec<Ellipsoid>,
    /// Solids inside closed surfaces, each of them a whole body.
    pub surfaces: Vec<Surface>,
    /// Parts of finite elements.
    pub parts: Vec<Part>,
    /// Joints between them, and between them and the carrier.
    pub connections: Vec<Connection>,
    /// To what end the parts are given few coordinates.
    pub reduction: Reduction,
    /// Material points.
    pub points: Vec<Point>,
    /// Springs and dashpots.
    pub springs: Vec<Spring>,
    /// Rigid appendages on hinges.
    pub hinged: Vec<Hinged>,
    /// Rotors that friction brakes.
    pub rotors: Vec<Rotor>,
    /// Momentum wheels.
    pub wheels: Vec<Wheel>,
    /// Cavities full of liquid.
    pub cavities: Vec<Cavity>,
    /// How the body is held.
    pub support: Support,
    /// External forces.
    pub forces: Vec<Force<Station>>,
}

/// How many coordinates parts of finite elements are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reduction {
    /// Order to which their slow manifold is kept, 3 or more.
    pub order: usize,
    /// Lowest modes of vibration that are kept beside it.
    pub modes: usize,
}

/// A body with the forces that act on it.
#[derive(Clone, Debug)]
pub struct Built {
    /// The body.
    pub body: FlexibleBody,
    /// External forces with the places they act at, from its pole.
    pub forces: Vec<Force<Marker>>,
    /// How its parts of finite elements got few coordinates; none if it has no such parts.
    pub condensation: Option<Condensation>,
    /// Rates of cyclic coordinates at the start (rad/s) where they are given, each with its coordinate.
    pub speeds: Vec<(usize, f64)>,
    /// What each of its liquids does to a slow rotation.
    pub liquids: Vec<SlowLiquid>,
    /// How a solid inside a surface is approximated; none of other bodies.
    pub resolution: Option<Resolution>,
}

/// An element that is a whole body, elastic throughout.
enum Alone<'a> {
    Ellipsoid(&'a Ellipsoid),
    Surface(&'a Surface),
}

impl Default for Reduction {
    fn default() -> Self {
        Self { order: 3, modes: 0 }
    }
}

impl Assembly {
    /// Everything wrong with the elements, one by one; what only the whole body can show is left to [`Self::build`].
    #[must_use]
    pub fn check(&self) -> Vec<ElementError> {
        let carrier = self.carrier.as_ref().and_then(|carrier| carrier.piece().err());
        let ellipsoids =
            self.ellipsoids.iter().enumerate().filter_map(|(i, ellipsoid)| ellipsoid.check(i).err());
        let surfaces = self.surfaces.iter().enumerate().filter_map(|(i, surface)| surface.check(i).err());
        let points = self.points.iter().enumerate().filter_map(|(i, point)| point.mover(i).err());
        let hinged = self.hinged.iter().enumerate().filter_map(|(i, hinged)| hinged.mover(i).err());
        let hinges = self.hinged.iter().enumerate().filter_map(|(i, hinged)| hinged.block(i, 0).err());
        let springs = self.springs.iter().enumerate().filter_map(|(i, spring)| spring.check(i, self).err());
        let rotors = self.rotors.iter().enumerate().filter_map(|(i, rotor)| rotor.inner(i).err());
        let wheels = self.wheels.iter().enumerate().filter_map(|(i, wheel)| wheel.check(i).err());
        let cavities = self.cavities.iter().enumerate().filter_map(|(i, cavity)| cavity.check(i).err());
        let parts = self.parts_and_connections().err();
        let support = self.held_point().err();
        let forces = self.forces.iter().enumerate();
        let forces = forces.filter_map(|(i, force)| force::check(i, force, self).err());
        carrier
            .into_iter()
            .chain(ellipsoids)
            .chain(surfaces)
            .chain(self.alone().err())
            .chain(points)
            .chain(hinged)
            .chain(hinges)
            .chain(springs)
            .chain(rotors)
            .chain(wheels)
            .chain(cavities)
            .chain(self.inside_nothing().err())
            .chain(parts)
            .chain(support)
            .chain(forces)
            .chain(self.same_names())
            .collect()
    }

    /// The flexible body.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn body(&self) -> Result<FlexibleBody, ElementError> {
        Ok(self.under(&[], false)?.body)
    }

    /// External forces with the places they act at, as seen from the pole of [`Self::body`].
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn forces(&self) -> Result<Vec<Force<Marker>>, ElementError> {
        Ok(self.build()?.forces)
    }

    /// The flexible body and the forces on it, in one go.
    ///
    /// # Errors
    /// [`ElementError`] for the first element that no body can have, for a force that cannot act, and for a mechanism.
    pub fn build(&self) -> Result<Built, ElementError> {
        self.under(&self.forces, true)
    }

    /// The body under some of its forces; `told` says whether errors of a given approximation are wanted.
    fn under(&self, forces: &[Force<Station>], told: bool) -> Result<Built, ElementError> {
        if let Some(error) = self.same_names().into_iter().next() {
            return Err(error);
        }
        self.inside_nothing()?;
        let (body, condensation, resolution) = match self.alone()? {
            Some(Alone::Ellipsoid(ellipsoid)) => (ellipsoid.body(0)?, None, None),
            Some(Alone::Surface(surface)) => {
                let found = surface.built(0, self.reduction, told)?;
                (found.body, found.condensation, Some(found.resolution))
            }
            None if self.carrier.is_some() => return self.carried(forces),
            None => return self.floating(forces, None),
        };
        let pole = body.pole().into();
        Ok(Built {
            forces: self.placed_forces(forces, pole, |_| None)?,
            body,
            condensation,
            speeds: Vec::new(),
            liquids: Vec::new(),
            resolution,
        })
    }

    /// Whether there is such a node.
    pub(super) fn has(&self, node: NodeRef) -> Result<(), Problem> {
        let part = self.parts.get(node.part).ok_or(Problem::NoSuchPart { index: node.part })?;
        let count = part.count();
        if node.node < count { Ok(()) } else { Err(Problem::NoSuchNode { index: node.node, count }) }
    }

    /// Where a place on an appendage is at equilibrium (m), in the file's frame.
    pub(super) fn has_place(&self, PlaceRef { hinged, place }: PlaceRef) -> Result<[f64; 3], Problem> {
        let hinged = self.hinged.get(hinged).ok_or(Problem::NoSuchPart { index: hinged })?;
        let count = hinged.places.len();
        let (_, position) = hinged.places.get(place).ok_or(Problem::NoSuchNode { index: place, count })?;
        Ok(*position)
    }

    /// Ends of springs and places of forces, with what names them.
    fn ends(&self) -> impl Iterator<Item = (ElementId, Field, End)> + '_ {
        let springs = self.springs.iter().enumerate().flat_map(|(i, spring)| {
            [
                (ElementKind::Spring.at(i), Field::From, spring.from),
                (ElementKind::Spring.at(i), Field::To, spring.to),
            ]
        });
        let forces = self.forces.iter().enumerate();
        let forces = forces
            .filter_map(|(i, force)| Some((ElementKind::Force.at(i), Field::On, force.law.place()?.on)));
        springs.chain(forces)
    }

    /// The forces, with the markers of the places they act at.
    fn placed_forces(
        &self,
        forces: &[Force<Station>],
        pole: Vector3<f64>,
        marker: impl Fn(End) -> Option<Marker>,
    ) -> Result<Vec<Force<Marker>>, ElementError> {
        let placed = |(i, force): (usize, &Force<Station>)| {
            force::check(i, force, self)?;
            if self.carrier.is_none() && force.law.place().is_some_and(|station| station.on == End::Carrier) {
                return Err(at(ElementKind::Force.at(i), Field::On)(Problem::NoCarrier));
            }
            force.try_map(|station| Ok(station.marker(&force.name, pole, &marker)))
        };
        forces.iter().enumerate().map(placed).collect()
    }

    fn parts_and_connections(&self) -> Result<(), ElementError> {
        if self.parts.is_empty() && self.connections.is_empty() {
            Ok(())
        } else {
            Net::of_parts(self).map(drop)
        }
    }

    /// The element that is the whole body, if there is one; nothing may stand beside it.
    fn alone(&self) -> Result<Option<Alone<'_>>, ElementError> {
        let ellipsoids = self.ellipsoids.iter().map(Alone::Ellipsoid);
        let Some(alone) = ellipsoids.chain(self.surfaces.iter().map(Alone::Surface)).next() else {
            return Ok(None);
        };
        let beside = [
            (self.carrier.is_some(), ElementId::CARRIER),
            (self.ellipsoids.len() > 1, ElementKind::Ellipsoid.at(1)),
            (!self.ellipsoids.is_empty() && !self.surfaces.is_empty(), ElementKind::Surface.at(0)),
            (self.surfaces.len() > 1, ElementKind::Surface.at(1)),
            (!self.parts.is_empty(), ElementKind::Part.at(0)),
            (!self.points.is_empty(), ElementKind::Point.at(0)),
            (!self.springs.is_empty(), ElementKind::Spring.at(0)),
            (!self.hinged.is_empty(), ElementKind::Hinged.at(0)),
        ];
        if let Some((_, place)) = beside.iter().find(|(there, _)| *there) {
            return Err(at(*place, Field::Name)(Problem::BesideWhole));
        }
        self.free()?;
        Ok(Some(alone))
    }

    /// What turns inside needs a carrier.
    fn inside_nothing(&self) -> Result<(), ElementError> {
        let rotor = (!self.rotors.is_empty()).then_some((ElementKind::Rotor.at(0), Field::Axis));
        let wheel = (!self.wheels.is_empty()).then_some((ElementKind::Wheel.at(0), Field::Axis));
        let cavity = (!self.cavities.is_empty()).then_some((ElementKind::Cavity.at(0), Field::Shape));
        match rotor.or(wheel).or(cavity) {
            Some((place, field)) if self.carrier.is_none() => Err(at(place, field)(Problem::InsideNothing)),
            _ => Ok(()),
        }
    }

    /// A body without a carrier has nothing that a support could hold.
    fn free(&self) -> Result<(), ElementError> {
        if self.support == Support::Free {
            return Ok(());
        }
        Err(at(ElementId::SUPPORT, Field::FixedPoint)(Problem::HeldWhole))
    }

    /// The point that is fixed or driven; none of a free body.
    fn held_point(&self) -> Result<Option<Vector3<f64>>, ElementError> {
        let finite = |field: Field, values: &[f64; 3]| {
            coefficient::finite(values).map_err(at(ElementId::SUPPORT, field))
        };
        let point = match &self.support {
            Support::Free => return Ok(None),
            Support::FixedPoint { point } => point,
            Support::Prescribed { point, velocity, position, .. } => {
                finite(Field::Velocity, velocity)?;
                finite(Field::Position, position)?;
                point
            }
        };
        finite(Field::FixedPoint, point)?;
        Ok(Some((*point).into()))
    }

    fn same_names(&self) -> Vec<ElementError> {
        let points = self.points.iter().enumerate().map(|(i, point)| (ElementKind::Point.at(i), &point.name));
        let hinged =
            self.hinged.iter().enumerate().map(|(i, hinged)| (ElementKind::Hinged.at(i), &hinged.name));
        let parts = self.parts.iter().enumerate().map(|(i, part)| (ElementKind::Part.at(i), &part.name));
        let rotors = self.rotors.iter().enumerate().map(|(i, rotor)| (ElementKind::Rotor.at(i), &rotor.name));
        let wheels = self.wheels.iter().enumerate().map(|(i, wheel)| (ElementKind::Wheel.at(i), &wheel.name));
        let cavities =
            self.cavities.iter().enumerate().map(|(i, cavity)| (ElementKind::Cavity.at(i), &cavity.name));
        let mut seen = std::collections::HashSet::new();
        let all = points.chain(hinged).chain(parts).chain(rotors).chain(wheels).chain(cavities);
        let repeated = all.filter(|(_, name)| !seen.insert(name.as_str()));
        repeated
            .map(|(place, name)| at(place, Field::Name)(Problem::DuplicateName { name: name.clone() }))
            .collect()
    }
}
