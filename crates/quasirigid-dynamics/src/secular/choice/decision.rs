//! Decision on the methods of an evolution: a pure function of the criteria, which does no work and reads no clock.

use super::criteria::Criteria;
use super::limits::Limits;
use super::reason::Reason;
use crate::averaging::PowerSource;

/// Method of a secular evolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// Average along the polhode of the frozen body. (A6), (G7)
    Average(PowerSource),
    /// Average along that polhode of the response in the spinning frame. (H5)
    SpinningFrame,
    /// Average at the rates that the modes about the steady spins have. (Q5)
    ModalRates,
    /// Average along level curves of the slow energy.
    LevelCurves,
    /// Reduced equations about a spin from start to end. (Q10)
    SpinManifold,
    /// Mean power of periodic motions of the full system. (Q19)
    PeriodicMotions,
    /// Mean power measured by short runs of the full system. (Q4)
    MicroRuns,
    /// Full system from start to end. (Q6)
    FullSystem,
}

/// Decision: methods in the order in which they are tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// Methods of which the next one runs where one does not hold; work that would take too long ends the evolution instead.
    pub trials: Vec<Method>,
    /// End of the trials, where none of them holds.
    pub last: Last,
    /// Whether the last method was asked for: it takes as long as it takes, and an average is given even where it does not hold.
    pub asked: bool,
}

/// End of the trials of a decision.
#[derive(Clone, Debug, PartialEq)]
pub enum Last {
    /// Method whose own reason is that of a refusal.
    Method(Method),
    /// Refusal.
    Refused(Reason),
}

impl Decision {
    /// Refusal without a trial.
    #[must_use]
    pub fn refused(reason: Reason) -> Self {
        Self { trials: Vec::new(), last: Last::Refused(reason), asked: false }
    }

    /// Method that was asked for.
    #[must_use]
    pub fn asked(method: Method) -> Self {
        Self { trials: Vec::new(), last: Last::Method(method), asked: true }
    }

    /// Methods that are tried in order, unasked.
    #[must_use]
    pub fn unasked(trials: Vec<Method>, last: Method) -> Self {
        Self { trials, last: Last::Method(last), asked: false }
    }
}

/// Decides which methods are tried for a body without momentum wheels, on which no torque acts. (Q7)
#[must_use]
pub fn choose(criteria: &Criteria, asked: Option<Method>, limits: &Limits) -> Decision {
    if !criteria.unknown_liquids.is_empty() {
        return Decision::refused(Reason::UnknownLiquidResponse(criteria.unknown_liquids.clone()));
    }
    let complete = criteria.left_out <= limits.losses_left_out;
    match asked {
        Some(Method::SpinManifold | Method::PeriodicMotions | Method::MicroRuns | Method::FullSystem)
            if !complete =>
        {
            Decision::refused(Reason::LossesLeftOut { share: criteria.left_out })
        }
        Some(Method::LevelCurves) if !criteria.has_level_curves(limits) => {
            Decision::refused(Reason::NotOnLevels)
        }
        Some(method) => Decision::asked(method),
        None => {
            let mut trials = Vec::new();
            if complete
                && criteria.level_equations
                && criteria.equal_moments
                && criteria.has_level_curves(limits)
            {
                trials.push(Method::LevelCurves); // beside a plane of steady spins loads nearly cancel, and averages are off
            }
            trials.extend(averages(criteria));
            let last = behind_averages(criteria, complete, limits, &mut trials);
            Decision { trials, last, asked: false }
        }
    }
}

/// Averages along the frozen polhode; none where a vibration grows, which no average knows of.
fn averages(criteria: &Criteria) -> Vec<Method> {
    if criteria.parametric.is_some() {
        return Vec::new();
    }
    let mut averages = vec![Method::Average(criteria.first_power)];
    if !criteria.power_asked {
        if criteria.first_power == PowerSource::Polynomial {
            averages.push(Method::Average(PowerSource::Harmonics));
        }
        if criteria.spinning_frame {
            averages.push(Method::SpinningFrame);
        }
    }
    averages
}

/// Methods where no average along the frozen polhode holds: the last one, with those before it added to the trials.
fn behind_averages(criteria: &Criteria, complete: bool, limits: &Limits, trials: &mut Vec<Method>) -> Last {
    if criteria.level_equations && criteria.suits_level_curves(limits) {
        return Last::Method(Method::LevelCurves);
    }
    if !complete {
        return Last::Method(Method::ModalRates);
    }
    if !criteria.between_axes && criteria.coordinates <= limits.coordinates_of_manifold {
        trials.push(Method::SpinManifold);
    }
    let no_mean = criteria.decay_per_period > limits.decay_per_period || criteria.internal_growth;
    match criteria.revolutions {
        _ if no_mean => Last::Method(Method::FullSystem),
        Some(revolutions) if revolutions <= limits.few_revolutions => Last::Method(Method::FullSystem),
        None => Last::Refused(Reason::UnknownLength),
        Some(revolutions) => {
            if criteria.coordinates <= limits.coordinates_of_periodic_motions {
                trials.push(Method::PeriodicMotions);
            }
            if revolutions > limits.many_revolutions {
                return Last::Method(Method::MicroRuns);
            }
            trials.push(Method::MicroRuns);
            Last::Method(Method::FullSystem)
        }
    }
}
