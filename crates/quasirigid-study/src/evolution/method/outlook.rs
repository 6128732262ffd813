//! Outlook on long work: what will be done and how long it may take, said before it is done, and the end of work that nobody asked for.
//! Wall-clock time decides only whether there is an answer, never which.

use std::cell::{Cell, RefCell};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use quasirigid::averaging::RotationState;
use quasirigid::dynamics::PropagateError;
use quasirigid::secular::{follow_directly, micro_run_periods};
use quasirigid_math::vec3::norm;

use super::full::options;
use super::short_or_full::Choice;
use crate::error::StudyError;
use crate::evolution::reason::{Reason, Stop, Work};
use crate::evolution::refusals;
use crate::watch::Watch;
use crate::words::time;

/// Time after which work is said to be long; the longest expected that is begun without being asked for, and the longest that goes on: an
/// expectation may be several times off.
const PATIENCE: f64 = 1.0;
const BEGUN: f64 = 60.0;
const LONGEST: f64 = 600.0;

/// What is known of the work ahead, shared between the choice of the method and the observer of the work.
pub struct Outlook {
    start: Instant,
    /// Whether a method was asked for, which then may take as long as it takes.
    asked: bool,
    /// Sentence to be told at the next report, and whether any was told.
    sentence: RefCell<Option<String>>,
    told: Cell<bool>,
    /// Seconds of work that a period of the polhode takes in the full system, once measured.
    per_period: Cell<Option<f64>>,
}

impl Outlook {
    pub fn new(asked: bool) -> Self {
        Self {
            start: Instant::now(),
            asked,
            sentence: RefCell::new(None),
            told: Cell::new(false),
            per_period: Cell::new(None),
        }
    }

    /// Sentence that is due: a plan, or once that the work is long.
    fn due(&self) -> Option<String> {
        let long = || {
            let first = !self.told.get() && self.start.elapsed().as_secs_f64() > PATIENCE;
            first.then(|| "choosing the method of the evolution, by the modes, averages and short runs of the body; this may take a minute.".to_owned())
        };
        let sentence = self.sentence.take().or_else(long)?;
        self.told.set(true);
        Some(sentence)
    }

    /// Tells an observer the sentence that is due and the share that is done; ends work that is [over](Self::over).
    pub fn observe(&self, observer: &mut dyn Watch, share: f64) -> ControlFlow<()> {
        if let Some(sentence) = self.due() {
            observer.plan(&sentence);
        }
        if self.over() { ControlFlow::Break(()) } else { observer.at("following", share) }
    }

    /// Whether the work has taken longer than is done without being asked for.
    pub fn over(&self) -> bool {
        !self.asked && self.start.elapsed() > Duration::from_secs_f64(LONGEST)
    }

    /// Result of a choice; where it was interrupted because it is [over](Self::over), the refusal.
    pub fn judged<T>(&self, chosen: Result<T, Stop>) -> Result<T, Stop> {
        match chosen {
            Err(Stop::Failed(StudyError::Interrupted)) if self.over() => Err(Self::spent().into()),
            chosen => chosen,
        }
    }

    /// Reason why work that is [over](Self::over) has no answer.
    fn spent() -> Reason {
        Reason::Spent { seconds: LONGEST }
    }

    /// Announces work that takes so many seconds; the reason why it is not done, if it takes too long.
    pub fn allows(&self, work: Work, seconds: f64) -> Result<(), Reason> {
        if !self.asked && seconds + self.start.elapsed().as_secs_f64() > BEGUN {
            return Err(Reason::TooLong { work, seconds, most: BEGUN });
        }
        if seconds > PATIENCE {
            let sentence = format!("{}; this may take about {}.", refusals::work(work), time(seconds));
            self.sentence.replace(Some(sentence));
        }
        Ok(())
    }
}

impl Choice<'_> {
    /// Announces short runs; the reason why they are not done, if they take too long.
    pub fn announce_short_runs(&self, watch: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<(), Reason> {
        let Ok(per_period) = self.seconds_per_period(watch) else { return Ok(()) };
        let ends = self.way.ends;
        let modes = if ends[0].mode == ends[1].mode { &ends[..1] } else { &ends[..] };
        let periods: f64 = modes.iter().map(|stage| self.periods_of_runs(*stage)).sum();
        self.outlook.allows(Work::ShortRuns, per_period * periods)
    }

    fn periods_of_runs(&self, stage: RotationState) -> f64 {
        let period = self.ground.motion(stage).polhode_period();
        let pole = self.ground.poles.of_mode(stage.mode);
        micro_run_periods(pole.map_or(0.0, |pole| pole.settling_rate()), period)
    }

    /// Announces a history of the full system; the reason why it is not done, if it takes too long.
    pub fn announce_history(
        &self,
        revolutions: Option<f64>,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), Reason> {
        let Some(revolutions) = revolutions else { return Ok(()) };
        let stage = self.way.ends[0];
        let Ok(per_period) = self.seconds_per_period(watch) else { return Ok(()) };
        let turns = self.ground.motion(stage).polhode_period() * norm(self.way.start.omega) / TAU;
        self.outlook.allows(Work::History, per_period * revolutions / turns)
    }

    /// Seconds of work that a period of the polhode takes in the full system.
    ///
    /// # Errors
    /// [`PropagateError`], which the work itself says again.
    fn seconds_per_period(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<f64, PropagateError> {
        if let Some(known) = self.outlook.per_period.get() {
            return Ok(known);
        }
        let duration = self.ground.motion(self.way.ends[0]).polhode_period();
        let before = Instant::now();
        follow_directly(self.body, &self.way.start, &options(None, Some(duration)), watch)?;
        let seconds = before.elapsed().as_secs_f64();
        self.outlook.per_period.set(Some(seconds));
        Ok(seconds)
    }
}
