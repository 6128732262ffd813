//! Robust losses: how much a residual counts, so that a few gross errors do not decide. Equation (O19), docs/theory/23-sensitivity.md.

use quasirigid_io::model::Named;

/// Kind of a loss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// Squares: that of normal errors.
    Squares,
    /// Squares to the scale, and linear beyond.
    Huber,
    /// A smooth loss between both.
    SoftL1,
}

impl Named for Loss {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("squares", Self::Squares, "least squares, for normal errors"),
        ("huber", Self::Huber, "squares, and linear beyond the scale"),
        ("soft-l1", Self::SoftL1, "smooth, linear far beyond the scale"),
    ];
}

/// Scales (deviations) at which a loss has 95 % of the efficiency of least squares for normal errors.
const HUBER: f64 = 1.345;
const SOFT_L1: f64 = 1.287;
/// Half-width and points of the quadrature over normal errors.
const WIDE: f64 = 9.0;
const POINTS: i32 = 3600;

/// Loss with its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobustLoss {
    /// Kind.
    pub kind: Loss,
    /// Scale, in deviations.
    pub scale: f64,
}

impl Default for RobustLoss {
    fn default() -> Self {
        Self::new(Loss::Squares, None)
    }
}

impl RobustLoss {
    /// A loss of a scale, by default that of 95 % efficiency for normal errors.
    #[must_use]
    pub fn new(kind: Loss, scale: Option<f64>) -> Self {
        let own = match kind {
            Loss::Squares => f64::INFINITY,
            Loss::Huber => HUBER,
            Loss::SoftL1 => SOFT_L1,
        };
        Self { kind, scale: scale.unwrap_or(own) }
    }

    /// Root of the loss with the sign of the residual: the residual whose square is the loss.
    pub(super) fn root(self, r: f64) -> f64 {
        let c = self.scale;
        match self.kind {
            Loss::Squares => r,
            Loss::Huber if r.abs() <= c => r,
            Loss::Huber => (c * (2.0 * r.abs() - c)).sqrt().copysign(r),
            // 2 c² (√(1+s²) − 1) = 2 r²/(√(1+s²) + 1), without cancellation
            Loss::SoftL1 => r * (2.0 / (1.0 + (r / c).hypot(1.0))).sqrt(),
        }
    }

    /// Half of the derivative of the loss.
    pub(super) fn influence(self, r: f64) -> f64 {
        let c = self.scale;
        match self.kind {
            Loss::Squares => r,
            Loss::Huber => r.clamp(-c, c),
            Loss::SoftL1 => r / (r / c).hypot(1.0),
        }
    }

    /// Half of the second derivative of the loss.
    pub(super) fn slope(self, r: f64) -> f64 {
        let c = self.scale;
        match self.kind {
            Loss::Squares => 1.0,
            Loss::Huber => f64::from(r.abs() <= c),
            Loss::SoftL1 => (r / c).hypot(1.0).powi(-3),
        }
    }

    /// Means of the squared influence and of the slope over normal errors of unit deviation.
    pub(super) fn of_normal_errors(self) -> [f64; 2] {
        let step = WIDE / f64::from(POINTS);
        let points = (-POINTS..=POINTS).map(|k| step * f64::from(k));
        let weighted = points.map(|r| {
            let weight = step * (-0.5 * r * r).exp() / std::f64::consts::TAU.sqrt();
            [self.influence(r).powi(2), self.slope(r)].map(|value| weight * value)
        });
        weighted.fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values and derivatives of the losses against differences of the root's square.
    #[test]
    fn influence_and_slope_are_derivatives_of_the_loss() {
        let h = 1e-4;
        for loss in [Loss::Squares, Loss::Huber, Loss::SoftL1].map(|kind| RobustLoss::new(kind, None)) {
            let of = |r: f64| loss.root(r).powi(2);
            for r in [-40.0, -3.0, -0.7, 1e-3, 0.5, 2.0, 1e3] {
                let first = (of(r + h) - of(r - h)) / (4.0 * h);
                assert!((first / loss.influence(r) - 1.0).abs() < 1e-6, "{loss:?} {r}: {first}");
                let second = (loss.influence(r + h) - loss.influence(r - h)) / (2.0 * h);
                assert!((second - loss.slope(r)).abs() < 1e-6, "{loss:?} {r}: {second}");
            }
        }
        assert_eq!(RobustLoss::new(Loss::Huber, Some(2.0)).root(-5.0).powi(2), 4.0 * 5.0 - 4.0);
    }

    #[test]
    fn scales_have_the_efficiency_that_they_state() {
        for kind in [Loss::Huber, Loss::SoftL1] {
            let [influence, slope] = RobustLoss::new(kind, None).of_normal_errors();
            let efficiency = slope * slope / influence;
            assert!((efficiency - 0.95).abs() < 1e-3, "{kind:?}: {efficiency}");
        }
        let [influence, slope] = RobustLoss::default().of_normal_errors();
        assert!((influence - 1.0).abs() < 1e-9 && (slope - 1.0).abs() < 1e-9);
    }
}
