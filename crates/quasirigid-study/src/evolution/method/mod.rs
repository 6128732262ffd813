//! Choice of the method of an evolution: average, level curves, short runs or the full system, with the criteria of each. (Q7)

mod average;
mod full;
mod levels;
mod on_manifold;
mod outlook;
mod short_or_full;
mod start_and_end;
mod steady_spins;
mod verdict;

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::averaging::{FreeRotation, LevelPassage, MeanPower};
use quasirigid::dynamics::Start;
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::secular::{DirectRow, DirectRun, EnergyRange, apart};
use quasirigid_io::model::EvolveMethod;
use quasirigid_math::vec3::norm;

use super::reason::{Reason, Stop};
use super::secular::SecularEvolution;
use crate::motion::Motion;
use crate::settings::EvolveSettings;
use crate::study::Study;
pub use full::options;
pub use levels::{LEVEL_ORDER, passage};
pub use on_manifold::FEW as FEW_COORDINATES;
pub use outlook::Outlook;
use short_or_full::Choice;
use start_and_end::Way;
use steady_spins::Ground;
use verdict::take;
pub use verdict::{FOLLOWED, Verdict};

/// History that is followed beside a power.
pub enum History {
    /// No history: the power determines the evolution.
    None,
    /// The full system until it has forgotten its start; from there on the power determines the evolution.
    Settled(DirectRow, EnergyRange),
    /// The full system, with its range of energies.
    Full(Box<DirectRun>, EnergyRange),
    /// Levels of the slow energy.
    Levels(Box<LevelPassage>),
}

/// A spin below this share of the slowest elastic frequency needs no more than the average.
const SLOW: f64 = 1e-3;
/// Error of an average that is given under a torque, which has no other method.
const UNDER_TORQUE: f64 = 0.1;
/// Moments whose relative difference is larger are distinct for so slow a spin.
const DISTINCT: f64 = 1e-3;
/// Change of the wobble in a radian of the polhode from which an average is judged by the modes. (Q14)
const BRIEF: f64 = 1e-2;
/// Relative difference between the powers of the polynomial and of the harmonics below which losses are of first order.
const FIRST_ORDER: f64 = 2.5e-3;
/// Places `ξ` at which the two are compared, from the separatrix to the axis.
const PLACES: [f64; 5] = [-6.0, -3.0, 0.0, 3.0, 12.0];

