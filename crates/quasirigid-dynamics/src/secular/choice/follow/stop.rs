use thiserror::Error;

use super::super::decision::Method;
use super::super::reason::Reason;
use crate::dynamics::PropagateError;
use crate::math::eigen::NoConvergence;
use crate::reduction::ReductionError;
use crate::secular::MeasureError;
use crate::submanifold::{ExpansionError, SubmanifoldError};

/// Methods that did not hold, each with the reason.
pub type Tried = Vec<(Method, Reason)>;

/// End of a choice without a method; `E` is the error of the work itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop<E = ChoiceError> {
    /// No method leads to an answer.
    Refused {
        /// Reason of the last method that was tried, or of the decision.
        reason: Reason,
        /// Methods that were tried before, each with its reason.
        tried: Tried,
    },
    /// The work itself failed.
    Failed(E),
}

/// Error of the work of a choice.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ChoiceError {
    /// The observer ended the work.
    #[error("interrupted")]
    Interrupted,
    /// The full system could not be propagated.
    #[error(transparent)]
    Propagate(#[from] PropagateError),
    /// The vibrations could not be found.
    #[error(transparent)]
    Vibration(#[from] NoConvergence),
}

impl<E> Stop<E> {
    /// The same end, after methods that were tried before.
    pub(super) fn after(self, tried: Tried) -> Self {
        match self {
            Self::Refused { reason, .. } => Self::Refused { reason, tried },
            failed @ Self::Failed(_) => failed,
        }
    }

    /// The same end, with another error of the work.
    #[must_use]
    pub fn map_error<F>(self, change: impl FnOnce(E) -> F) -> Stop<F> {
        match self {
            Self::Refused { reason, tried } => Stop::Refused { reason, tried },
            Self::Failed(error) => Stop::Failed(change(error)),
        }
    }
}

impl<E> From<Reason> for Stop<E> {
    fn from(reason: Reason) -> Self {
        Self::Refused { reason, tried: Vec::new() }
    }
}

/// Errors of the work that stop a choice.
macro_rules! failures {
    ($($error:ty),*) => {$(
        impl<E: From<$error>> From<$error> for Stop<E> {
            fn from(error: $error) -> Self {
                Self::Failed(error.into())
            }
        }
    )*};
}

failures!(ChoiceError, NoConvergence, PropagateError, ReductionError);

impl<E: From<ChoiceError>> From<MeasureError> for Stop<E> {
    fn from(error: MeasureError) -> Self {
        match error {
            MeasureError::Interrupted => ChoiceError::Interrupted.into(),
            error => Reason::Measured(error).into(),
        }
    }
}

impl<E: From<ChoiceError>> From<SubmanifoldError> for Stop<E> {
    fn from(error: SubmanifoldError) -> Self {
        match error {
            SubmanifoldError::Expansion(ExpansionError::Interrupted) => ChoiceError::Interrupted.into(),
            error => Reason::Submanifold(error).into(),
        }
    }
}
