//! A body as the user describes it, and the flexible body made of it.

mod carried;
mod floating;
mod homogeneous;
mod locked;
mod relaxed;
mod rheologies;
mod tanks;

pub use relaxed::{ObservedShape, Relaxed};

use nalgebra::Vector3;

use crate::contribution::BuildOptions;
use crate::contribution::WholeBody;
use crate::contribution::{Attachment, Attachments};
use crate::element::{Element, Role};
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::kinds::part::PartGraph;
use crate::model::control::Controls;
use crate::model::force::Force;
use crate::model::{FlexibleBody, Marker, Support};
use crate::number;
use crate::visual::Visual;
use crate::{
    ApplicationPoint, Assembly, Condensation, End, Resolution, SettledTank, SlowLiquid, Slug, force,
};

/// A body with the forces that act on it.
#[derive(Clone, Debug)]
pub struct Built {
    /// The body.
    pub body: FlexibleBody,
    /// External forces with their points of action, from the pole of the body.
    pub forces: Vec<Force<Marker>>,
    /// Controllers, on places of the body.
    pub controls: Controls,
    /// Condensation of the parts of finite elements; none of a body without such parts.
    pub condensation: Option<Condensation>,
    /// Rates of cyclic coordinates at the start (rad/s) where they are given, each with its coordinate.
    pub speeds: Vec<(usize, f64)>,
    /// Effect of each liquid on a slow rotation.
    pub liquids: Vec<SlowLiquid>,
    /// Tanks with their liquids settled.
    pub tanks: Vec<SettledTank>,
    /// Liquids that slide along partly full rings.
    pub slugs: Vec<Slug>,
    /// Approximation of a solid inside a surface; none of other bodies.
    pub resolution: Option<Resolution>,
    /// Visual geometry of the elements, where it was asked for.
    pub visuals: Vec<Visual>,
}

impl Assembly {
    /// Errors of the elements, one by one; those that only the whole body can show are left to [`Self::build`].
    #[must_use]
    pub fn check(&self) -> Vec<ElementError> {
        let carrier = self.carrier.as_ref().and_then(|carrier| carrier.piece().err());
        let elements = self.each().flat_map(|(id, element)| element.check(id, self));
        let mut errors: Vec<ElementError> = carrier.into_iter().chain(elements).collect();
        errors.extend(self.lawful_field().err());
        errors.extend(self.alone().err());
        errors.extend(self.without_carrier().err());
        errors.extend(self.parts_and_connections().err());
        errors.extend(self.held_point().err());
        errors.extend(self.same_names());
        errors
    }

