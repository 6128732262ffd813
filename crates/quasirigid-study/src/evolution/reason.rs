//! Reasons why an evolution has no answer, as data; [`refusals`](super::refusals) says them.

use quasirigid::secular::choice::{self, ChoiceError, Method, Stop};

use crate::error::StudyError;

/// Reason why an evolution has no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Material that is no solid in this motion, in words. (G16)
    NoSolid(String),
    /// Momentum wheel whose speed changes, so that its motor works on the body.
    ChangingWheel,
    /// Wall-clock time (s) that was spent, the most that work takes unasked.
    Spent { seconds: f64 },
    /// Reason of the choice.
    Choice(choice::Reason),
    /// Reason of level curves, and of the method that was tried last.
    AfterLevels(Box<[choice::Reason; 2]>),
}

impl Reason {
    /// Reason of an end of the choice.
    ///
    /// # Errors
    /// The [`StudyError`] of work that failed.
    pub fn of(stop: Stop<StudyError>) -> Result<Self, StudyError> {
        let (reason, tried) = match stop {
            Stop::Refused { reason, tried } => (reason, tried),
            Stop::Failed(error) => return Err(error),
        };
        let of_levels = tried.into_iter().find_map(|(method, reason)| {
            let refused =
                method == Method::LevelCurves && !matches!(reason, choice::Reason::LevelsFail { .. });
            refused.then_some(reason)
        });
        Ok(match of_levels {
            Some(first) => Self::AfterLevels(Box::new([first, reason])),
            None => Self::Choice(reason),
        })
    }
}

impl From<ChoiceError> for StudyError {
    fn from(error: ChoiceError) -> Self {
        match error {
            ChoiceError::Propagate(error) => error.into(),
            ChoiceError::Vibration(error) => error.into(),
            _ => Self::Interrupted,
        }
    }
}

impl From<StudyError> for Stop<StudyError> {
    fn from(error: StudyError) -> Self {
        Self::Failed(error)
    }
}
