//! Slosh as it was measured, and diaphragms: values of a user in the place of those of the theory.

use super::{MEASURED, Tank, TankError};
use crate::error::{ElementError, ElementId, Field, at};
use crate::number;

/// Measured values of a slosh mode, each in the place of the theory's, and a diaphragm or bladder that holds it.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeasuredSlosh {
    /// Frequency in a tank at rest, under the effective gravity of the model (rad/s).
    pub frequency: Option<f64>,
    /// Mass that sloshes (kg).
    pub mass: Option<f64>,
    /// Damping ratio, baffles left out.
    pub damping_ratio: Option<f64>,
    /// Stiffness of a diaphragm against the moving mass (N/m), beside the weight.
    pub stiffness: f64,
    /// Damping of a diaphragm against the moving mass (N·s/m), beside that of the liquid.
    pub damping: f64,
}

impl Tank {
    /// Checks the measured values.
    pub(super) fn check_measured(&self, id: ElementId) -> Result<(), ElementError> {
        let (given, modes) = (self.measured.len(), self.modes);
        if given > modes {
            return Err(at(id, MEASURED)(TankError::TooManyMeasured { given, modes }.into()));
        }
        for mode in &self.measured {
            [mode.frequency, mode.mass]
                .into_iter()
                .flatten()
                .try_for_each(number::positive)
                .map_err(at(id, MEASURED))?;
            [mode.damping_ratio.unwrap_or(0.0), mode.stiffness, mode.damping]
                .into_iter()
                .try_for_each(number::non_negative)
                .map_err(at(id, MEASURED))?;
        }
        for baffle in &self.baffles {
            number::finite(&[baffle.height]).map_err(at(id, super::BAFFLES))?;
            number::positive(baffle.width).map_err(at(id, super::BAFFLES))?;
        }
        self.wave_amplitude.map_or(Ok(()), number::positive).map_err(at(id, super::WAVE_AMPLITUDE))
    }

    /// Measured values of a mode, by its number from 0.
    pub(super) fn measured(&self, number: usize) -> MeasuredSlosh {
        self.measured.get(number).copied().unwrap_or_default()
    }

    /// Refuses masses with which what is left of the liquid has none, or a negative moment of inertia.
    pub(super) fn check_rest(
        &self,
        rest: [f64; 2],
        liquid: f64,
        moving: f64,
    ) -> Result<(), (Field, TankError)> {
        let possible = rest[0] > 0.0 && rest[1] >= 0.0;
        let given = self.measured.iter().any(|mode| mode.mass.is_some());
        if possible || !given { Ok(()) } else { Err((MEASURED, TankError::HeavySlosh { moving, liquid })) }
    }
}
