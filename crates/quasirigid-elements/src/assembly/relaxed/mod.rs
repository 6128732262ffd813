//! Relaxed body of a shape, or of moments of inertia, that were observed in rotation: without its spin it would have them no more.
//! Equations (G17) and (G18), docs/theory/11-materials.md.

mod ellipsoid;
mod surface;

use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::math::sym3::Sym;
use crate::model::FlexibleBody;
use crate::{Assembly, Ellipsoid, Material, Surface};

/// What was observed of a body in rotation.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservedShape {
    /// Its surface: the ends of the semi-axes of an ellipsoid, all vertices of a surface.
    Surface,
    /// Its principal moments of inertia: those that the ellipsoid given would have.
    Moments,
}

/// A body without its spin, and what the spin makes of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxed {
    /// The body without its spin, of the same mass.
    pub assembly: Assembly,
    /// Inertia tensor (kg·m²) of the body in rotation about its centre of mass, axes of the file.
    pub inertia: Sym,
}

/// Relative change of a length above which a linear law of elasticity says nothing of it.
const MOST_STRAIN: f64 = 0.1;

impl Assembly {
    /// The relaxed body of an [observed](ObservedShape) one: under its mean centrifugal load it has the shape, or the moments, given, and
    /// the mass that the density given has in the shape given. (G18)
    ///
    /// `products` are the mean products `⟨ωωᵀ⟩` (rad²/s², axes of the file) of its rotation, for the inertia tensors (kg·m², axes of the
    /// file) of the relaxed body and of that in rotation, both the same as long as the bulge is not known. An assembly that is not observed
    /// is its own relaxed body.
    ///
    /// # Errors
    /// [`ElementError`] for a body that is no single ellipsoid or surface, and for one too soft or spinning too fast; errors of
    /// `products`.
    pub fn relaxed<E: From<ElementError>>(
        &self,
        products: impl Fn([Sym; 2]) -> Result<Sym, E>,
    ) -> Result<Relaxed, E> {
        let plain = Self { as_observed: None, ..self.clone() };
        let Some(shape) = self.as_observed else {
            let inertia = plain.body()?.invariants().J;
            return Ok(Relaxed { assembly: plain, inertia });
        };
        plain.solid()?;
        match (self.ellipsoids.as_slice(), self.surfaces.as_slice()) {
            ([given], []) => {
                let (found, inertia) = ellipsoid::relaxed(given, shape, &products)?;
                Ok(Relaxed { assembly: Self { ellipsoids: vec![found], ..plain }, inertia })
            }
            ([], [given]) => {
                let (found, inertia) = surface::relaxed(given, &plain, &products)?;
                Ok(Relaxed { assembly: Self { surfaces: vec![found], ..plain }, inertia })
            }
            _ => Err(at(self.observed_element(), Field::SHAPE)(Problem::NoObservedShape).into()),
        }
    }

    /// The same geometry and density for the solids of another assembly, whose materials dissipate otherwise.
    #[must_use]
    pub fn shaped_as(&self, relaxed: &Self) -> Self {
        let mut assembly = Self { as_observed: None, ..self.clone() };
        for (own, other) in assembly.ellipsoids.iter_mut().zip(&relaxed.ellipsoids) {
            let Ellipsoid { semi_axes, material, .. } = other;
            (own.semi_axes, own.material.density) = (*semi_axes, material.density);
        }
        for (own, other) in assembly.surfaces.iter_mut().zip(&relaxed.surfaces) {
            let Surface { surface, material, .. } = other;
            (own.surface, own.material.density) = (surface.clone(), material.density);
        }
        assembly
    }

    /// Refuses a shape that was observed in rotation: the body is built of the relaxed one.
    pub(super) fn without_spin(&self) -> Result<(), ElementError> {
        match self.as_observed {
            Some(_) => Err(at(self.observed_element(), Field::SHAPE)(Problem::AsObserved)),
            None => Ok(()),
        }
    }

    /// Accepts materials that keep a shape under a constant load.
    fn solid(&self) -> Result<(), ElementError> {
        let flows = |material: &Material| material.rheology.viscous_time().is_some();
        let flowing = self.each().any(|(_, element)| element.homogeneous().is_some_and(flows));
        if flowing {
            return Err(at(self.observed_element(), Field::MATERIAL)(Problem::FlowsSteadily));
        }
        Ok(())
    }

    fn observed_element(&self) -> ElementId {
        if self.ellipsoids.is_empty() { ElementKind::Surface.at(0) } else { ElementKind::Ellipsoid.at(0) }
    }
}

/// Displacements of a body under a mean centrifugal load. (G17)
fn displaced(body: &FlexibleBody, products: Sym, place: ElementId) -> Result<Vec<f64>, ElementError> {
    body.displaced_by(products).ok_or_else(|| at(place, Field::SHAPE)(Problem::TooSoft { strain: f64::NAN }))
}

/// Accepts a relative change of length that is small.
fn small(strain: f64, place: ElementId) -> Result<(), ElementError> {
    if strain <= MOST_STRAIN { Ok(()) } else { Err(at(place, Field::SHAPE)(Problem::TooSoft { strain })) }
}