    /// The flexible body.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn body(&self) -> Result<FlexibleBody, ElementError> {
        Ok(self.under(&[], BuildOptions::default())?.body)
    }

    /// External forces with their points of action, as seen from the pole of [`Self::body`].
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
        self.controlled_body(BuildOptions { errors: true, visuals: false })
    }

    /// As [`build`](Self::build), with the visual geometry of the elements.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn build_with_visuals(&self) -> Result<Built, ElementError> {
        self.controlled_body(BuildOptions { errors: true, visuals: true })
    }

    /// The body with its forces and controllers.
    fn controlled_body(&self, asked: BuildOptions) -> Result<Built, ElementError> {
        self.lawful_field()?;
        let built = self.under(&self.forces, asked)?;
        Ok(Built { controls: self.controls_on(&built.body)?, ..built })
    }

    /// The body under some of its forces.
    fn under(&self, forces: &[Force<ApplicationPoint>], asked: BuildOptions) -> Result<Built, ElementError> {
        if let Some(error) = self.same_names().into_iter().next() {
            return Err(error);
        }
        self.without_carrier()?;
        self.without_spin()?;
        let Some((id, alone)) = self.alone()? else {
            return match self.carrier {
                Some(_) => self.carried(forces, asked.visuals),
                None => self.floating(forces, None, asked.visuals),
            };
        };
        let Some(WholeBody { body, condensation, resolution, visuals }) =
            alone.whole(id, self.reduction, asked)?
        else {
            return Err(at(id, Field::NAME)(Problem::NoBody));
        };
        let pole = body.pole().into();
        Ok(Built {
            forces: self.placed_forces(forces, pole, &Attachments::default())?,
            body,
            controls: Controls::default(),
            condensation,
            speeds: Vec::new(),
            liquids: Vec::new(),
            tanks: Vec::new(),
            slugs: Vec::new(),
            resolution,
            visuals,
        })
    }

    /// The forces, with the markers of the places they act at.
    fn placed_forces(
        &self,
        forces: &[Force<ApplicationPoint>],
        pole: Vector3<f64>,
        attachments: &Attachments,
    ) -> Result<Vec<Force<Marker>>, ElementError> {
        let placed = |(i, force): (usize, &Force<ApplicationPoint>)| {
            let id = ElementKind::Force.at(i);
            force::check(id, force, self)?;
            if self.carrier.is_none()
                && force.law.place().is_some_and(|application_point| application_point.on == End::Carrier)
            {
                return Err(at(id, Field::ON)(Problem::NoCarrier));
            }
            if force.law.turns_with_place() {
                let place = force.law.place().and_then(|at| attachments.of(at.on).ok());
                let stiff = place.filter(|place| place.rotations.is_none() && place.carried.is_none());
                if let Some(Attachment { name, .. }) = stiff {
                    return Err(at(id, Field::AXES)(Problem::NoDirection { place: name.clone() }));
                }
            }
            force.try_map(|application_point| Ok(application_point.marker(&force.name, pole, attachments)))
        };
        forces.iter().enumerate().map(placed).collect()
    }

    fn lawful_field(&self) -> Result<(), ElementError> {
        self.magnetic_field.iter().try_for_each(|field| force::magnetic(ElementId::MAGNETIC_FIELD, field))
    }

    fn parts_and_connections(&self) -> Result<(), ElementError> {
        if self.parts.is_empty() && self.connections.is_empty() {
            Ok(())
        } else {
            PartGraph::of_parts(self).map(drop)
        }
    }

    /// The element that is the whole body, if there is one; no other may stand beside it.
    fn alone(&self) -> Result<Option<(ElementId, &dyn Element)>, ElementError> {
        let Some(alone) = self.whole() else { return Ok(None) };
        let beside = |role: Role| !matches!(role, Role::External | Role::Inside(_));
        let others = self.each().filter(|(id, _)| *id != alone.0 && beside(id.kind.role()));
        let carrier = self.carrier.iter().map(|_| ElementId::CARRIER);
        if let Some(other) = carrier.chain(others.map(|(id, _)| id)).next() {
            return Err(at(other, Field::NAME)(Problem::BesideWhole));
        }
        self.free()?;
        Ok(Some(alone))
    }

    /// The first element that is a whole body.
    fn whole(&self) -> Option<(ElementId, &dyn Element)> {
        self.each().find(|(id, _)| id.kind.role() == Role::Whole)
    }

    /// Accepts elements that need a carrier where there is one; elements on a whole body are refused by [`alone`](Self::alone).
    fn without_carrier(&self) -> Result<(), ElementError> {
        if self.carrier.is_some() {
            return Ok(());
        }
        let whole = self.whole().is_some();
        let counts = |role: Role| !(whole && matches!(role, Role::OnCarrier(_)));
        let needs = |(id, _): (ElementId, &dyn Element)| {
            let role = Some(id.kind.role()).filter(|role| counts(*role))?;
            Some((id, role.needs_carrier()?))
        };
        match self.each().find_map(needs) {
            Some((id, (field, problem))) => Err(at(id, field)(problem)),
            None => Ok(()),
        }
    }

    /// Accepts a free body: without a carrier there is no point that a support could fix.
    fn free(&self) -> Result<(), ElementError> {
        if self.support == Support::Free {
            return Ok(());
        }
        Err(at(ElementId::SUPPORT, Field::FIXED_POINT)(Problem::HeldWhole))
    }

    /// The point that is fixed or driven; none of a free body.
    fn held_point(&self) -> Result<Option<Vector3<f64>>, ElementError> {
        let finite =
            |field: Field, values: &[f64; 3]| number::finite(values).map_err(at(ElementId::SUPPORT, field));
        let point = match &self.support {
            Support::Free => return Ok(None),
            Support::FixedPoint { point } => point,
            Support::Prescribed { point, velocity, position, .. } => {
                finite(Field::VELOCITY, velocity)?;
                finite(Field::POSITION, position)?;
                point
            }
        };
        finite(Field::FIXED_POINT, point)?;
        Ok(Some((*point).into()))
    }

    /// An error for each name that an element has after another.
    fn same_names(&self) -> Vec<ElementError> {
        let mut seen = std::collections::HashSet::new();
        let named =
            self.each().filter(|(id, element)| id.kind.role().is_unique() && !element.name().is_empty());
        let repeated = named.filter(|(_, element)| !seen.insert(element.name()));
        let error = |(id, element): (ElementId, &dyn Element)| {
            at(id, Field::NAME)(Problem::DuplicateName { name: element.name().to_owned() })
        };
        repeated.map(error).collect()
    }
}
