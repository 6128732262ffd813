//! Choice of the method for a body with momentum wheels: level curves of the slow energy, the reduced equations about the steady spin, the
//! full system, or the rates of the modes alone.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::averaging::{LevelEvolution, LevelPassage, LevelRow, LevelStopReason};
use quasirigid::dynamics::FullState;
use quasirigid::model::Principal;
use quasirigid::reduction::frequencies;
use quasirigid::secular::{DirectStopReason, follow_about};
use quasirigid_io::model::EvolveMethod;
use quasirigid_math::sphere::tangents;
use quasirigid_math::vec3::{add, norm, scale};

use super::answer::{Answer, Row};
use super::full_system::direct;
use super::ground::Ground;
use crate::error::StudyError;
use crate::evolution::method::{FEW_COORDINATES, LEVEL_ORDER, Outlook, Verdict, options, passage};
use crate::evolution::reason::{Reason, Stop};
use crate::settings::EvolveSettings;
use crate::words::significant;

/// Bound of the ratio of any spin at the energy of the start to the slowest elastic frequency up to which levels are followed.
const STIFF: f64 = 0.1;
/// Bound of the error of a method over its largest criterion, error per `γ/β`, and the largest error accepted, as of averages. (Q7)
const CAUTION: f64 = 4.0;
const PER_SETTLING: f64 = 1.6;
const ACCEPTED: f64 = 0.04;
/// Tilt (rad) of the small wobble whose rate on levels is compared with that of the modes.
const SMALL: f64 = 1e-2;
/// Greatest wobble (rad) up to which the modes alone are followed, where no equation of motion has all losses.
const ALONE: f64 = 0.1;

/// Observer of the work, which may end it, and the answer.
pub type Watch<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;
pub type Found = Result<Answer, Stop>;

/// Chooses the method, and follows it.
pub fn choose(
    ground: &Ground,
    full: &FullState,
    asked: &EvolveSettings,
    outlook: &Outlook,
    watch: Watch<'_>,
) -> Found {
    let goal = ground.goal(asked)?;
    match asked.method {
        Some(EvolveMethod::MicroRuns) => return Err(Reason::ShortRunsWithWheels.into()),
        Some(EvolveMethod::ModalRates) => return Ok(modes(ground, goal, asked)?),
        Some(EvolveMethod::Average | EvolveMethod::Levels) => return levels(ground, asked),
        None | Some(EvolveMethod::Full | EvolveMethod::SpinManifold) => {}
    }
    if !ground.complete() {
        return Ok(modes(ground, goal, asked)?);
    }
    let unasked = asked.method.is_none();
    let mut why = None;
    if unasked && stiff(ground) {
        match levels(ground, asked) {
            Ok(answer) if answer.verdict.fails => {}
            Err(Stop::Refused(reason)) => why = Some(reason),
            found => return found,
        }
    }
    if asked.method != Some(EvolveMethod::Full) {
        match on_manifold(ground, full, goal, asked, watch) {
            Err(Stop::Refused(_)) if unasked => {}
            found => return found,
        }
    }
    match (direct(ground, full, goal, asked, outlook, watch), why) {
        (Err(Stop::Refused(last)), Some(first)) => Err(Reason::Both(Box::new([first, last])).into()),
        (found, _) => found,
    }
}

/// Whether every spin at the energy of the start is slow beside the elastic parts, and nothing moves inside but these.
fn stiff(ground: &Ground) -> bool {
    let body = ground.body;
    body.cyclic().is_empty() && body.viscoelastic().is_empty() && haste(ground) < STIFF
}

/// Bound of the ratio of any spin at the energy of the start to the slowest elastic frequency.
fn haste(ground: &Ground) -> f64 {
    let slowest = frequencies(ground.body).ok().and_then(|all| all.first().copied());
    let least = Principal::compute(ground.body.invariants().J).moments[0];
    (2.0 * ground.energy / least).sqrt() / slowest.unwrap_or(f64::INFINITY)
}

