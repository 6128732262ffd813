use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::model::Rheology;
use crate::number;

/// Material of a solid: homogeneous and isotropic.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Density (kg/m³).
    pub density: f64,
    /// Young's modulus (Pa).
    pub young: f64,
    /// Poisson's ratio, above −1 and below ½.
    pub poisson: f64,
    /// Rheology: response to periodic strain.
    pub rheology: Rheology,
}

impl Material {
    /// Shear modulus `μ` (Pa).
    #[must_use]
    pub fn shear(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// Lamé's other modulus `λ` (Pa).
    #[must_use]
    pub fn lame(&self) -> f64 {
        2.0 * self.shear() * self.poisson / (1.0 - 2.0 * self.poisson)
    }

    /// Accepts the material of an element.
    pub(crate) fn check(&self, place: ElementId) -> Result<(), ElementError> {
        number::positive(self.density).map_err(at(place, Field::DENSITY))?;
        self.check_constants(place)
    }

    /// Accepts the material of an element that may have no mass.
    pub(crate) fn check_constants(&self, place: ElementId) -> Result<(), ElementError> {
        number::non_negative(self.density).map_err(at(place, Field::DENSITY))?;
        number::positive(self.young).map_err(at(place, Field::YOUNG))?;
        if !(self.poisson > -1.0 && self.poisson < 0.5) {
            return Err(at(place, Field::POISSON)(Problem::Poisson { value: self.poisson }));
        }
        self.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))
    }
}
