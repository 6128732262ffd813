//! Impulse of a prescribed force: what the steps have summed up, against a quadrature that knows nothing of them. (Z4), (Z8)

use super::prescribed::Prescribed;
use super::{Allowed, Missed, allowed_impulse, impulse_per_radian};
use crate::math::ode::{Checkpoint, StepRule, Stretch};
use crate::math::quadrature::{gauss_lobatto, integral};
use crate::math::vec3::{add, norm, scale};
use crate::model::FlexibleBody;

/// Difference, relative to the impulse of the force whatever its direction, above which it was not seen.
pub(super) const SEEN: f64 = 1e-6;
/// Rotation (rad) by an impulse that was not seen, or way beside the radius of gyration, above which it matters on the way. (Z8)
const TURNED: f64 = 1e-6;
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
    /// `∫ gap dt` above the limit of the gap in all intervals before.
    acted: f64,
    /// Interval in which the gap passed its limit, as long as it is above it.
    suspect: Option<[f64; 2]>,
    steps: u64,
    /// Error that a step may have.
    allowed: f64,
    /// Impulse whose rate is one radian per second, or one radius of gyration.
    per_radian: f64,
    /// Places in an interval, as shares of it, at which its largest value is looked for.
    looks: Vec<f64>,
}

impl<'a> Account<'a> {
    pub fn of(part: Prescribed<'a>) -> Self {
        let looks = gauss_lobatto(INTERVAL_SAMPLES).into_iter().map(|[x, _]| 0.5 * (x + 1.0)).collect();
        let (whole, acted, allowed, per_radian) = (0.0, 0.0, 0.0, f64::INFINITY);
        let (seen, gap, suspect, steps) = ([0.0; 3], [0.0; 3], None, 0);
        Self { part, seen, gap, whole, acted, suspect, steps, allowed, per_radian, looks }
    }

    /// Sets the error that a step may have, from that of the angular momentum and of the velocity.
    pub fn allow(&mut self, body: &FlexibleBody, allowed: Allowed) {
        self.allowed = allowed_impulse(body, self.part.place(), allowed);
        self.per_radian = impulse_per_radian(body, self.part.place());
    }

    /// Adds a step.
    pub fn add(&mut self, rule: StepRule, stretch: Stretch) {
        let sum = rule.sum(|t| self.part.at(stretch.within(t)));
        self.seen = add(self.seen, sum);
        self.steps += 1;
    }

    /// Compares the steps over an interval with the quadrature: a gap above its limit counts by what it turns the body, and at the end of the
    /// run by itself. (Z4), (Z8)
    pub fn compare(&mut self, [from, to]: [f64; 2], stretch: Stretch, ends: bool) -> Option<Missed> {
        let part = self.part;
        self.acted += self.excess().max(0.0) * (to - from);
        let (exact, whole) = impulse(&|t| part.at(stretch.within(t)), &self.looks, [from, to]);
        self.gap = add(self.gap, add(self.seen, scale(-1.0, exact)));
        self.whole += whole;
        self.seen = [0.0; 3];
        self.suspect = if self.excess() <= 0.0 { None } else { self.suspect.or(Some([from, to])) };
        let matters =
            ends || !(self.acted <= TURNED * self.per_radian) || self.gap.iter().any(|x| x.is_nan());
        self.suspect.filter(|_| matters).map(|interval| Missed::Impulse {
            force: part.force,
            interval,
            difference: norm(self.gap),
            whole: self.whole,
        })
    }

    /// The gap less its limit. (Z4)
    fn excess(&self) -> f64 {
        norm(self.gap) - SEEN * self.whole - self.allowed * self.steps as f64
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        let Self { seen, gap, whole, acted, suspect, steps, .. } = self;
        let [from, to] = suspect.unwrap_or([f64::NAN; 2]);
        seen.iter().chain(gap).chain([whole, acted, &from, &to]).for_each(|number| checkpoint.save(*number));
        checkpoint.save_count(*steps);
    }

    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let Self { seen, gap, whole, acted, suspect, steps, .. } = self;
        let mut interval = [0.0; 2];
        for number in seen.iter_mut().chain(gap).chain([whole, acted]).chain(&mut interval) {
            *number = checkpoint.load()?;
        }
        *suspect = (!interval[0].is_nan()).then_some(interval);
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
    use crate::math::expression::Expression;
    use crate::model::force::{Axes, Force, ForceLaw, Wave};
    use crate::problems::ring_of_points;

    const NAMES: [&str; 14] =
        ["x", "y", "z", "vx", "vy", "vz", "t", "wx", "wy", "wz", "qw", "qx", "qy", "qz"];

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
            account.compare([0.0, end], Stretch::default(), true)
        });
        assert!(fine.is_none(), "{fine:?}");
        let Some(Missed::Impulse { force: 0, interval: [0.0, to], difference, whole }) = coarse else {
            panic!("{coarse:?}");
        };
        assert!((to - 50.0).abs() < 1e-9 && difference > 1e-3 * whole && whole > 1.0, "{coarse:?}");
    }

    /// Two pulses, of which the steps see the second alone: the first is told where it turns the body before the second, and where it is more
    /// than a millionth of both; as the foot of the second it means nothing. (Z8)
    #[test]
    fn an_unseen_pulse_counts_by_what_it_turns() {
        let body = ring_of_points(2).body().unwrap();
        let [xx, yy, zz, ..] = body.invariants().J;
        let trace = xx + yy + zz;
        let told = |first: f64, second: f64, pause: f64| {
            let formula =
                format!("{}*exp(-(t-10)^2) + {}*exp(-(t-{})^2)", first * trace, second * trace, 30.0 + pause);
            let torque = [formula.as_str(), "0", "0"].map(|text| Expression::parse(text, &NAMES).unwrap());
            let law = ForceLaw::TorqueExpression { torque, axes: Axes::Body };
            let forces = [Force { name: String::new(), law }];
            let mut account = Account::of(prescribed(Forced { body: &body, forces: &forces })[0]);
            account.allow(&body, Allowed { angular_momentum: 1e-16 * trace, velocity: 1e-16 });
            let (nodes, weights): (&[f64], &[f64]) = (&[0.5], &[1.0]);
            let ends = [0.0, 20.0, 20.0 + pause, 40.0 + pause];
            ends.array_windows().enumerate().find_map(|(i, [from, to])| {
                let h = (to - from) / 4000.0;
                for step in (0..4000).filter(|_| i == 2) {
                    account.add(
                        StepRule { t: from + f64::from(step) * h, h, nodes, weights },
                        Stretch::default(),
                    );
                }
                account.compare([*from, *to], Stretch::default(), i == 2)
            })
        };
        assert!(matches!(told(1e-4, 1e3, 50.0), Some(Missed::Impulse { interval: [0.0, 20.0], .. })));
        for [first, second, pause] in [[1e-9, 1.0, 1e3], [1e-9, 1e-4, 1.0], [1e-9, 0.0, 1.0]] {
            assert!(told(first, second, pause).is_some(), "{first} {second} {pause}");
        }
        assert_eq!(told(1e-9, 1.0, 1.0), None);
    }
}
