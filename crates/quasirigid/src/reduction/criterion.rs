/// What a criterion of validity compares.
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
    /// Left-over force on the coordinates against the load, the larger of those on elastic and on cyclic ones. (R12)
    Residual,
    /// What one more step of the series changes in the power dissipated, against the power: concerns dissipation only. (V11)
    Power,
    /// Elastic torque against the rigid body's, `max|f₄|/max|f₂|`: concerns averages along rigid polhodes only. (V10)
    Levels,
    /// Decay of free vibrations against the spin, `T₂/T₃`: concerns initial vibrations only. (V6)
    Forgetting,
}

/// One criterion of validity with its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criterion {
    /// What is compared.
    pub comparison: Comparison,
    /// The ratio that should be small.
    pub value: f64,
}

/// What a criterion says.
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
    /// Whether it concerns the motion on the slow manifold, not the start, the dissipation or averages alone.
    #[must_use]
    pub fn concerns_motion(self) -> bool {
        !matches!(self, Self::Power | Self::Levels | Self::Forgetting)
    }
}

impl Criterion {
    /// The ratio below which the criterion holds.
    #[must_use]
    pub fn limit(&self) -> f64 {
        self.limits().0
    }

    /// The ratio from which the criterion fails.
    #[must_use]
    pub fn failure(&self) -> f64 {
        self.limits().1
    }

    /// What the number says. Vibrations that outlast the spin concern the start only, so that criterion never fails.
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

    /// Ratio below which it holds, and from which it fails. At the paper's order the deviation from the rigid body is
    /// in error by about the square of the first two: 2 % at their limit.
    fn limits(&self) -> (f64, f64) {
        match self.comparison {
            Comparison::Spin | Comparison::Damping | Comparison::Relaxation | Comparison::Resonance => {
                (0.15, 0.5)
            }
            Comparison::Series
            | Comparison::Linearity
            | Comparison::Residual
            | Comparison::Power
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
