//! Sliding: a force by the motion that turns back at once whatever switches it, so that it switches in every step, in ever shorter ones.
//! The motion has a limit, Filippov's `[@filippov1988]`, in which the force has a value between the two; steps do not reach it.
//! Equation (Z7), docs/theory/19-events.md.

use crate::math::ode::{Checkpoint, StepRule};

/// Steps that are judged together, and the least share of them with a switch inside.
const STEPS: u64 = 50;
const LEAST_SHARE: f64 = 0.2;
/// Mean step, relative to the longest without a switch and to the run, below which switches have shortened the steps.
const SHORT: f64 = 1e-2;
const SHORT_OF_RUN: f64 = 1e-8;
/// Part at either end of a step in which a switch counts as one at that end.
const AT_END: f64 = 0.01;

/// Steps of a force that may slide.
#[derive(Clone, Debug, Default)]
pub(super) struct Sliding {
    /// Longest step without a switch (s).
    longest: f64,
    /// Steps that are judged next, how many of them switch, and their time (s).
    steps: u64,
    switches: u64,
    time: f64,
}

impl Sliding {
    /// Takes up a step with these corners and jumps of the force, in a run to a time `end` (s); of a body that slides the mean step (s). (Z7)
    pub fn step(&mut self, rule: StepRule, breaks: &[f64], end: f64) -> Option<f64> {
        let inside = |t: &f64| ((t - rule.t) / rule.h - 0.5).abs() < 0.5 - AT_END;
        if breaks.iter().any(inside) {
            self.switches += 1;
        } else {
            self.longest = self.longest.max(rule.h);
        }
        self.steps += 1;
        self.time += rule.h;
        if self.steps < STEPS {
            return None;
        }
        let Self { longest, steps, switches, time } = *self;
        *self = Self { longest, ..Self::default() };
        let step = time / steps as f64;
        let slides = switches as f64 >= LEAST_SHARE * steps as f64
            && (step < SHORT * longest || step < SHORT_OF_RUN * end);
        slides.then_some(step)
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        let Self { longest, steps, switches, time } = self;
        [longest, time].into_iter().for_each(|number| checkpoint.save(*number));
        [steps, switches].into_iter().for_each(|count| checkpoint.save_count(*count));
    }

    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let Self { longest, steps, switches, time } = self;
        for number in [longest, time] {
            *number = checkpoint.load()?;
        }
        for count in [steps, switches] {
            *count = checkpoint.load_count()?;
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 1 s, then many of a length with a switch at this share of each.
    fn followed(length: f64, share: f64) -> Option<f64> {
        let mut sliding = Sliding::default();
        let mut t = 0.0;
        let rule = |t: f64, h: f64| StepRule { t, h, nodes: &[0.5], weights: &[1.0] };
        for _ in 0..50 {
            assert_eq!(sliding.step(rule(t, 1.0), &[], 1e3), None);
            t += 1.0;
        }
        (0..400).find_map(|_| {
            let found = sliding.step(rule(t, length), &[t + share * length], 1e3);
            t += length;
            found
        })
    }

    /// Switches inside short steps are sliding; those that steps end at, and those that shorten no step, are not.
    #[test]
    fn switches_that_shorten_every_step_are_sliding() {
        let step = followed(1e-4, 0.3).unwrap();
        assert!((step / 1e-4 - 1.0).abs() < 1e-9, "{step}");
        assert_eq!(followed(1e-4, 1.0), None);
        assert_eq!(followed(0.9, 0.3), None);
    }
}
