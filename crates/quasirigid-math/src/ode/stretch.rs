//! Stretches of an integration between two breakpoints of the rate, and the weights by which the steps sum up what depends on time alone.
//! Equation (Z1), docs/theory/19-events.md.

use super::{dop853_tableau, radau_tableau};

/// Stretch of time between two breakpoints of a rate, within which the rate is smooth: the whole time without breakpoints.
///
/// At a breakpoint the rate has two values. An integrator that ends a step there needs the one before, and the one after to go on; both
/// are limits from inside the stretch that the step lies in. (Z1)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Begin (s).
    pub from: f64,
    /// End (s).
    pub to: f64,
}

/// Distance that counts as inside, in units of the rounding of the time.
const INSIDE: f64 = 4.0 * f64::EPSILON;

impl Default for Stretch {
    fn default() -> Self {
        Self { from: f64::NEG_INFINITY, to: f64::INFINITY }
    }
}

impl Stretch {
    /// The time itself inside the stretch, and the nearest time inside for its ends. (Z1)
    #[must_use]
    #[inline(always)]
    pub fn within(&self, t: f64) -> f64 {
        let Self { from, to } = *self;
        let length = if (to - from).is_finite() { to - from } else { 0.0 };
        let inward = |end: f64| if end.is_finite() { INSIDE * end.abs().max(length) } else { 0.0 };
        let (low, high) = (from + inward(from), to - inward(to));
        if low < high { t.clamp(low, high) } else { 0.5 * (from + to) }
    }
}

/// Last step of a solver as a rule of quadrature: what it has added of a rate that depends on time alone.
#[derive(Clone, Copy, Debug)]
pub struct StepRule {
    /// Start of the step (s).
    pub t: f64,
    /// Length of the step (s).
    pub h: f64,
    /// Times of the stages, in steps.
    pub nodes: &'static [f64],
    /// Weights of the stages.
    pub weights: &'static [f64],
}

impl StepRule {
    /// Step of the explicit method.
    pub(super) fn explicit((t, h): (f64, f64)) -> Self {
        let nodes = &dop853_tableau::C[..dop853_tableau::STAGES];
        Self { t, h, nodes, weights: &dop853_tableau::B }
    }

    /// Step of the implicit method.
    pub(super) fn implicit((t, h): (f64, f64)) -> Self {
        Self { t, h, nodes: &radau_tableau::C, weights: &radau_tableau::A[radau_tableau::STAGES - 1] }
    }

    /// Sum over the step of a function of time, component by component.
    pub fn sum<const N: usize>(&self, mut function: impl FnMut(f64) -> [f64; N]) -> [f64; N] {
        let mut sum = [0.0; N];
        for (node, weight) in self.nodes.iter().zip(self.weights).filter(|(_, weight)| **weight != 0.0) {
            let value = function(self.t + node * self.h);
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum += self.h * weight * value;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_at_the_ends_are_taken_inside() {
        let stretch = Stretch { from: 1000.0, to: 1000.1 };
        let (first, last) = (stretch.within(1000.0), stretch.within(1000.1));
        assert!(first > 1000.0 && first < 1000.0 + 1e-11 && last < 1000.1 && last > 1000.1 - 1e-11);
        assert_eq!(stretch.within(1000.05), 1000.05);
        assert_eq!(Stretch::default().within(-3.0), -3.0);
        let open = Stretch { to: 5.0, ..Stretch::default() };
        assert!(open.within(5.0) < 5.0 && open.within(-1e300) == -1e300);
        let zero = Stretch { from: 0.0, to: 1.0 };
        assert!(zero.within(0.0) > 0.0 && zero.within(0.0) < 1e-14);
    }

    /// Both rules integrate polynomials of degree seven exactly.
    #[test]
    fn steps_are_rules_of_quadrature() {
        for rule in [StepRule::explicit((2.0, 0.5)), StepRule::implicit((2.0, 0.5))] {
            let [sum] = rule.sum(|t| [t.powi(7)]);
            let exact = (2.5_f64.powi(8) - 2.0_f64.powi(8)) / 8.0;
            assert!((sum / exact - 1.0).abs() < 1e-14, "{sum} {exact}");
        }
    }
}
