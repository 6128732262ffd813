//! The full system until its wobble is small, through a separatrix where there is one, and the modes from there on.

use std::f64::consts::TAU;
use std::time::Instant;

use quasirigid::dynamics::FullState;
use quasirigid::secular::{DirectRow, DirectRun, DirectStopReason, follow_directly};

use super::answer::{Answer, BEHIND};
use super::ground::Ground;
use super::roads::{Found, Watch};
use crate::error::StudyError;
use crate::evolution::Asked;
use crate::evolution::method::{Outlook, options};
use crate::words::time;

/// Share of the energy of the separatrix above the steady spin by which it is passed before the way behind it is told.
const BELOW: f64 = 1e-3;
/// Error of the time through a separatrix, beside which two integrations part.
const PARTED: f64 = 1e-2;

/// The full system until its wobble is small, and the modes from there on.
pub fn direct(
    ground: &Ground,
    full: &FullState,
    goal: Option<f64>,
    asked: &Asked,
    outlook: &Outlook,
    watch: Watch<'_>,
) -> Found {
    let until = ground.until(goal);
    if let Err(long) = announced(ground, full, until, asked, outlook, watch)? {
        return Ok(Err(long));
    }
    let through = if ground.settled() { until } else { until.max(ground.beyond()) };
    let first = match followed(ground, full, through, asked.duration, watch)? {
        Ok(run) => run,
        Err(why) => return Ok(Err(why)),
    };
    if through <= until || first.ending == DirectStopReason::Finished {
        return Ok(Ok(ground.with_tail(first, goal, asked)));
    }
    behind(ground, first, asked, watch)
}

/// The full system behind a separatrix, where it circles the steady spin that it came to.
fn behind(ground: &Ground, first: DirectRun, asked: &Asked, watch: Watch<'_>) -> Found {
    let end = first.rows[first.rows.len() - 1];
    let below = match Ground::of(ground.study, &first.last)? {
        Ok(below) => below,
        Err(why) => return Ok(Err(why)),
    };
    let goal = below.goal_from(ground.energy, asked);
    let left = asked.duration.map(|duration| duration - end.t);
    let second = if goal.is_some_and(|goal| goal >= end.energy) {
        Ok(first.clone())
    } else {
        let second = followed(&below, &first.last, below.until(goal), left, watch)?;
        second.map(|second| joined(first, second))
    };
    Ok(second.map(|whole| {
        let mut answer = below.with_tail(whole, goal, asked);
        answer.verdict.error = answer.verdict.error.map(|error| error.max(PARTED));
        Answer { crossed: Some(end.t), ..answer }
    }))
}

/// The full system to an energy.
fn followed(
    ground: &Ground,
    full: &FullState,
    until: f64,
    duration: Option<f64>,
    watch: Watch<'_>,
) -> Result<Result<DirectRun, String>, StudyError> {
    let run = follow_directly(ground.body, full, &options(Some(until), duration), watch)?;
    let end = run.rows[run.rows.len() - 1];
    Ok(match &run.ending {
        DirectStopReason::Reached | DirectStopReason::Finished => Ok(run),
        DirectStopReason::Interrupted => return Err(StudyError::Interrupted),
        DirectStopReason::Failed { reason } => {
            Err(format!("the full system was followed for {} and did not get there: {reason}", time(end.t)))
        }
        _ => Err(format!("the full system was followed for {} and did not get there", time(end.t))),
    })
}

/// Announces a history of the full system; the reason why it is not followed, if it takes too long.
fn announced(
    ground: &Ground,
    full: &FullState,
    until: f64,
    asked: &Asked,
    outlook: &Outlook,
    watch: Watch<'_>,
) -> Result<Result<(), String>, StudyError> {
    let Some(mode) = ground.nutation().filter(|mode| mode.decay_rate > 0.0 && mode.frequency > 0.0) else {
        return Ok(Err("the modes give a small wobble no rate, so that nothing says how far the full system would have to be followed".into()));
    };
    let share = (ground.energy - ground.steady()) / (until - ground.steady());
    let falls = share.ln() / (2.0 * mode.decay_rate);
    let length = asked.duration.map_or(falls, |duration| duration.min(falls));
    let period = (TAU / mode.frequency).min(length);
    let before = Instant::now();
    let run = follow_directly(ground.body, full, &options(None, Some(period)), watch)?;
    if run.ending == DirectStopReason::Interrupted {
        return Err(StudyError::Interrupted);
    }
    let seconds = before.elapsed().as_secs_f64() * length / period;
    Ok(outlook.allows("following the full system from start to end", seconds, "direct"))
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
