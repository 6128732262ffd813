//! The full system until its wobble is small, through a separatrix where there is one, and the modes from there on.

use std::f64::consts::TAU;

use quasirigid::dynamics::FullState;
use quasirigid::secular::choice::{
    ChoiceObserver, Limits, Reason, Stop, Work, history_options, pace_of_work,
};
use quasirigid::secular::{DirectRow, DirectRun, DirectStopReason, follow_directly};

use quasirigid_math::vec3::{add, norm, scale};

use super::answer::{Answer, BEHIND};
use super::attracting_spin::AttractingSpin;
use super::methods::MethodResult;
use crate::error::StudyError;
use crate::settings::EvolveSettings;

/// Share of the energy of the separatrix above the steady spin by which it is passed before the way behind it is told.
const BELOW: f64 = 1e-3;
/// Relative difference of the angular velocities of one steady spin.
const SAME: f64 = 1e-3;
/// Error of the time through a separatrix, beside which two integrations part.
const PARTED: f64 = 1e-2;

/// The full system until its wobble is small, and the modes from there on.
pub fn direct(
    spin: &AttractingSpin,
    full: &FullState,
    goal: Option<f64>,
    asked: &EvolveSettings,
    observer: &mut dyn ChoiceObserver,
) -> MethodResult {
    let until = spin.until(goal);
    announced(spin, full, until, asked, observer)?;
    let through = if spin.settled() { until } else { until.max(spin.beyond()) };
    let first = run(spin, full, through, asked.duration, observer)?;
    if first.ending == DirectStopReason::Settled {
        return elsewhere(spin, full, &first, asked, observer);
    }
    if through <= until || first.ending == DirectStopReason::Finished {
        return Ok(spin.with_tail(first, goal, asked));
    }
    behind(spin, first, asked, observer)
}

/// The full system to the steady spin that it has come to, where that is another than the one expected: soft parts may shift the separatrix.
fn elsewhere(
    spin: &AttractingSpin,
    full: &FullState,
    run: &DirectRun,
    asked: &EvolveSettings,
    observer: &mut dyn ChoiceObserver,
) -> MethodResult {
    let found = spin.come_to(full, &run.last)?;
    let [expected, come_to] = [spin, &found].map(|spin| spin.pole.modes.equilibrium.omega);
    if norm(add(expected, scale(-1.0, come_to))) <= SAME * norm(come_to) {
        return Err(unfinished(run).into());
    }
    let goal = found.goal(asked)?;
    let whole = followed(&found, full, found.until(goal), asked.duration, observer)?;
    Ok(found.with_tail(whole, goal, asked))
}

/// Reason for which a run has no end.
fn unfinished(run: &DirectRun) -> Reason {
    let DirectRow { t, revolutions, .. } = run.rows[run.rows.len() - 1];
    Reason::Unfinished { t, revolutions, ending: run.ending.clone(), instability: None }
}

/// The full system behind a separatrix, where it circles the steady spin that it came to.
fn behind(
    spin: &AttractingSpin,
    first: DirectRun,
    asked: &EvolveSettings,
    observer: &mut dyn ChoiceObserver,
) -> MethodResult {
    let end = first.rows[first.rows.len() - 1];
    let below = AttractingSpin::of(spin.study, &first.last)?;
    let goal = below.goal_from(spin.energy, asked);
    let left = asked.duration.map(|duration| duration - end.t);
    let whole = if goal.is_some_and(|goal| goal >= end.energy) {
        first
    } else {
        let second = followed(&below, &first.last, below.until(goal), left, observer)?;
        joined(first, second)
    };
    let mut answer = below.with_tail(whole, goal, asked);
    answer.verdict.error = answer.verdict.error.map(|error| error.max(PARTED));
    Ok(Answer { crossed: Some(end.t), ..answer })
}

/// The full system to an energy, which it comes to about the spin that is expected.
fn followed(
    spin: &AttractingSpin,
    full: &FullState,
    until: f64,
    duration: Option<f64>,
    observer: &mut dyn ChoiceObserver,
) -> Result<DirectRun, Stop<StudyError>> {
    let run = run(spin, full, until, duration, observer)?;
    if run.ending == DirectStopReason::Settled { Err(unfinished(&run).into()) } else { Ok(run) }
}

/// The full system to an energy, or to the steady spin in which it comes to rest above it.
fn run(
    spin: &AttractingSpin,
    full: &FullState,
    until: f64,
    duration: Option<f64>,
    observer: &mut dyn ChoiceObserver,
) -> Result<DirectRun, Stop<StudyError>> {
    let options = history_options(Some(until), duration, &Limits::default());
    let run = follow_directly(spin.body, full, &options, &mut |share| observer.observe(share))?;
    match run.ending {
        DirectStopReason::Reached | DirectStopReason::Finished | DirectStopReason::Settled => Ok(run),
        DirectStopReason::Interrupted => Err(StudyError::Interrupted.into()),
        _ => Err(unfinished(&run).into()),
    }
}

/// Announces a history of the full system; the reason why it is not followed, if it takes too long.
fn announced(
    spin: &AttractingSpin,
    full: &FullState,
    until: f64,
    asked: &EvolveSettings,
    observer: &mut dyn ChoiceObserver,
) -> Result<(), Stop<StudyError>> {
    let Some(mode) = spin.nutation().filter(|mode| mode.decay_rate > 0.0 && mode.frequency > 0.0) else {
        let body = spin.body;
        let lossless =
            body.dissipators().is_empty() && body.viscoelastic().is_empty() && body.memories().is_empty();
        return Err(if lossless { Reason::NothingDissipated } else { Reason::UnknownLength }.into());
    };
    let share = (spin.energy - spin.steady()) / (until - spin.steady());
    let falls = share.ln() / (2.0 * mode.decay_rate);
    let length = asked.duration.map_or(falls, |duration| duration.min(falls));
    let period = (TAU / mode.frequency).min(length);
    let pace =
        pace_of_work(spin.body, full, period, &Limits::default(), &mut |share| observer.observe(share))?;
    Ok(observer.announce(Work::History, pace * length)?)
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

impl AttractingSpin<'_> {
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
