//! The mean power of a body, from the polynomial or the harmonics.
//!
//! The polynomial of the reduced equations costs microseconds but knows dashpots alone; a material whose loss depends on frequency needs
//! the harmonics of the polhode, and a liquid makes those so costly that they are interpolated. (A5), (G7)

use std::sync::Arc;

use thiserror::Error;

use super::evolution::Evolution;
use super::interpolated::InterpolatedPower;
use super::power::{MeanPower, PolynomialPower};
use super::response::Response;
use crate::math::eigen::NoConvergence;
use crate::model::{FlexibleBody, ReducedBody};

/// Source of a mean power.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PowerSource {
    /// The polynomial of the reduced equations. (A5)
    Polynomial,
    /// The response of the body to the harmonics of the polhode. (G7)
    Harmonics,
}

/// Error of an evolution that cannot be computed.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum EvolutionError {
    /// The angular momentum is no positive number.
    #[error(
        "{angular_momentum} N·m·s is not the size of an angular momentum; give one that is finite and positive"
    )]
    AngularMomentum {
        /// Angular momentum asked for (N·m·s).
        angular_momentum: f64,
    },
    /// The vibrations could not be found.
    #[error(transparent)]
    Vibration(#[from] NoConvergence),
}

impl PowerSource {
    /// The source for a body: harmonics if a material has a loss law that the polynomial does not contain, else the polynomial.
    #[must_use]
    pub fn suited_to(body: &FlexibleBody) -> Self {
        if body.viscoelastic().is_empty() { Self::Polynomial } else { Self::Harmonics }
    }
}

/// The power of the harmonics at an angular momentum (N·m·s): interpolated where a liquid makes each value costly.
#[must_use]
pub fn harmonic_power(body: &FlexibleBody, response: &Response, angular_momentum: f64) -> Arc<dyn MeanPower> {
    let response = response.clone();
    if body.memories().is_empty() {
        Arc::new(response)
    } else {
        Arc::new(InterpolatedPower::new(response, angular_momentum))
    }
}

impl Evolution {
    /// Secular evolution of a body with the angular momentum `G` (N·m·s), by the power that [suits](PowerSource::suited_to) the body.
    ///
    /// # Errors
    /// [`EvolutionError`] if the angular momentum is not a positive number, or an eigenvalue solver fails.
    pub fn compute(body: &FlexibleBody, reduced: &ReducedBody, G: f64) -> Result<Self, EvolutionError> {
        if !(G > 0.0 && G.is_finite()) {
            return Err(EvolutionError::AngularMomentum { angular_momentum: G });
        }
        let power = match PowerSource::suited_to(body) {
            PowerSource::Polynomial => Arc::new(PolynomialPower::from_reduced(reduced)),
            PowerSource::Harmonics => harmonic_power(body, &Response::compute(body)?, G),
        };
        Ok(Self::new(power, G))
    }
}
