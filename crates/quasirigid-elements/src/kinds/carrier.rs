use nalgebra::{Matrix3, Vector3};

use crate::contribution::Piece;
use crate::error::{ElementError, ElementId, Field, at};
use crate::model::Inertia;
use crate::number;
use crate::visual::{Outline, cuboid_of};

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
    /// Inertia tensor (kg·m²) about a point (m) of the file's frame.
    #[must_use]
    pub fn inertia_about(&self, point: [f64; 3]) -> [[f64; 3]; 3] {
        let arm = self.position() - Vector3::from(point);
        let shift = arm.norm_squared() * Matrix3::identity() - arm * arm.transpose();
        (Matrix3::from(self.inertia) + self.mass * shift).into()
    }

    pub(crate) fn piece(&self) -> Result<Piece, ElementError> {
        number::mass(self.mass).map_err(at(ElementId::CARRIER, Field::MASS))?;
        number::finite(&self.center_of_mass).map_err(at(ElementId::CARRIER, Field::CENTER_OF_MASS))?;
        let inertia = Inertia::new(self.inertia)
            .map_err(|error| at(ElementId::CARRIER, Field::INERTIA)(error.into()))?;
        Ok(Piece::rigid(self.mass, Vector3::zeros(), &inertia))
    }

    /// Box with the mass, the centre and the inertia of the carrier.
    pub(crate) fn outline(&self) -> Option<Outline> {
        let piece = self.piece().ok()?;
        Some(Outline::still(cuboid_of(self.mass, self.position(), piece.second)?))
    }

    pub(crate) fn position(&self) -> Vector3<f64> {
        self.center_of_mass.into()
    }
}
