use std::sync::Arc;

use crate::averaging::{MeanPower, PolynomialPower, PowerSource, Response, harmonic_power};
use crate::model::FlexibleBody;

/// Mean powers of the averages of a body along its frozen polhode, and which of them is averaged first.
#[derive(Clone, Debug)]
pub struct AveragePowers {
    /// Response of the body to harmonics.
    pub response: Response,
    /// Power of the reduced equations.
    pub polynomial: PolynomialPower,
    /// Power of the harmonics, interpolated where it costs much.
    pub harmonics: Arc<dyn MeanPower>,
    /// Source of the average that is tried first.
    pub first: PowerSource,
    /// Whether that source was asked for, so that no other is tried.
    pub asked: bool,
}

impl AveragePowers {
    /// Mean powers of a body at an angular momentum (N·m·s), at which costly ones are interpolated; a source that is asked for is the only one.
    #[must_use]
    pub fn new(
        body: &FlexibleBody,
        response: Response,
        polynomial: PolynomialPower,
        asked: Option<PowerSource>,
        angular_momentum: f64,
    ) -> Self {
        let harmonics = harmonic_power(body, &response, angular_momentum);
        let first = asked.unwrap_or(PowerSource::suited_to(body));
        Self { response, polynomial, harmonics, first, asked: asked.is_some() }
    }

    /// Power of a source.
    #[must_use]
    pub fn of(&self, source: PowerSource) -> Arc<dyn MeanPower> {
        match source {
            PowerSource::Polynomial => Arc::new(self.polynomial.clone()),
            PowerSource::Harmonics => Arc::clone(&self.harmonics),
        }
    }

    /// Whether the harmonics may take the place of the polynomial.
    pub(super) fn may_take_harmonics(&self) -> bool {
        self.first == PowerSource::Polynomial && !self.asked
    }
}
