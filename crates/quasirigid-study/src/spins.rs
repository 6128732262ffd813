//! Angular velocities from many starts at once: the reduced equations alone, without attitude and accounts.

use quasirigid::dynamics::{Options, Outcome, PropagateError, Rounding, SpinPath, Start, spin_paths};
use quasirigid::model::ReducedBody;
use quasirigid::reduction::Assessment;
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::histories::Doubts;
use crate::motion::Motion;
use crate::record::status;
use crate::settings::{PartialRun, RunSettings};
use crate::study::Study;
use crate::watch::Watch;

/// Angular velocity from one start.
#[derive(Clone, Debug)]
pub struct Spins {
    /// Angular velocities (rad/s, body axes) at the output times reached.
    pub omega: Vec<[f64; 3]>,
    /// Status at the end, in a word.
    pub status: &'static str,
    /// Status in a sentence.
    pub message: String,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
    /// Reason for which the numbers are not those of the body: the reduced equations do not hold at the start, or the effect of a liquid is
    /// not right.
    pub wrong: Option<String>,
}

impl Spins {
    /// Whether the angular velocities are those of the body to the end asked for.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.wrong.is_none() && self.status == "finished"
    }

    /// Reason for which they are not.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        let unfinished = (self.status != "finished").then_some(self.message.as_str());
        self.wrong.as_deref().or(unfinished)
    }
}

/// What the spins of many starts share.
#[derive(Debug)]
pub struct SpinPathPlan<'a> {
    study: &'a Study,
    assessment: Assessment<'a>,
    times: &'a [f64],
    options: Options,
}

impl Study {
    /// Prepares spins by the reduced equations at output times (s), with bits as fast as the processor allows or the same on every one.
    ///
    /// # Errors
    /// [`StudyError`] for a body that does not reduce, for forces, and for histories that end at an event: [`simulate`](Self::simulate) has
    /// both.
    pub fn spins<'a>(
        &'a self,
        times: &'a [f64],
        asked: &PartialRun,
        rounding: Rounding,
    ) -> Result<SpinPathPlan<'a>, StudyError> {
        self.left_alone("a list of spins")?;
        self.without_slugs("a list of spins")?;
        let options =
            Options { rounding, ..RunSettings::resolve(asked, self)?.options(self, [0.0, 0.0, 1.0])? };
        let free = !Motion::new(self, Start::new([0.0; 3], self.model.initial.attitude)).system().acts();
        if !free || !options.events.is_empty() {
            return Err(StudyError::SpinsAlone { forces: !free });
        }
        let assessment = Assessment::new(&self.body, &*self.reduced(self.order)?)?;
        Ok(SpinPathPlan { study: self, assessment, times, options })
    }
}

impl SpinPathPlan<'_> {
    /// Spins from each angular velocity (rad/s, body axes), in their order. They depend on their own start alone, whatever starts beside them.
    ///
    /// # Errors
    /// [`StudyError`] in place of the spins of a start that is none; [`StudyError::Interrupted`] for all when the watch ends the work.
    pub fn from(
        &self,
        starts: &[[f64; 3]],
        watch: &mut dyn Watch,
    ) -> Result<Vec<Result<Spins, StudyError>>, StudyError> {
        let Self { study, times, options, .. } = self;
        let reduced = study.reduced(study.order)?;
        let begun: Vec<_> = starts.iter().map(|omega| self.begin(&reduced, *omega)).collect();
        let settled: Vec<_> =
            begun.iter().filter_map(|begun| begun.as_ref().ok().map(|(omega, _)| *omega)).collect();
        let whole = settled.len().max(1) as f64;
        let mut goes_on = |ended: usize| watch.at("spins", ended as f64 / whole).is_continue();
        let mut paths = spin_paths(&reduced, &settled, times, options, &mut goes_on).into_iter();
        let found = begun.into_iter().map(|begun| {
            let (_, doubts) = begun?;
            let path = paths.next().expect("a path for each good start")?;
            Ok(self.spins(path, doubts))
        });
        let found: Vec<Result<Spins, StudyError>> = found.collect();
        let stopped = found.iter().flatten().any(|spins| spins.status == "interrupted");
        if stopped { Err(StudyError::Interrupted) } else { Ok(found) }
    }

    /// Spin at which the reduced equations start, and the doubts about them there.
    fn begin(&self, reduced: &ReducedBody, omega: [f64; 3]) -> Result<([f64; 3], Doubts), StudyError> {
        if !omega.iter().all(|rate| rate.is_finite()) || omega == [0.0; 3] {
            return Err(PropagateError::NoSpin { spin: norm(omega) }.into());
        }
        let motion = Motion::new(self.study, Start::new(omega, self.study.model.initial.attitude));
        let settled = motion.slaving(reduced, motion.settled_spin(reduced)?)?;
        Ok((settled, Doubts::judged(&motion, &self.assessment, settled)?))
    }

    fn spins(&self, SpinPath { omega, outcome, .. }: SpinPath, Doubts { remarks, wrong }: Doubts) -> Spins {
        let reached = match outcome {
            Outcome::Finished => self.times.last(),
            _ => omega.len().checked_sub(1).and_then(|last| self.times.get(last)),
        };
        let (status, message) = status(self.study, outcome, reached.copied().unwrap_or(0.0));
        Spins { omega, status, message, notes: remarks, wrong }
    }
}
