//! Age of the Jacobian in an implicit method: when a linear part that changes with the state is evaluated again.
//! An evaluation costs far more than a sweep, an old part more sweeps and shorter steps; the period adapts to the slowing of the iteration.
//! The linear part of the full system is (T4), docs/theory/08-full-system.md.

use super::Checkpoint;

/// Age of a stiff linear part that changes with the state: the part is evaluated again when the iteration of the stages slows, or has
/// slowed at that age before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Age {
    /// Steps since the last evaluation; none before the first.
    pub steps: Option<u32>,
    /// Steps after the first during which the part is used.
    lasts: u32,
    /// Ratio of corrections over the step (1/s) when the part was new.
    pace: f64,
}

/// Growth of the pace above which the part is too old, and below which it is used for longer.
const AGED: f64 = 1.5;
const FRESH: f64 = 1.1;

impl Age {
    /// Saves the age.
    pub fn save(self, checkpoint: &mut Checkpoint) {
        checkpoint.save_count(self.steps.map_or(0, |steps| u64::from(steps) + 1));
        checkpoint.save_count(self.lasts.into());
        checkpoint.save(self.pace);
    }

    /// Loads a saved age.
    pub fn load(checkpoint: &mut Checkpoint) -> Option<Self> {
        let steps = checkpoint.load_count()?.checked_sub(1).map(|steps| u32::try_from(steps).ok());
        let lasts = u32::try_from(checkpoint.load_count()?).ok()?;
        Some(Self { steps: steps.flatten(), lasts, pace: checkpoint.load()? })
    }

    /// Whether the part is to be evaluated again.
    pub fn is_due(self) -> bool {
        self.steps.is_none_or(|steps| steps > self.lasts)
    }

    /// After stages that were not found: whether the age may be the cause; the part is then due.
    pub fn is_to_blame(&mut self) -> bool {
        let Some(steps @ 1..) = self.steps else { return false };
        (self.steps, self.lasts) = (None, steps / 2);
        true
    }

    /// After a step with this ratio of corrections over the step (1/s): whether the age has slowed the iteration where that limits the next
    /// step.
    pub fn shows(&mut self, pace: f64, limits: bool) -> bool {
        let steps = self.steps.unwrap_or_default();
        if steps == 0 {
            self.pace = pace;
        }
        let aged = limits && pace > AGED * self.pace;
        if aged {
            self.lasts = steps;
        } else if steps == self.lasts && (steps > 0 && pace < FRESH * self.pace || !limits) {
            self.lasts = 2 * steps + 1;
        }
        aged
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(steps: u32) -> Age {
        let mut age = Age { steps: Some(0), lasts: 8, pace: 0.0 };
        age.shows(1.0, true);
        age.steps = Some(steps);
        age
    }

    #[test]
    fn it_is_due_at_first_and_once_it_slows_the_iteration() {
        assert!(Age::default().is_due());
        let mut age = after(3);
        assert!(!age.is_due() && !age.shows(1.4, true) && !age.is_due());
        assert!(age.shows(1.6, true));
        age.steps = Some(4);
        assert!(age.is_due());
    }

    #[test]
    fn what_does_not_limit_the_step_shows_no_age() {
        let mut age = after(3);
        assert!(!age.shows(100.0, false) && !age.is_due());
    }

    #[test]
    fn a_new_part_is_not_to_blame_and_an_old_one_lasts_half_as_long_from_then_on() {
        assert!(!after(0).is_to_blame());
        let mut age = after(5);
        assert!(age.is_to_blame() && age.is_due());
        age.steps = Some(2);
        assert!(!age.is_due());
        age.steps = Some(3);
        assert!(age.is_due());
    }
}
