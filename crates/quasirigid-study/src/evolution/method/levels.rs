//! Choice of level curves of the slow energy.

use quasirigid::averaging::{LevelError, LevelEvolution, LevelPassage, LevelStopReason, Until};
use quasirigid::model::Principal;
use quasirigid::reduction::frequencies;
use quasirigid_io::model::Target;
use quasirigid_math::vec3::norm;

use super::short_or_full::Choice;
use super::verdict::ChosenMethod;
use crate::evolution::reason::Reason;
use crate::evolution::secular::LEFT;
use crate::settings::EvolveSettings;
use crate::study::Study;

/// Relative change of a difference of moments by elasticity from which levels are followed; largest ratio of spin to frequency; and
/// least order of the power on levels.
const BENT: f64 = 0.01;
const STIFF: f64 = 0.15;
pub const LEVEL_ORDER: usize = 5;

impl Choice<'_> {
    /// Average along levels of the slow energy, where elasticity changes the differences of the moments of a stiff body; none elsewhere.
    pub fn levels(&self, study: &Study, asked: &EvolveSettings) -> Option<Result<ChosenMethod, Reason>> {
        let rigid = Principal::compute(self.body.invariants().J).moments;
        let bent = self.ground.range.moments();
        let changed = [(0, 1), (1, 2)].iter().any(|(a, b)| {
            let (before, after) = (rigid[*b] - rigid[*a], bent[*b] - bent[*a]);
            (after - before).abs() > BENT * before.abs()
        });
        let slowest = frequencies(self.body).ok()?.first().copied()?;
        let omega = self.way.start.omega;
        if !changed && asked.method.is_none()
            || norm(omega) > STIFF * slowest
            || !self.body.cyclic().is_empty()
            || !self.body.viscoelastic().is_empty()
        {
            return None;
        }
        let reduced = study.reduced(study.order.max(LEVEL_ORDER)).ok()?;
        if matches!(asked.until, Some(Target::Ratio(_))) {
            return Some(Err(Reason::RatioOfLevels));
        }
        let angular_momentum = self.way.start.angular_momentum(self.body);
        let found = LevelEvolution::new(&reduced, norm(angular_momentum))
            .and_then(|levels| passage(&levels, angular_momentum, asked));
        Some(match found {
            Ok(passage) => match passage.ending {
                LevelStopReason::Reached | LevelStopReason::Duration => {
                    Ok(ChosenMethod::Levels(Box::new(passage)))
                }
                LevelStopReason::Undecided => {
                    Err(Reason::Separatrix { t: passage.rows.last().map_or(f64::NAN, |row| row.time) })
                }
                LevelStopReason::Lossless => Err(Reason::Lossless),
            },
            Err(error) => Err(Reason::Levels(error)),
        })
    }
}

/// Levels from an angular momentum (N·m·s, body axes) to the wobble asked for, or to the time if that is before it; to a hundredth of the energy
/// of the wobble without either.
pub fn passage(
    levels: &LevelEvolution,
    angular_momentum: [f64; 3],
    asked: &EvolveSettings,
) -> Result<LevelPassage, LevelError> {
    let until = match (asked.until, asked.duration) {
        (Some(Target::Wobble(angle)), _) => Until::Wobble(angle),
        (_, Some(duration)) => Until::Duration(duration),
        _ => Until::EnergyLeft(LEFT),
    };
    let passage = levels.follow(angular_momentum, until, asked.samples)?;
    let taken = passage.rows.last().map_or(0.0, |row| row.time);
    match asked.duration.filter(|duration| *duration < taken) {
        Some(duration) => levels.follow(angular_momentum, Until::Duration(duration), asked.samples),
        None => Ok(passage),
    }
}
