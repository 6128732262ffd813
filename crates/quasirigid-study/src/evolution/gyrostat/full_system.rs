//! The full system until its wobble is small, through a separatrix where there is one, and the modes from there on.

use std::f64::consts::TAU;
use std::time::Instant;

use quasirigid::dynamics::FullState;
use quasirigid::secular::{DirectRow, DirectRun, DirectStopReason, follow_directly};

use super::answer::{Answer, BEHIND};
use super::ground::Ground;
use super::roads::{Found, Watch};
use crate::error::StudyError;
use crate::evolution::method::{Outlook, options};
use crate::evolution::reason::{Reason, Stop, Work};
use crate::settings::EvolveSettings;

/// Share of the energy of the separatrix above the steady spin by which it is passed before the way behind it is told.
const BELOW: f64 = 1e-3;
/// Error of the time through a separatrix, beside which two integrations part.
const PARTED: f64 = 1e-2;

/// The full system until its wobble is small, and the modes from there on.
pub fn direct(
    ground: &Ground,
    full: &FullState,
    goal: Option<f64>,
    asked: &EvolveSettings,
    outlook: &Outlook,
    watch: Watch<'_>,
) -> Found {
    let until = ground.until(goal);
    announced(ground, full, until, asked, outlook, watch)?;
    let through = if ground.settled() { until } else { until.max(ground.beyond()) };
    let first = followed(ground, full, through, asked.duration, watch)?;
    if through <= until || first.ending == DirectStopReason::Finished {
        return Ok(ground.with_tail(first, goal, asked));
    }
    behind(ground, first, asked, watch)
}

/// The full system behind a separatrix, where it circles the steady spin that it came to.
fn behind(ground: &Ground, first: DirectRun, asked: &EvolveSettings, watch: Watch<'_>) -> Found {
    let end = first.rows[first.rows.len() - 1];
    let below = Ground::of(ground.study, &first.last)?;
    let goal = below.goal_from(ground.energy, asked);
    let left = asked.duration.map(|duration| duration - end.t);
    let whole = if goal.is_some_and(|goal| goal >= end.energy) {
        first
    } else {
        let second = followed(&below, &first.last, below.until(goal), left, watch)?;
        joined(first, second)
    };
    let mut answer = below.with_tail(whole, goal, asked);
    answer.verdict.error = answer.verdict.error.map(|error| error.max(PARTED));
    Ok(Answer { crossed: Some(end.t), ..answer })
}

/// The full system to an energy.
fn followed(
    ground: &Ground,
    full: &FullState,
    until: f64,
    duration: Option<f64>,
    watch: Watch<'_>,
) -> Result<DirectRun, Stop> {
    let run = follow_directly(ground.body, full, &options(Some(until), duration), watch)?;
    let t = run.rows[run.rows.len() - 1].t;
    match run.ending {
        DirectStopReason::Reached | DirectStopReason::Finished => Ok(run),
        DirectStopReason::Interrupted => Err(StudyError::Interrupted.into()),
        DirectStopReason::Failed { reason } => {
            Err(Reason::UnfinishedWithWheels { t, failure: Some(reason) }.into())
        }
        DirectStopReason::TurnLimit | DirectStopReason::StepLimit => {
            Err(Reason::UnfinishedWithWheels { t, failure: None }.into())
        }
    }
}

/// Announces a history of the full system; the reason why it is not followed, if it takes too long.
fn announced(
    ground: &Ground,
    full: &FullState,
    until: f64,
    asked: &EvolveSettings,
    outlook: &Outlook,
    watch: Watch<'_>,
) -> Result<(), Stop> {
    let Some(mode) = ground.nutation().filter(|mode| mode.decay_rate > 0.0 && mode.frequency > 0.0) else {
        return Err(Reason::UnknownDuration.into());
    };
    let share = (ground.energy - ground.steady()) / (until - ground.steady());
    let falls = share.ln() / (2.0 * mode.decay_rate);
    let length = asked.duration.map_or(falls, |duration| duration.min(falls));
    let period = (TAU / mode.frequency).min(length);
    let before = Instant::now();
    let run = follow_directly(ground.body, full, &options(None, Some(period)), watch)?;
    if run.ending == DirectStopReason::Interrupted {
        return Err(StudyError::Interrupted.into());
    }
    let seconds = before.elapsed().as_secs_f64() * length / period;
    Ok(outlook.allows(Work::History, seconds)?)
}

/// Two runs one behind the other.
fn joined(mut first: DirectRun, second: DirectRun) -> DirectRun {
    let end = first.rows[first.rows.len() - 1];
    first.rows.extend(second.rows[1..].iter().map(|row| DirectRow {
        t: end.t + row.t,
        energy: row.energy,
        dissipated: end.dissipated + row.dissipated,
        revolutions: end.revolutions + row.revolutions,
    }));
    first.budget.iter_mut().zip(&second.budget).for_each(|(sum, part)| *sum += part);
    DirectRun {
        ending: second.ending,
        last: second.last,
        energy_drift: first.energy_drift + second.energy_drift,
        steps: first.steps + second.steps,
        ..first
    }
}

impl Ground<'_> {
    /// Energy (J) down to which the full system is followed to a goal: where the modes take over, or the goal.
    fn until(&self, goal: Option<f64>) -> f64 {
        let behind = self.wobble.energy_of(BEHIND);
        goal.map_or(behind, |goal| goal.max(behind))
    }

    /// Energy (J) just below the separatrix.
    fn beyond(&self) -> f64 {
        self.barrier - BELOW * (self.barrier - self.steady())
    }
}
