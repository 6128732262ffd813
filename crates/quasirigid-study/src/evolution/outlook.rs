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
}

impl<'w> Outlook<'w> {
    pub fn new(watch: &'w mut dyn Watch, asked: bool) -> Self {
        Self { watch, start: Stopwatch::start(), asked, sentence: None, told: false }
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

impl ChoiceObserver for Outlook<'_> {
    fn observe(&mut self, share: f64) -> ControlFlow<()> {
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
        if seconds > PATIENCE {
            let work = refusals::work(work);
            self.sentence = Some(format!("{work}; this may take about {}.", time(seconds)));
        }
        Ok(())
    }
}
