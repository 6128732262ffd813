//! Driver of a decision: tries its methods in order, and returns what the first one that holds found.

mod average;
mod full_system;
mod level_curves;
mod modal_rates;
mod short_runs;
mod spin_manifold;
mod stop;

use std::cell::OnceCell;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::case::Case;
use super::decision::{Decision, Last, Method};
use super::limits::Limits;
use super::reason::{Reason, Work};
use crate::averaging::{InterpolatedPower, LevelPassage, MeanPower, PowerSource};
use crate::secular::{
    AverageCriteria, DirectRow, DirectRun, ManifoldHistory, MeasuredPower, Places, SpotChecks,
};

pub use average::average_under_torque;
pub use full_system::{history_options, pace_of_work};
pub use level_curves::level_passage;
pub use stop::{ChoiceError, Stop, Tried};

/// Observer of an evolution that is followed.
pub trait ChoiceObserver {
    /// Receives now and then the share of the work that is done, and may end it.
    fn observe(&mut self, share: f64) -> ControlFlow<()>;

    /// Receives the wall-clock time (s) that work will take, about, before it begins.
    ///
    /// # Errors
    /// [`Reason`] why the work is not to be done.
    fn announce(&mut self, work: Work, seconds: f64) -> Result<(), Reason>;
}

/// Evolution that was followed, and the methods that were tried before.
#[derive(Clone, Debug)]
pub struct Followed {
    /// What the method found.
    pub outcome: Outcome,
    /// Estimate of the relative error of the time by the method; none where it was not judged.
    pub error: Option<f64>,
    /// Source of the average along the frozen polhode that was taken, or tried last.
    pub source: PowerSource,
    /// Methods that did not hold, each with the reason.
    pub tried: Tried,
}

/// What a method found: a power that is followed, or a history.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// Power of an average along the frozen polhode.
    Average {
        /// Power.
        power: Arc<dyn MeanPower>,
        /// Judgement on it.
        basis: AverageBasis,
    },
    /// Response in the spinning frame, whose power is averaged along the frozen polhode.
    SpinningFrame(Arc<InterpolatedPower>),
    /// Power of an average at the rates of the modes.
    ModalRates(Arc<dyn MeanPower>),
    /// History along level curves of the slow energy.
    LevelCurves(Box<LevelPassage>),
    /// History of the reduced equations about a spin.
    SpinManifold(Box<ManifoldHistory>),
    /// Power measured in the full system.
    Measured {
        /// Power.
        power: Box<MeasuredPower>,
        /// Row at which the full system has forgotten its start; none where that has settled.
        settled: Option<DirectRow>,
    },
    /// History of the full system.
    FullSystem(Box<DirectRun>),
}

/// Judgement on an average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AverageBasis {
    /// None: the body is stiff and slow, or turns in no way that may be judged.
    Stiff,
    /// Criteria that hold under a torque.
    UnderTorque,
    /// Criteria that hold.
    Criteria,
    /// Criteria that fail, of an average that was asked for.
    Fails(AverageCriteria),
}

impl Followed {
    /// Average along the frozen polhode.
    #[must_use]
    pub fn average(
        power: Arc<dyn MeanPower>,
        source: PowerSource,
        basis: AverageBasis,
        error: Option<f64>,
    ) -> Self {
        let outcome = Outcome::Average { power, basis };
        Self { outcome, error, source, tried: Vec::new() }
    }

    /// Method by which the evolution was followed.
    #[must_use]
    pub fn method(&self) -> Method {
        match &self.outcome {
            Outcome::Average { .. } => Method::Average(self.source),
            Outcome::SpinningFrame(_) => Method::SpinningFrame,
            Outcome::ModalRates(_) => Method::ModalRates,
            Outcome::LevelCurves(_) => Method::LevelCurves,
            Outcome::SpinManifold(_) => Method::SpinManifold,
            Outcome::Measured { power, .. } => match power.places {
                Places::PeriodicMotions => Method::PeriodicMotions,
                Places::ShortRuns => Method::MicroRuns,
            },
            Outcome::FullSystem(_) => Method::FullSystem,
        }
    }
}

/// Follows a case by the methods of a decision, in their order.
///
/// # Errors
/// [`Stop`] with the reason of the refusal, or of a failure of the work itself.
pub fn follow(
    case: &Case,
    decision: Decision,
    limits: &Limits,
    observer: &mut dyn ChoiceObserver,
) -> Result<Followed, Stop> {
    let asked = decision.asked;
    let driver = Driver { case, limits, asked, probes: OnceCell::new(), seconds_per_period: OnceCell::new() };
    let (found, tried) = try_in_order(decision, |method| driver.attempt(method, observer))?;
    let Found { outcome, error, source } = found;
    Ok(Followed { outcome, error, source: source.unwrap_or(driver.last_source(&tried)), tried })
}

/// Tries the methods of a decision in order: the first result, and the methods before it, each with the reason why it does not hold.
///
/// # Errors
/// [`Stop`] of the last method, or of one that must not be followed by another.
pub fn try_in_order<T, E>(
    Decision { trials, last, .. }: Decision,
    mut attempt: impl FnMut(Method) -> Result<T, Stop<E>>,
) -> Result<(T, Tried), Stop<E>> {
    let mut tried = Vec::new();
    for method in trials {
        match attempt(method) {
            Ok(found) => return Ok((found, tried)),
            Err(Stop::Refused { reason, .. }) if !matches!(reason, Reason::TooLong { .. }) => {
                tried.push((method, reason));
            }
            Err(stop) => return Err(stop.after(tried)),
        }
    }
    match last {
        Last::Refused(reason) => Err(Stop::from(reason).after(tried)),
        Last::Method(method) => match attempt(method) {
            Ok(found) => Ok((found, tried)),
            Err(stop) => Err(stop.after(tried)),
        },
    }
}

/// Result of one method.
struct Found {
    outcome: Outcome,
    error: Option<f64>,
    /// Source of an average.
    source: Option<PowerSource>,
}

/// Driver of a case, with what several methods need once it is known.
struct Driver<'a> {
    case: &'a Case<'a>,
    limits: &'a Limits,
    /// Whether the method was asked for.
    asked: bool,
    /// Short runs beside the averages; none where they are not wanted.
    probes: OnceCell<Option<SpotChecks>>,
    /// Seconds of work that a period of the polhode takes in the full system.
    seconds_per_period: OnceCell<f64>,
}

impl Driver<'_> {
    fn attempt(&self, method: Method, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        match method {
            Method::Average(source) => self.average(source, observer),
            Method::SpinningFrame => self.spinning_frame(observer),
            Method::ModalRates => Ok(self.modal_rates()?),
            Method::LevelCurves => Ok(self.level_curves()?),
            Method::SpinManifold => self.spin_manifold(observer),
            Method::PeriodicMotions | Method::MicroRuns if self.ends_unsettled() => {
                self.full_system(observer)
            }
            Method::PeriodicMotions => self.periodic_motions(observer),
            Method::MicroRuns => self.micro_runs(observer),
            Method::FullSystem => self.full_system(observer),
        }
    }

    /// Source of the average along the frozen polhode that was tried last; the first one where none was.
    fn last_source(&self, tried: &[(Method, Reason)]) -> PowerSource {
        let source = tried.iter().rev().find_map(|(method, _)| match method {
            Method::Average(source) => Some(*source),
            _ => None,
        });
        source.unwrap_or(self.case.powers.first)
    }
}
