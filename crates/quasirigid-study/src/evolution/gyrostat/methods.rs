//! Methods for a body with momentum wheels: level curves of the slow energy, the reduced equations about the steady spin, the full system, or
//! the rates of the modes alone.

use std::f64::consts::TAU;

use quasirigid::averaging::{LevelEvolution, LevelPassage, LevelRow, LevelStopReason, PowerSource};
use quasirigid::dynamics::FullState;
use quasirigid::secular::choice::{
    ChoiceObserver, LEVEL_ORDER, Limits, Method, Reason, Stop, choose_for_gyrostat, history_options,
    level_passage, try_in_order,
};
use quasirigid::secular::{DirectStopReason, follow_about};
use quasirigid_math::sphere::tangents;
use quasirigid_math::vec3::{add, norm, scale};

use super::answer::{Answer, Row};
use super::attracting_spin::AttractingSpin;
use super::full_system::direct;
use crate::error::StudyError;
use crate::evolution::ends::level_end;
use crate::evolution::method::asked_method;
use crate::evolution::refusals::levels_fail;
use crate::evolution::verdict::Verdict;
use crate::settings::EvolveSettings;
use crate::words::significant;

/// Bound of the error of level curves over their largest criterion, and error per `γ/β`, as of averages. (Q7)
const ERROR_PER_CRITERION: f64 = 4.0;
const PER_SETTLING: f64 = 1.6;
/// Tilt (rad) of the small wobble whose rate on levels is compared with that of the modes.
const SMALL_TILT: f64 = 1e-2;
/// Greatest wobble (rad) up to which the modes alone are followed, where no equation of motion has all losses.
const MODES_ALONE_WOBBLE: f64 = 0.1;

/// Answer, or the end without one.
pub type MethodResult = Result<Answer, Stop<StudyError>>;

/// Chooses the method, and follows it.
pub fn chosen(
    spin: &AttractingSpin,
    full: &FullState,
    asked: &EvolveSettings,
    observer: &mut dyn ChoiceObserver,
) -> MethodResult {
    let goal = spin.goal(asked)?;
    let method = asked.method.map(|method| asked_method(method, PowerSource::Polynomial));
    let decision = choose_for_gyrostat(&spin.criteria(), method, &Limits::default());
    let (answer, _) = try_in_order(decision, |method| match method {
        Method::LevelCurves => levels(spin, asked),
        Method::SpinManifold => on_manifold(spin, full, goal, asked, observer),
        Method::FullSystem => direct(spin, full, goal, asked, observer),
        _ => Ok(modal_rates(spin, goal, asked)?),
    })?;
    Ok(answer)
}

/// Level curves of the slow energy; unasked only where they hold.
fn levels(spin: &AttractingSpin, asked: &EvolveSettings) -> MethodResult {
    let study = spin.study;
    let reduced = study.reduced(study.order.max(LEVEL_ORDER))?;
    let K = spin.angular_momentum;
    let until = level_end(asked).ok_or(Reason::RatioOfLevels)?;
    let followed = LevelEvolution::new(&reduced, norm(K)).and_then(|levels| {
        let passage = level_passage(&levels, K, until, asked.duration, asked.samples)?;
        let passed = passage.rows.last().map_or(0.0, |row| row.time);
        let error = levels_error(spin, &levels, passage.attractor, passed);
        Ok((passage, error))
    });
    let (passage, error) = followed.map_err(Reason::Levels)?;
    if passage.ending == LevelStopReason::Undecided {
        return Err(undecided(&passage).into());
    }
    if passage.ending == LevelStopReason::Lossless {
        return Err(Reason::Lossless.into());
    }
    let holds = error <= Limits::default().average_error;
    if !holds && asked.method.is_none() {
        return Err(Reason::LevelsFail { error }.into());
    }
    let sentence = if holds {
        "Averaged along the level curves of the slow energy, by the modes about the steady spin".into()
    } else {
        format!("THE AVERAGE DOES NOT HOLD: {}.", levels_fail(error))
    };
    let verdict = Verdict { sentence, error_source: holds.then_some(""), error: Some(error), fails: !holds };
    let crossed = passage.separatrices.first().map(|separatrix| separatrix.time);
    let rows = passage.rows.iter().map(of_level).collect();
    let answer = spin.answer(Method::LevelCurves, verdict, rows);
    Ok(Answer { attractor: passage.attractor, crossed, ..answer })
}

