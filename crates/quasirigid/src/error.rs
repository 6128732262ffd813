//! One error for a program that asks several modules: each module's own enum, wrapped.

use thiserror::Error;

use crate::averaging::{EvolutionError, FreeRotationError, HillError, LevelError, ObservedError, Unaveraged};
use crate::dynamics::PropagateError;
use crate::elements::ElementError;
use crate::math::eigen::NoConvergence;
use crate::model::{FlexibleError, InertiaError, RheologyError};
use crate::modes::{EquilibriumError, ModesError, SteadyError};
use crate::reduction::{ReductionError, ValidityError};
use crate::secular::MeasureError;
use crate::verification::{AverageError, VerificationError};

/// Why there is no answer, whichever module was asked.
///
/// ```
/// use quasirigid::prelude::*;
///
/// fn order(body: &FlexibleBody) -> Result<usize, quasirigid::Error> {
///     Ok(reduce(body, 99)?.order)
/// }
///
/// let body = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0])).body()?;
/// assert!(matches!(order(&body), Err(quasirigid::Error::Reduction(_))));
/// # Ok::<(), quasirigid::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
#[error(transparent)]
pub enum Error {
    /// An element that no body can have.
    Element(Box<ElementError>),
    /// A flexible body that cannot be.
    Flexible(#[from] FlexibleError),
    /// An inertia tensor that no body has.
    Inertia(#[from] InertiaError),
    /// A law of viscoelasticity that no material has.
    Rheology(#[from] RheologyError),
    /// A reduction that is not offered.
    Reduction(#[from] ReductionError),
    /// A validity that cannot be told.
    Validity(#[from] ValidityError),
    /// A propagation that cannot start.
    Propagate(#[from] PropagateError),
    /// A steady spin that was not found.
    Equilibrium(#[from] EquilibriumError),
    /// Modes about a steady spin that were not found.
    Modes(#[from] ModesError),
    /// A steady state under forces that was not found.
    Steady(#[from] SteadyError),
    /// A torque-free rotation that no body makes.
    FreeRotation(#[from] FreeRotationError),
    /// Periods that no torque-free rotation has.
    Observed(#[from] ObservedError),
    /// An evolution that cannot be computed.
    Evolution(#[from] EvolutionError),
    /// A force that has no average.
    Unaveraged(#[from] Unaveraged),
    /// A response in the spinning frame that is not known.
    Hill(#[from] HillError),
    /// Levels of the slow energy that cannot be followed.
    Level(#[from] LevelError),
    /// A mean power that could not be measured.
    Measure(#[from] MeasureError),
    /// A verification that could not be made.
    Verification(#[from] VerificationError),
    /// A verification of an average that could not be made.
    Average(#[from] AverageError),
    /// An eigenvalue solver that failed.
    Vibration(#[from] NoConvergence),
}

impl From<ElementError> for Error {
    fn from(cause: ElementError) -> Self {
        Self::Element(Box::new(cause))
    }
}
