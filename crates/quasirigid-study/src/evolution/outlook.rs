//! Outlook on long work: what will be done and how long it may take, said before it is done, and the end of work that nobody asked for.
//! The time of work decides only whether there is an answer, never which.

use std::ops::ControlFlow;

use quasirigid::secular::choice::{self, ChoiceObserver, Stop, Work};

use quasirigid_math::stopwatch::Stopwatch;

use super::reason::Reason;
use super::refusals;
use crate::error::StudyError;
use crate::watch::Watch;
use crate::words::time;

/// Time after which work is said to be long; the longest expected that is begun without being asked for, and the longest that goes on: an
/// expectation may be several times off.
const PATIENCE: f64 = 1.0;
const BEGUN: f64 = 60.0;
const LONGEST: f64 = 600.0;

/// Observer of an evolution that tells a user's watch what will be done, and ends what nobody asked for when it has taken too long.
pub struct Outlook<'w> {
    watch: &'w mut dyn Watch,
    start: Stopwatch,
    /// Whether a method was asked for, which then may take as long as it takes.
    asked: bool,
    /// Sentence to be told at the next report, and whether any was told.
    sentence: Option<String>,
    told: bool,
    /// Times (s) at which the stage of work that goes on was begun, and that it was said to take.
    begun: f64,
    expected: f64,
    /// Share of the stage that was done at the last report.
    done: f64,
}

/// Share of work from which its pace tells how long the rest takes, and how many times longer than was said is told.
const TELLING: f64 = 0.1;
const LONGER: f64 = 3.0;

impl<'w> Outlook<'w> {
    pub fn new(watch: &'w mut dyn Watch, asked: bool) -> Self {
        Self {
            watch,
            start: Stopwatch::start(),
            asked,
            sentence: None,
            told: false,
            begun: 0.0,
            expected: 0.0,
            done: 0.0,
        }
    }

    /// Sentence that is due: a plan, or once that the work is long.
    fn due(&mut self) -> Option<String> {
        let long = || {
            let first = !self.told && self.start.waited() > PATIENCE;
            first.then(|| "choosing the method of the evolution, by the modes, averages and short runs of the body; this may take a minute.".to_owned())
        };
        let sentence = self.sentence.take().or_else(long)?;
        self.told = true;
        Some(sentence)
    }

    /// Corrects what was said of the work that goes on, by its pace up to a share of it.
    fn correct(&mut self, share: f64) {
        let now = self.start.waited();
        if share < self.done {
            self.begun = now;
        }
        self.done = share;
        if let Some(whole) = longer(self.expected, now - self.begun, share) {
            self.expected = whole;
            self.sentence = Some(format!("this takes longer, about {}.", time(whole)));
        }
    }

    /// Whether the work has taken longer than is done without being asked for.
    fn over(&self) -> bool {
        !self.asked && self.start.seconds() > LONGEST
    }

    /// Reason of an end of the choice; of one that was interrupted because it took too long, that reason.
    ///
    /// # Errors
    /// The [`StudyError`] of work that failed.
    pub fn reason(&self, stop: Stop<StudyError>) -> Result<Reason, StudyError> {
        match stop {
            Stop::Failed(StudyError::Interrupted) if self.over() => Ok(Reason::Spent { seconds: LONGEST }),
            stop => Reason::of(stop),
        }
    }
}

/// Time (s) that a stage takes by its pace, where it is much longer than was said: after a time (s) in which a share was done.
fn longer(expected: f64, spent: f64, share: f64) -> Option<f64> {
    let whole = spent / share;
    (expected > 0.0 && share > TELLING && whole > LONGER * expected.max(PATIENCE)).then_some(whole)
}

impl ChoiceObserver for Outlook<'_> {
    fn observe(&mut self, share: f64) -> ControlFlow<()> {
        self.correct(share);
        if let Some(sentence) = self.due() {
            self.watch.plan(&sentence);
        }
        if self.over() { ControlFlow::Break(()) } else { self.watch.at("following", share) }
    }

    fn announce(&mut self, work: Work, seconds: f64) -> Result<(), choice::Reason> {
        let spent = self.start.seconds();
        if !self.asked && seconds + spent > BEGUN {
            return Err(choice::Reason::TooLong { work, seconds, spent, most: BEGUN });
        }
        (self.begun, self.expected) = (self.start.waited(), seconds);
        if seconds > PATIENCE {
            let work = refusals::work(work);
            self.sentence = Some(format!("{work}; this may take about {}.", time(seconds)));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::longer;

    #[test]
    fn long_work_corrects_what_was_said() {
        assert_eq!(longer(8.0, 10.0, 0.25), Some(40.0));
        assert_eq!(longer(8.0, 10.0, 0.5), None, "not three times as long");
        assert_eq!(longer(8.0, 10.0, 0.05), None, "too early to tell");
        assert_eq!(longer(0.0, 10.0, 0.25), None, "nothing was said");
    }
}