/// Level curves of the slow energy, whose verdict says whether they hold.
fn levels(ground: &Ground, asked: &EvolveSettings) -> Found {
    let study = ground.study;
    let reduced = study.reduced(study.order.max(LEVEL_ORDER))?;
    let K = ground.angular_momentum;
    let followed = LevelEvolution::new(&reduced, norm(K)).and_then(|levels| {
        let passage = passage(&levels, K, asked)?;
        let passed = passage.rows.last().map_or(0.0, |row| row.time);
        let error = levels_error(ground, &levels, passage.attractor, passed);
        Ok((passage, error))
    });
    let (passage, error) = followed.map_err(Reason::Levels)?;
    if passage.ending == LevelStopReason::Undecided {
        return Err(undecided(&passage).into());
    }
    if passage.ending == LevelStopReason::Lossless {
        return Err(Reason::LosslessWithWheels.into());
    }
    let holds = error <= ACCEPTED;
    let sentence = if holds {
        "Averaged along the level curves of the slow energy, by the modes about the steady spin".into()
    } else {
        format!(
            "THE AVERAGE DOES NOT HOLD: by its rates, frequencies and settling beside the modes it may be {} % off.",
            significant(100.0 * error, 2)
        )
    };
    let judge = holds.then_some("");
    let verdict =
        Verdict { road: "levels", sentence, judge, error: Some(error), fails: !holds, ..Verdict::default() };
    let crossed = passage.separatrices.first().map(|separatrix| separatrix.time);
    let rows = passage.rows.iter().map(of_level).collect();
    Ok(Answer { attractor: passage.attractor, crossed, ..ground.answer(verdict, rows) })
}

/// Bound of the error of levels over a time (s): their small wobble beside that of the modes, the square of spin over elastic frequency that the
/// series leaves out, and the phase of the wobble at both ends. (Q7)
fn levels_error(ground: &Ground, levels: &LevelEvolution, attractor: [f64; 3], passed: f64) -> f64 {
    let Some(mode) = ground.nutation() else { return f64::INFINITY };
    let [across, _] = tangents(scale(norm(attractor).recip(), attractor));
    let tilted = add(attractor, scale(SMALL * norm(attractor), across));
    let Ok(level) = levels.level(tilted) else { return f64::INFINITY };
    let rate = level.power / (2.0 * (level.energy - levels.slow_energy(attractor)));
    let apart = |found: f64, known: f64| (found / known - 1.0).abs();
    let settling = PER_SETTLING * mode.decay_rate / ground.pole.following_rate();
    let worst = apart(rate, mode.decay_rate).max(apart(TAU / level.period, mode.frequency)).max(settling);
    let error = CAUTION * worst + haste(ground).powi(2) + 0.5 * level.period / passed;
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Ways behind a separatrix of which a fraction of a revolution chooses.
fn undecided(passage: &LevelPassage) -> Reason {
    let last = passage.separatrices.last();
    Reason::Ways {
        t: last.map_or(f64::NAN, |separatrix| separatrix.time),
        ways: last.map_or_else(Vec::new, |separatrix| separatrix.ways.clone()),
    }
}

fn of_level(row: &LevelRow) -> Row {
    Row {
        t: row.time,
        revolutions: row.revolutions.abs(),
        energy: row.energy,
        nutation: row.nutation,
        periods: [row.period, TAU / row.long_axis_precession_rate],
        power: row.power,
    }
}

/// The reduced equations about the steady spin from start to end.
fn on_manifold(
    ground: &Ground,
    full: &FullState,
    goal: Option<f64>,
    asked: &EvolveSettings,
    watch: Watch<'_>,
) -> Found {
    if !ground.settled() || (asked.method.is_none() && ground.body.coordinates().len() > FEW_COORDINATES) {
        return Err(Reason::ManifoldThroughSeparatrix.into());
    }
    let options = options(goal, asked.duration);
    let found = follow_about(ground.body, &ground.pole.modes.equilibrium, full, &options, watch);
    let history = found.map_err(Reason::Submanifold)?.ok_or(Reason::BeyondManifoldWithWheels)?;
    match &history.run.ending {
        DirectStopReason::Interrupted => return Err(StudyError::Interrupted.into()),
        DirectStopReason::Reached | DirectStopReason::Finished => {}
        _ => return Err(Reason::ManifoldWithoutEnd.into()),
    }
    let verdict = Verdict {
        road: "manifold",
        sentence: format!(
            "The reduced equations about the steady spin were followed; they hold to a nutation of {} degrees",
            significant(history.range.to_degrees(), 3)
        ),
        judge: Some(""),
        error: Some(history.error),
        ..Verdict::default()
    };
    Ok(ground.of_run(&history.run, verdict, asked.samples))
}

/// The rates of the modes from start to end.
fn modes(ground: &Ground, goal: Option<f64>, asked: &EvolveSettings) -> Result<Answer, Reason> {
    let [_, greatest] = ground.wobble.nutation(ground.energy);
    if !(greatest < ALONE) {
        return Err(Reason::TooWideForNutation { widest: ALONE });
    }
    let rows = ground.tail(ground.start(), goal, asked.duration, asked.samples)?;
    let verdict = Verdict {
        road: "modes",
        sentence:
            "Followed at the rate of the nutation about the steady spin; the wobble is small enough for it"
                .into(),
        judge: Some(""),
        error: Some(greatest * greatest),
        ..Verdict::default()
    };
    Ok(ground.answer(verdict, rows))
}
