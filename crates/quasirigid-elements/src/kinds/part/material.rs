use crate::Material;
use crate::error::{ElementError, ElementId, Field, at};
use crate::model::Rheology;
use crate::number;

/// Material of a part.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum ElasticMaterial {
    /// Equal in every direction.
    Isotropic(Material),
    /// With three planes of symmetry.
    Orthotropic(Orthotropic),
}

/// A material with three planes of symmetry: wood, a ply of fibres.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Orthotropic {
    /// Density (kg/m³).
    pub density: f64,
    /// Young's moduli along the axes 1, 2, 3 (Pa).
    pub young: [f64; 3],
    /// Poisson's ratios `ν₁₂, ν₁₃, ν₂₃`: strain along the second axis for a stress along the first.
    pub poisson: [f64; 3],
    /// Shear moduli `G₁₂, G₁₃, G₂₃` (Pa).
    pub shear: [f64; 3],
    /// Rheology: response to periodic strain.
    pub rheology: Rheology,
}

impl ElasticMaterial {
    /// Rheology of the material.
    pub(super) fn rheology_mut(&mut self) -> &mut Rheology {
        match self {
            Self::Isotropic(material) => &mut material.rheology,
            Self::Orthotropic(material) => &mut material.rheology,
        }
    }

    /// Accepts the material of a part that may have no mass.
    pub(super) fn check_constants(&self, place: ElementId) -> Result<(), ElementError> {
        match self {
            Self::Isotropic(material) => material.check_constants(place),
            Self::Orthotropic(material) => {
                number::non_negative(material.density).map_err(at(place, Field::DENSITY))?;
                material.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))
            }
        }
    }

    /// Accepts the material of a part; its moduli are for the part to judge.
    pub(super) fn check(&self, place: ElementId) -> Result<(), ElementError> {
        match self {
            Self::Isotropic(material) => material.check(place),
            Self::Orthotropic(material) => {
                number::positive(material.density).map_err(at(place, Field::DENSITY))?;
                material.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))
            }
        }
    }

    /// Density (kg/m³).
    #[must_use]
    pub fn density(&self) -> f64 {
        match self {
            Self::Isotropic(material) => material.density,
            Self::Orthotropic(material) => material.density,
        }
    }

    /// Rheology: response to periodic strain.
    #[must_use]
    pub fn rheology(&self) -> &Rheology {
        match self {
            Self::Isotropic(material) => &material.rheology,
            Self::Orthotropic(material) => &material.rheology,
        }
    }
}
