//! Impulse of a prescribed force: what the steps have summed up, against a quadrature that knows nothing of them. (Z4)

use super::prescribed::Prescribed;
use super::{Allowed, Missed, allowed_impulse};
use crate::math::ode::{Checkpoint, StepRule, Stretch};
use crate::math::quadrature::{gauss_lobatto, integral};
use crate::math::vec3::{add, norm, scale};
use crate::model::FlexibleBody;

/// Difference, relative to the impulse of the force whatever its direction, above which it was not seen.
pub(super) const SEEN: f64 = 1e-6;
/// Error of the quadrature, relative to the largest value in an interval; of the impulse whatever its direction, which only sets a limit.
const ERROR: f64 = 1e-10;
const ROUGH: f64 = 1e-2;
/// Points at which the largest value in an interval is looked for.
const INTERVAL_SAMPLES: usize = 17;

/// Impulses of a prescribed force.
#[derive(Clone, Debug)]
pub(super) struct Account<'a> {
    part: Prescribed<'a>,
    /// Impulse of the steps in this interval.
    seen: [f64; 3],
    /// Difference from the quadrature in all intervals before.
    gap: [f64; 3],
    /// `∫|F| dt` in all intervals before.
    whole: f64,
    /// `∫|F| dt` over the whole run, roughly, as far as the intervals are known at its start.
    expected: f64,
    steps: u64,
    /// Error that a step may have.
    allowed: f64,
    /// Places in an interval, as shares of it, at which its largest value is looked for.
    looks: Vec<f64>,
}

impl<'a> Account<'a> {
    pub fn of(part: Prescribed<'a>) -> Self {
        let looks = gauss_lobatto(INTERVAL_SAMPLES).into_iter().map(|[x, _]| 0.5 * (x + 1.0)).collect();
        Self { part, seen: [0.0; 3], gap: [0.0; 3], whole: 0.0, expected: 0.0, steps: 0, allowed: 0.0, looks }
    }

    /// Adds up what the force gives in intervals of this middle and length.
    pub fn expect(&mut self, intervals: &[[f64; 2]]) {
        let part = self.part;
        let size = |[middle, length]: &[f64; 2]| {
            let ends = [middle - 0.5 * length, middle + 0.5 * length];
            integral(&mut |t| [norm(part.at(t))], ends[0], ends[1], ROUGH).value[0]
        };
        self.expected = intervals.iter().map(size).sum();
    }

    /// Sets the error that a step may have, from that of the angular momentum and of the velocity.
    pub fn allow(&mut self, body: &FlexibleBody, allowed: Allowed) {
        self.allowed = allowed_impulse(body, self.part.place(), allowed);
    }

    /// Adds a step.
    pub fn add(&mut self, rule: StepRule, stretch: Stretch) {
        let sum = rule.sum(|t| self.part.at(stretch.within(t)));
        self.seen = add(self.seen, sum);
        self.steps += 1;
    }

    /// Compares the steps over an interval with the quadrature. (Z4)
    pub fn compare(&mut self, from: f64, to: f64, stretch: Stretch) -> Option<Missed> {
        let part = self.part;
        let (exact, whole) = impulse(&|t| part.at(stretch.within(t)), &self.looks, [from, to]);
        self.gap = add(self.gap, add(self.seen, scale(-1.0, exact)));
        self.whole += whole;
        self.seen = [0.0; 3];
        let difference = norm(self.gap);
        let limit = SEEN * self.whole.max(self.expected) + self.allowed * self.steps as f64;
        let missed =
            Missed::Impulse { force: part.force, interval: [from, to], difference, whole: self.whole };
        (!(difference <= limit)).then_some(missed)
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        let Self { seen, gap, whole, steps, .. } = self;
        seen.iter().chain(gap).chain([whole]).for_each(|number| checkpoint.save(*number));
        checkpoint.save_count(*steps);
    }

    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let Self { seen, gap, whole, steps, .. } = self;
        for number in seen.iter_mut().chain(gap).chain([whole]) {
            *number = checkpoint.load()?;
        }
        *steps = checkpoint.load_count()?;
        Some(())
    }
}

/// Impulse of a force over an interval, and that whatever its direction; its largest value is looked for at the shares `looks` of the interval.
pub(super) fn impulse(
    force: &dyn Fn(f64) -> [f64; 3],
    looks: &[f64],
    [from, to]: [f64; 2],
) -> ([f64; 3], f64) {
    let sizes = looks.iter().map(|share| norm(force(from + share * (to - from))));
    // an integrand that does not change its sign, so that the error is not relative to what cancels
    let lift = 2.0 * sizes.fold(0.0, f64::max);
    let lifted = integral(&mut |t| force(t).map(|part| part + lift), from, to, ERROR).value;
    let [whole] = integral(&mut |t| [norm(force(t))], from, to, ROUGH).value;
    (lifted.map(|sum| sum - lift * (to - from)), whole)
}

#[cfg(test)]
mod tests {
    use super::super::prescribed::prescribed;
    use super::*;
    use crate::dynamics::external::Forced;
    use crate::model::force::{Axes, Force, ForceLaw, Wave};
    use crate::problems::ring_of_points;

    /// Steps of the two-point rule through a wave: as long as it, they take it for a constant torque, and it is told; a hundred times
    /// shorter they see it.
    #[test]
    fn steps_that_pass_a_wave_are_told() {
        let body = ring_of_points(2).body().unwrap();
        let wave = Wave { frequency: 2.0 * std::f64::consts::TAU, phase: -1.0 };
        let law = ForceLaw::Torque { torque: [0.1, -0.3, 0.2], axes: Axes::Body, wave };
        let forces = [Force { name: String::new(), law }];
        let system = Forced { body: &body, forces: &forces };
        let gauss = [0.5 - 0.5 / 3_f64.sqrt(), 0.5 + 0.5 / 3_f64.sqrt()];
        let nodes: &'static [f64] = Box::leak(Box::new(gauss));
        let [coarse, fine] = [0.5, 0.003].map(|h| {
            let mut account = Account::of(prescribed(system)[0]);
            account.allow(&body, Allowed { angular_momentum: 1e-12, velocity: 1e-12 });
            let end = 100.0 * h;
            for step in 0..100 {
                let rule = StepRule { t: f64::from(step) * h, h, nodes, weights: &[0.5, 0.5] };
                account.add(rule, Stretch::default());
            }
            account.compare(0.0, end, Stretch::default())
        });
        assert!(fine.is_none(), "{fine:?}");
        let Some(Missed::Impulse { force: 0, interval: [0.0, to], difference, whole }) = coarse else {
            panic!("{coarse:?}");
        };
        assert!((to - 50.0).abs() < 1e-9 && difference > 1e-3 * whole && whole > 1.0, "{coarse:?}");
    }
}
