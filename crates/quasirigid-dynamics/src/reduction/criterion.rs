//! Criteria of validity and their verdicts: ratios that should be small, each with two limits.
//! Criteria of initial vibrations, dissipation and averages do not judge the motion; the limits are set so that the deviation from the
//! rigid body is in error by about 2 % at the first one.
//! Equations (V4) to (V13), docs/theory/04-validity.md; (R12), docs/theory/03-reduction.md; (C7), docs/theory/13-inside.md.

/// Comparison that a criterion of validity makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// Spin against the slowest elastic frequency, `|ω|/Ω_min`. (V4)
    Spin,
    /// Spin against the rate at which springs overcome dashpots, `β|ω|`. (V5)
    Damping,
    /// Spin against the rate at which friction overcomes the inertia of rotors and liquids, `τ|ω|`. (C7)
    Relaxation,
    /// Convergence of the series, the larger of `Ω₃/Ω₁` and `Ω₅/Ω₃`. (V7)
    Series,
    /// Strength of the strongest harmonic of the polhode near an elastic frequency. (V8)
    Resonance,
    /// Largest displacement against the size of the body. (V9)
    Linearity,
    /// Residual force on the coordinates against the load, the larger ratio of elastic and cyclic ones. (R12)
    Residual,
    /// Change of the external loads by displacements, against the stiffness that resists these. (V13)
    Loads,
    /// Change of the power dissipated by two more orders of the series, against the power: concerns dissipation only. (V11)
    Power,
    /// Rate and frequency of a small wobble about the steady spins against the modes: concerns dissipation only. (V12)
    Wobbles,
    /// Elastic torque against the rigid body's, `max|f₄|/max|f₂|`: concerns averages along rigid polhodes only. (V10)
    Levels,
    /// Decay of free vibrations against the spin, `T₂/T₃`: concerns initial vibrations only. (V6)
    Forgetting,
}

/// One criterion of validity with its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criterion {
    /// Comparison.
    pub comparison: Comparison,
    /// Ratio that should be small.
    pub value: f64,
}

/// Verdict of a criterion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The ratio is small.
    Holds,
    /// The ratio is not small: expect errors of its size, relative to the deviation from the rigid body.
    Marginal,
    /// The theory does not hold.
    Fails,
}

impl Comparison {
    /// True if the comparison concerns the motion on the slow manifold, not the start, the dissipation or averages alone.
    #[must_use]
    pub fn concerns_motion(self) -> bool {
        !matches!(self, Self::Power | Self::Wobbles | Self::Levels | Self::Forgetting)
    }
}

impl Criterion {
    /// Ratio below which the criterion holds.
    #[must_use]
    pub fn limit(&self) -> f64 {
        self.limits().0
    }

    /// Ratio from which the criterion fails.
    #[must_use]
    pub fn failure(&self) -> f64 {
        self.limits().1
    }

    /// Verdict of the ratio. [`Comparison::Forgetting`] never fails, since vibrations that outlast the spin concern the start only.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let (holds, fails) = self.limits();
        if self.value < holds {
            Verdict::Holds
        } else if self.value < fails || self.comparison == Comparison::Forgetting {
            Verdict::Marginal
        } else {
            Verdict::Fails
        }
    }

    /// Ratio below which the criterion holds, and from which it fails. At the paper's order the deviation from the rigid body is in error
    /// by about the square of the spin, of the damping and of the loads: 2 % at their limit.
    fn limits(&self) -> (f64, f64) {
        match self.comparison {
            Comparison::Spin
            | Comparison::Damping
            | Comparison::Relaxation
            | Comparison::Resonance
            | Comparison::Loads => (0.15, 0.5),
            Comparison::Series
            | Comparison::Linearity
            | Comparison::Residual
            | Comparison::Power
            | Comparison::Wobbles
            | Comparison::Levels => (0.1, 0.5),
            Comparison::Forgetting => (1.0, f64::INFINITY),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_change_on_both_sides_of_each_limit() {
        let verdict = |comparison, value| Criterion { comparison, value }.verdict();
        assert_eq!(verdict(Comparison::Spin, 0.149), Verdict::Holds);
        assert_eq!(verdict(Comparison::Spin, 0.15), Verdict::Marginal);
        assert_eq!(verdict(Comparison::Spin, 0.5), Verdict::Fails);
        assert_eq!(verdict(Comparison::Residual, 0.499), Verdict::Marginal);
        assert_eq!(verdict(Comparison::Series, f64::NAN), Verdict::Fails);
        assert_eq!(verdict(Comparison::Power, 0.5), Verdict::Fails);
        assert_eq!(verdict(Comparison::Levels, 0.499), Verdict::Marginal);
        assert_eq!(verdict(Comparison::Forgetting, f64::INFINITY), Verdict::Marginal);
    }
}
