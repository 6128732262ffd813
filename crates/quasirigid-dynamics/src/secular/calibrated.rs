use std::sync::Arc;

use crate::averaging::{Evolution, FreeRotation, MeanPower, RotationState};
use crate::model::Mode;

/// Calibrated power: mean power of an average times factors from the modes at the poles. (Q5)
///
/// The factors hold where the wobble is small; each holds throughout its mode of rotation.
#[derive(Clone, Debug)]
pub struct CalibratedPower {
    base: Arc<dyn MeanPower>,
    /// Factors in the long-axis and the short-axis mode.
    factors: [f64; 2],
}

impl CalibratedPower {
    /// Calibrates a power so that small wobbles change at the rates (1/s) of the modes; an unknown rate leaves the average unchanged.
    #[must_use]
    pub fn new(
        base: impl MeanPower + 'static,
        angular_momentum: f64,
        rate: impl Fn(Mode) -> Option<f64>,
    ) -> Self {
        let base: Arc<dyn MeanPower> = Arc::new(base);
        let average = Evolution::new(&base, angular_momentum);
        let factor = |mode: Mode| {
            let factor = rate(mode).map(|rate| rate / average.wobble_rate(mode));
            factor.filter(|factor| factor.is_finite() && *factor > 0.0).unwrap_or(1.0)
        };
        let factors = [factor(Mode::LongAxis), factor(Mode::ShortAxis)];
        Self { base, factors }
    }

    /// Factor of the power in a mode.
    #[must_use]
    pub fn factor(&self, mode: Mode) -> f64 {
        match mode {
            Mode::LongAxis => self.factors[0],
            Mode::ShortAxis => self.factors[1],
        }
    }
}

impl MeanPower for CalibratedPower {
    fn moments(&self) -> [f64; 3] {
        self.base.moments()
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        self.factor(motion.mode()) * self.base.mean_power(motion)
    }

    fn budget(&self, motion: &FreeRotation) -> Vec<(String, f64)> {
        let factor = self.factor(motion.mode());
        self.base.budget(motion).into_iter().map(|(name, power)| (name, factor * power)).collect()
    }
}

/// Largest angle (rad) between the angular momentum and the circled axis at a rotation state.
#[must_use]
pub(super) fn wobble(
    moments: [f64; 3],
    angular_momentum: f64,
    RotationState { mode, xi }: RotationState,
) -> f64 {
    FreeRotation::at_logit(moments, angular_momentum, mode, xi).nutation()[1]
}
