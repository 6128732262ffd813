use super::super::reason::Reason;
use super::{Driver, Found, Outcome};
use crate::averaging::{LevelError, LevelEvolution, LevelPassage, LevelStopReason, Until};
use crate::math::vec3::norm;

impl Driver<'_> {
    /// The average along level curves of the slow energy.
    pub(super) fn level_curves(&self) -> Result<Found, Reason> {
        let span = self.case.span;
        let reduced = self.case.level_equations.as_ref().ok_or(Reason::NotPrepared)?;
        let until = span.level_end.ok_or(Reason::RatioOfLevels)?;
        let K = span.start.angular_momentum(self.case.spins.body);
        let passage = LevelEvolution::new(reduced, norm(K))
            .and_then(|levels| level_passage(&levels, K, until, span.duration, span.samples))
            .map_err(Reason::Levels)?;
        match passage.ending {
            LevelStopReason::Reached | LevelStopReason::Duration => {
                Ok(Found { outcome: Outcome::LevelCurves(Box::new(passage)), error: None, source: None })
            }
            LevelStopReason::Undecided => Err(Reason::Separatrix {
                t: passage.rows.last().map_or(f64::NAN, |row| row.time),
                ways: Vec::new(),
            }),
            LevelStopReason::Lossless => Err(Reason::Lossless),
        }
    }
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