/// Chooses the method for a body on which no torque acts: the power that is followed from then on, or the history.
///
/// # Errors
/// [`Stop`]; the verdict then has the rates of the modes, where these are known.
pub fn choose(
    study: &Study,
    start: Start,
    asked: &EvolveSettings,
    secular: &mut SecularEvolution,
    outlook: &Outlook,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<History, Stop> {
    let body = &study.body;
    if asked.method.is_none() && needs_no_judgement(body, secular, norm(start.omega)) {
        return Ok(History::None);
    }
    let full = Motion::new(study, start).full()?;
    let angular_momentum = norm(full.angular_momentum(body));
    if !(angular_momentum.is_finite() && angular_momentum > 0.0) {
        return Ok(History::None);
    }
    secular.turn_with(full.angular_momentum(body))?;
    let ground = Ground::of(study, angular_momentum)?;
    secular.verdict.rates = Some(ground.rates());
    if let (None, Some(unstable)) = (asked.method, ground.unstable()) {
        return Err(Reason::Unstable(unstable).into());
    }
    let way = Way::of(&ground, full, asked, secular)?;
    if let Some(silent) = way.ends.iter().find_map(|stage| ground.silent(stage.mode)) {
        return Err(Reason::UnknownLiquids(silent.clone()).into());
    }
    let choice = Choice::new(&ground, &way, asked.duration, outlook);
    let road = match asked.method {
        Some(EvolveMethod::Average) => choice.forced_average(secular),
        Some(EvolveMethod::ModalRates) => choice.calibrated(secular)?,
        Some(EvolveMethod::Levels) => choice.levels(study, asked).unwrap_or(Err(Reason::NotOnLevels))?,
        Some(EvolveMethod::MicroRuns | EvolveMethod::Full | EvolveMethod::SpinManifold)
            if !ground.complete(way.ends) =>
        {
            return Err(Reason::LossesLeftOut { share: ground.left_out(way.ends) }.into());
        }
        Some(EvolveMethod::MicroRuns) => choice.measured(watch)?,
        Some(EvolveMethod::Full) => choice.direct(watch)?,
        Some(EvolveMethod::SpinManifold) => choice.along_manifold(watch)?,
        None => match choice.average(secular, watch)? {
            Some(road) => road,
            None => match choice.levels(study, asked) {
                Some(found) => found?,
                None => choice.other(secular, watch)?,
            },
        },
    };
    Ok(take(road, &ground, &way, secular))
}

/// Judges the average of a body under a slow torque, which no other method follows.
///
/// # Errors
/// As [`choose`].
pub fn under_torque(
    study: &Study,
    start: Start,
    asked: &EvolveSettings,
    secular: &mut SecularEvolution,
) -> Result<(), Stop> {
    let body = &study.body;
    if needs_no_judgement(body, secular, norm(start.omega)) {
        return Ok(());
    }
    let full = Motion::new(study, start).full()?;
    let angular_momentum = norm(full.angular_momentum(body));
    if !(angular_momentum.is_finite() && angular_momentum > 0.0) {
        return Ok(());
    }
    secular.turn_with(full.angular_momentum(body))?;
    let ground = Ground::of(study, angular_momentum)?;
    let Some(stage) = ground.range.stage(full.energy(body)) else { return Ok(()) };
    secular.verdict.rates = Some(ground.rates());
    if let Some(silent) = ground.silent(stage.mode) {
        return Err(Reason::UnknownLiquids(silent.clone()).into());
    }
    let mut criteria = ground.criteria(secular.power(), [stage; 2]);
    if criteria.error() > UNDER_TORQUE && secular.by_polynomial && !secular.power_was_asked {
        secular.take_harmonics();
        criteria = ground.criteria(secular.power(), [stage; 2]);
    }
    if criteria.error() <= UNDER_TORQUE {
        secular.verdict.error = Some(criteria.error());
        return Ok(());
    }
    if asked.method == Some(EvolveMethod::Average) {
        secular.verdict.does_not_hold(criteria);
        return Ok(());
    }
    Err(Reason::AverageUnderTorque(criteria).into())
}

/// Whether the average of a body needs no judgement: one of the harmonics, where losses are not of first order and no power was asked for.
fn needs_no_judgement(body: &FlexibleBody, secular: &mut SecularEvolution, spin: f64) -> bool {
    if !plain(body, secular, spin) {
        return false;
    }
    if secular.by_polynomial && !first_order(secular) {
        if secular.power_was_asked {
            return false;
        }
        secular.take_harmonics();
    }
    true
}

/// Whether a body is so stiff, with moments so distinct, that the polhode is that of the frozen body.
fn plain(body: &FlexibleBody, secular: &SecularEvolution, spin: f64) -> bool {
    let [I1, I2, I3] = secular.principal.moments;
    let distinct = [I2 - I1, I3 - I2].iter().all(|gap| *gap > DISTINCT * I3 || *gap < 1e-9 * I3);
    let slowest = secular.response.frequencies().next().map_or(f64::INFINITY, |(frequency, _)| frequency);
    let driven = secular.response.driven_materials(&secular.initial);
    let softest = driven.iter().fold(1.0, |least: f64, material| least.min(material.modulus));
    body.cyclic().is_empty()
        && distinct
        && spin < SLOW * slowest * softest.sqrt()
        && !(per_revolution(secular) > BRIEF)
}

/// Rate of the wobble, `P/2E_w`, over the polhode rate: what an average over its period leaves out. (Q3), (Q14)
fn per_revolution(secular: &SecularEvolution) -> f64 {
    let motion = &secular.initial;
    let steady = motion.angular_momentum().powi(2) / (2.0 * motion.moments()[motion.mode().circled()]);
    let wobble = 2.0 * (motion.energy() - steady).abs();
    secular.power().mean_power(motion) / wobble * motion.polhode_period() / TAU
}

/// Whether polynomial and harmonics have the same power wherever an evolution may lead: next to the separatrix the wobble is slow, so that the
/// start alone says nothing of the rest.
fn first_order(secular: &SecularEvolution) -> bool {
    let (moments, G) = (secular.initial.moments(), secular.initial.angular_momentum());
    let modes = [Mode::ShortAxis, Mode::LongAxis].into_iter().filter(|mode| mode.exists(moments));
    let mut motions = modes.flat_map(|mode| PLACES.map(|xi| FreeRotation::at_logit(moments, G, mode, xi)));
    motions.all(|motion| {
        apart(secular.power().mean_power(&motion), secular.response.mean_power(&motion)) < FIRST_ORDER
    })
}