/// Bound of the error of levels over a time (s): their small wobble beside that of the modes, the square of spin over elastic frequency that the
/// series leaves out, and the phase of the wobble at both ends. (Q7)
fn levels_error(spin: &AttractingSpin, levels: &LevelEvolution, attractor: [f64; 3], passed: f64) -> f64 {
    let Some(mode) = spin.nutation() else { return f64::INFINITY };
    let [across, _] = tangents(scale(norm(attractor).recip(), attractor));
    let tilted = add(attractor, scale(SMALL_TILT * norm(attractor), across));
    let Ok(level) = levels.level(tilted) else { return f64::INFINITY };
    let rate = level.power / (2.0 * (level.energy - levels.slow_energy(attractor)));
    let apart = |found: f64, known: f64| (found / known - 1.0).abs();
    let settling = PER_SETTLING * mode.decay_rate / spin.pole.following_rate();
    let worst = apart(rate, mode.decay_rate).max(apart(TAU / level.period, mode.frequency)).max(settling);
    let error = ERROR_PER_CRITERION * worst + spin.spin_ratio().powi(2) + 0.5 * level.period / passed;
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Ways behind a separatrix of which a fraction of a revolution chooses.
fn undecided(passage: &LevelPassage) -> Reason {
    let last = passage.separatrices.last();
    Reason::Separatrix {
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
    spin: &AttractingSpin,
    full: &FullState,
    goal: Option<f64>,
    asked: &EvolveSettings,
    observer: &mut dyn ChoiceObserver,
) -> MethodResult {
    let options = history_options(goal, asked.duration, &Limits::default());
    let mut watch = |share: f64| observer.observe(share);
    let found = follow_about(spin.body, &spin.pole.modes.equilibrium, full, &options, &mut watch);
    let wobble = spin.wobble.nutation(spin.energy)[1];
    let history = found.map_err(Stop::<StudyError>::from)?.ok_or(Reason::BeyondManifold { wobble })?;
    match &history.run.ending {
        DirectStopReason::Interrupted => return Err(StudyError::Interrupted.into()),
        DirectStopReason::Reached | DirectStopReason::Finished => {}
        _ => return Err(Reason::ManifoldWithoutEnd.into()),
    }
    let verdict = Verdict {
        sentence: format!(
            "The reduced equations about the steady spin were followed; they hold to a {} of {} degrees",
            asked.kind.nutation(),
            significant(history.range.to_degrees(), 3)
        ),
        error_source: Some(""),
        error: Some(history.error),
        fails: false,
    };
    Ok(spin.of_run(Method::SpinManifold, &history.run, verdict, asked.samples))
}

/// The rates of the modes from start to end.
fn modal_rates(spin: &AttractingSpin, goal: Option<f64>, asked: &EvolveSettings) -> Result<Answer, Reason> {
    let [_, greatest] = spin.wobble.nutation(spin.energy);
    if !(greatest < MODES_ALONE_WOBBLE) {
        return Err(Reason::TooWideForNutation { widest: MODES_ALONE_WOBBLE });
    }
    let rows = spin.tail(spin.start(), goal, asked.duration, asked.samples)?;
    let nutation = asked.kind.nutation();
    let verdict = Verdict {
        sentence: format!(
            "Followed at the rate of the {nutation} about the steady spin; the {nutation} is small enough for it"
        ),
        error_source: Some(""),
        error: Some(greatest * greatest),
        fails: false,
    };
    Ok(spin.answer(Method::ModalRates, verdict, rows))
}
