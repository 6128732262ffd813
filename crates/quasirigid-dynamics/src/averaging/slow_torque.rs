use thiserror::Error;

use super::eddy_torque::EddyTorque;
use crate::math::vec3::{add, scale};
use crate::model::Marker;
use crate::model::force::{Axes, Force, ForceLaw};

/// Slow torque: external, and weak over one revolution. (A8)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlowTorque {
    /// Torque fixed in the body (N·m), body axes.
    pub constant: [f64; 3],
    /// Coefficient `κ` of a drag torque `−κω` (N·m·s).
    pub drag: f64,
    /// Eddy currents, without those that are zero. (A14)
    pub eddy: Option<EddyTorque>,
}

/// Error of a force whose mean over a free rotation depends on the attitude.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "the force {name:?} cannot be averaged over free rotations; those that can are a drag torque, a constant torque in body axes, and eddy currents, all of them in one field"
)]
pub struct Unaveraged {
    /// Name of the force.
    pub name: String,
}

impl SlowTorque {
    /// Sums the torques of some forces.
    ///
    /// # Errors
    /// [`Unaveraged`] names the first force that is neither a drag of the spin, nor a constant torque in body axes, nor eddy currents in the
    /// field of the eddy currents before.
    pub fn from_forces(forces: &[Force<Marker>]) -> Result<Self, Unaveraged> {
        let mut sum = Self::default();
        for Force { name, law } in forces {
            match law {
                ForceLaw::SpinDrag { coefficient } => sum.drag += coefficient,
                ForceLaw::Torque { torque, axes: Axes::Body, wave } if wave.frequency == 0.0 => {
                    sum.constant = add(sum.constant, scale(wave.phase.cos(), *torque));
                }
                ForceLaw::EddyCurrent { tensor, field, .. } => {
                    let eddy = EddyTorque { tensor: *tensor, field: *field };
                    sum.eddy = match sum.eddy {
                        before if eddy.is_zero() => before,
                        None => Some(eddy),
                        Some(before) if before.field == *field => Some(before.with(*tensor)),
                        Some(_) => return Err(Unaveraged { name: name.clone() }),
                    };
                }
                _ => return Err(Unaveraged { name: name.clone() }),
            }
        }
        Ok(sum)
    }

    /// True if there is no torque.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        *self == Self::default()
    }
}
