use std::f64::consts::TAU;

use super::super::reason::Reason;
use super::{Driver, Found, Outcome};
use crate::averaging::{LevelError, LevelEvolution, LevelPassage, LevelRow, LevelStopReason, Until};
use crate::math::sphere::tangents;
use crate::math::vec3::{add, dot, norm, scale, unit};
use crate::model::Mode;
use crate::secular::criteria::{ERROR_PER_CRITERION, PER_SETTLING, uneven};
use crate::secular::{Pole, apart};

/// Tilt (rad) of the small wobble whose rate on levels is compared with that of the modes.
const SMALL_TILT: f64 = 1e-2;

impl Driver<'_> {
    /// The average along level curves of the slow energy.
    pub(super) fn level_curves(&self) -> Result<Found, Reason> {
        let span = self.case.span;
        let reduced = self.case.level_equations.as_ref().ok_or(Reason::NotPrepared)?;
        let until = span.level_end.ok_or(Reason::RatioOfLevels)?;
        let K = span.start.angular_momentum(self.case.spins.body);
        let levels = LevelEvolution::new(reduced, norm(K)).map_err(Reason::Levels)?;
        let passage =
            level_passage(&levels, K, until, span.duration, span.samples).map_err(Reason::Levels)?;
        match passage.ending {
            LevelStopReason::Reached | LevelStopReason::Duration => {
                let error = self.levels_error(&levels, &passage).filter(|error| error.is_finite());
                Ok(Found { outcome: Outcome::LevelCurves(Box::new(passage)), error, source: None })
            }
            LevelStopReason::Undecided => Err(Reason::Separatrix {
                t: passage.rows.last().map_or(f64::NAN, |row| row.time),
                ways: Vec::new(),
            }),
            LevelStopReason::Lossless => Err(Reason::Lossless),
        }
    }

    /// Bound of the relative error of the time on level curves: their small wobbles beside those of the modes, what the series leaves out, and
    /// the phase of the wobble at both ends; none where the modes about a pole are not known. (Q18)
    fn levels_error(&self, levels: &LevelEvolution, passage: &LevelPassage) -> Option<f64> {
        let (spins, span) = (self.case.spins, self.case.span);
        let [first, last] = [passage.rows.first()?, passage.rows.last()?];
        let mut worst = 0.0_f64;
        for mode in [Mode::LongAxis, Mode::ShortAxis] {
            let passed = span.ends.iter().any(|state| state.mode == mode);
            if passed && mode.exists(spins.range.moments()) {
                let pole = spins.poles.of_mode(mode)?;
                worst = worst.max(beside_pole(levels, pole)?);
                for row in [first, last].into_iter().filter(|row| row.nutation[1] > SMALL_TILT) {
                    worst = worst.max(PER_SETTLING * wobble_rate(levels, row) / pole.following_rate());
                }
            }
        }
        let deformed = self.case.criteria.spin_ratio?.powi(2);
        let periods = 2.0 * last.time / (first.period + last.period);
        Some(ERROR_PER_CRITERION * worst + deformed + uneven(periods))
    }
}

/// Largest criterion of levels beside a pole: rate and frequency of a small wobble against the mode, and how the internal motion follows it;
/// none where either is not known.
fn beside_pole(levels: &LevelEvolution, pole: &Pole) -> Option<f64> {
    let nutation = pole.modes.nutation()?;
    let K = pole.modes.equilibrium.angular_momentum;
    let (center, _) = levels.steady().max_by(|(a, _), (b, _)| dot(*a, K).total_cmp(&dot(*b, K)))?;
    let [across, _] = tangents(unit(center));
    let level = levels.level(add(center, scale(SMALL_TILT * norm(center), across))).ok()?;
    let rate = level.power / (2.0 * (level.energy - levels.slow_energy(center)).abs());
    let known = nutation.decay_rate.abs();
    let settling = PER_SETTLING * known / pole.following_rate();
    Some(apart(rate, known).max(apart(TAU / level.period, nutation.frequency)).max(settling))
}

/// Rate (1/s) at which the wobble about the spin circled changes.
fn wobble_rate(levels: &LevelEvolution, row: &LevelRow) -> f64 {
    row.power / (2.0 * (row.energy - levels.slow_energy(row.circled)).abs())
}

/// Level curves from an angular momentum (N·m·s, body axes) to an end, or for a time (s) if that is before it.
///
/// # Errors
/// [`LevelError`] if they cannot be followed.
pub fn level_passage(
    levels: &LevelEvolution,
    angular_momentum: [f64; 3],
    until: Until,
    duration: Option<f64>,
    samples: usize,
) -> Result<LevelPassage, LevelError> {
    let passage = levels.follow(angular_momentum, until, samples)?;
    let taken = passage.rows.last().map_or(0.0, |row| row.time);
    match duration.filter(|duration| *duration < taken) {
        Some(duration) => levels.follow(angular_momentum, Until::Duration(duration), samples),
        None => Ok(passage),
    }
}
