use nalgebra::Vector3;

use crate::elements::assembly::affine::Piece;
use crate::elements::assembly::coefficient;
use crate::elements::error::{ElementError, ElementId, Field, at};
use crate::elements::visual::{Outline, cuboid_of};
use crate::model::Inertia;

/// Carrier: the rigid body `G` that everything else is mounted on (paper, §1).
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Carrier {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Inertia tensor (kg·m²) about the carrier's own centre of mass, in the file's axes.
    pub inertia: [[f64; 3]; 3],
}

impl Carrier {
    pub(in crate::elements) fn piece(&self) -> Result<Piece, ElementError> {
        coefficient::mass(self.mass).map_err(at(ElementId::CARRIER, Field::MASS))?;
        coefficient::finite(&self.center_of_mass).map_err(at(ElementId::CARRIER, Field::CENTER_OF_MASS))?;
        let inertia = Inertia::new(self.inertia)
            .map_err(|error| at(ElementId::CARRIER, Field::INERTIA)(error.into()))?;
        Ok(Piece::rigid(self.mass, Vector3::zeros(), &inertia))
    }

    /// Box with the mass, the centre and the inertia of the carrier.
    pub(in crate::elements) fn outline(&self) -> Option<Outline> {
        let piece = self.piece().ok()?;
        Some(Outline::still(cuboid_of(self.mass, self.position(), piece.second)?))
    }

    pub(in crate::elements) fn position(&self) -> Vector3<f64> {
        self.center_of_mass.into()
    }
}
