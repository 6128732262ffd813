//! Response of the internal coordinates in the spinning frame: Hill's equations along a polhode.

mod coefficients;
mod floquet;
mod operator;
mod periodic;
mod series;
mod span;
mod spectrum;

use thiserror::Error;

use super::poinsot::FreeRotation;
use super::power::MeanPower;
use super::response::WHOLE;
use crate::math::eigen::NoConvergence;
use crate::model::{FlexibleBody, Principal};
use coefficients::Coefficients;
use floquet::floquet;
use spectrum::Spectrum;

pub use floquet::{Floquet, ParametricResonance};
pub use periodic::PeriodicResponse;

/// Response of a body's internal coordinates along the polhode of its frozen state, at any ratio of spin to elastic frequency.
/// (H1)–(H5)
///
/// Linear in the displacement, with Coriolis' and the centrifugal forces of the moving angular velocity. The reaction of the internal
/// motion on the polhode is left out: [`share`](Self::share) is its size. [`Response`](super::Response) is its limit for slow spins.
#[derive(Clone, Debug)]
pub struct HillResponse {
    /// Coefficients with the impedance of the liquids.
    harmonic: Coefficients,
    /// Coefficients with the coordinates of the liquids in the equations of motion, where those differ.
    coordinates: Option<Coefficients>,
}

/// Residual above which the harmonics are no solution.
const UNSOLVED: f64 = 1e-6;

/// Error of a body or motion without a periodic response.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum HillError {
    /// An eigenvalue solver failed.
    #[error(transparent)]
    Eigenvalues(#[from] NoConvergence),
    /// Momentum wheels change the polhode.
    #[error("the momentum wheels carry angular momentum: the rotation is not that of Euler and Poinsot")]
    Wheels,
    /// The motion is on the separatrix.
    #[error("on the separatrix the rotation has no period; start a little to either side of it")]
    NoPeriod,
}

impl HillResponse {
    /// The response of a body.
    ///
    /// # Errors
    /// [`HillError`] if the eigenvalue solver fails, or for a body with momentum wheels.
    pub fn compute(body: &FlexibleBody) -> Result<Self, HillError> {
        Self::within(body, WHOLE)
    }

    /// The response in every vibration of a body of up to `whole` elastic coordinates, of a larger one in those that the
    /// loads excite.
    fn within(body: &FlexibleBody, whole: usize) -> Result<Self, HillError> {
        if !body.wheels().is_empty() {
            return Err(HillError::Wheels);
        }
        let harmonic = Coefficients::compute(body, whole)?;
        let coordinates = if body.memories().is_empty() {
            None
        } else {
            Some(Coefficients::compute(&body.without_memories(), whole)?)
        };
        Ok(Self { harmonic, coordinates })
    }

    /// Principal moments and axes of the frozen body.
    #[must_use]
    pub fn principal(&self) -> &Principal {
        &self.harmonic.principal
    }

    /// Periodic response along a polhode, with the impedance of liquids. (H4)
    ///
    /// A motion settles to this response only where [`floquet`](Self::floquet) reports no resonance.
    ///
    /// # Errors
    /// [`HillError::NoPeriod`] on the separatrix.
    pub fn periodic(&self, motion: &FreeRotation) -> Result<PeriodicResponse<'_>, HillError> {
        let spectrum = Spectrum::of(motion).ok_or(HillError::NoPeriod)?;
        Ok(PeriodicResponse::along(&self.harmonic, spectrum))
    }

    /// Periodic response of the equations of motion along a polhode, with the coordinates of liquids: the start of a full run. Materials
    /// keep the loss that those equations lack. (H4)
    ///
    /// # Errors
    /// [`HillError::NoPeriod`] on the separatrix.
    pub fn periodic_coordinates(&self, motion: &FreeRotation) -> Result<PeriodicResponse<'_>, HillError> {
        let spectrum = Spectrum::of(motion).ok_or(HillError::NoPeriod)?;
        Ok(PeriodicResponse::along(self.of_motion(), spectrum))
    }

    /// Internal coordinates and rates at a time (s) of the motion, from [`periodic_coordinates`](Self::periodic_coordinates).
    ///
    /// # Errors
    /// [`HillError::NoPeriod`] on the separatrix.
    pub fn state(&self, motion: &FreeRotation, t: f64) -> Result<(Vec<f64>, Vec<f64>), HillError> {
        Ok(self.periodic_coordinates(motion)?.state(t))
    }

    /// Share of the internal motion in the periodic part of the angular momentum, the largest of any harmonic: the size of what
    /// an average along the rigid polhode leaves out. (H6)
    ///
    /// # Errors
    /// [`HillError::NoPeriod`] on the separatrix.
    pub fn share(&self, motion: &FreeRotation) -> Result<f64, HillError> {
        Ok(self.periodic(motion)?.share())
    }

    /// Multipliers of the free internal motions over a period of the polhode, and the resonance that grows fastest. Liquids
    /// are those of the equations of motion, materials have at each vibration the loss of its frequency. (H7)
    ///
    /// # Errors
    /// [`HillError`] on the separatrix, or if the eigenvalue solver fails.
    pub fn floquet(&self, motion: &FreeRotation) -> Result<Floquet, HillError> {
        let spectrum = Spectrum::of(motion).ok_or(HillError::NoPeriod)?;
        Ok(floquet(self.of_motion(), &spectrum, motion)?)
    }

    fn of_motion(&self) -> &Coefficients {
        self.coordinates.as_ref().unwrap_or(&self.harmonic)
    }
}

impl MeanPower for HillResponse {
    fn moments(&self) -> [f64; 3] {
        self.principal().moments
    }

    /// Sum over the harmonics; NaN where Hill's determinant vanishes and the system has no solution. (H5)
    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        match self.periodic(motion) {
            Err(_) => 0.0,
            Ok(response) if response.residual() < UNSOLVED => response.power(),
            Ok(_) => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Mode;
    use crate::problems::ring_of_points;

    /// The error of the projection is of the fourth power of spin over elastic frequency.
    #[test]
    fn excited_vibrations_take_the_power_of_all() {
        let body = ring_of_points(30).body().unwrap();
        let [whole, few] = [usize::MAX, 0].map(|whole| HillResponse::within(&body, whole).unwrap());
        let [all, part] = [&whole, &few].map(|hill| hill.harmonic.size());
        assert!(all == 90 && part < 85, "{all} {part}");
        let slowest = whole.harmonic.rows[0].square.sqrt();
        let moments = whole.principal().moments;
        let gaps = [0.4, 0.2, 0.1].map(|share| {
            let motion = FreeRotation::at_logit(moments, share * slowest * moments[2], Mode::ShortAxis, 0.5);
            (few.mean_power(&motion) / whole.mean_power(&motion) - 1.0).abs()
        });
        assert!(gaps[0] < 1e-4 && gaps[1] < 0.1 * gaps[0].max(1e-9) && gaps[2] < 1e-7, "{part} {gaps:?}");
    }
}
