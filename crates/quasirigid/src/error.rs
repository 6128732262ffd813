//! Error of the crate: wraps the error enums of all modules, for programs that call several.

use thiserror::Error;

use crate::averaging::{EvolutionError, FreeRotationError, HillError, LevelError, ObservedError, Unaveraged};
use crate::dynamics::PropagateError;
use crate::elements::ElementError;
use crate::math::eigen::NoConvergence;
use crate::model::{FlexibleError, InertiaError, RheologyError};
use crate::modes::{CampbellError, EquilibriumError, ModesError, SteadyError};
use crate::reduction::{ReductionError, ValidityError};
use crate::secular::MeasureError;
use crate::submanifold::SubmanifoldError;
use crate::verification::{AverageError, VerificationError};

/// Error of any module of the crate.
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
    /// Invalid element.
    Element(Box<ElementError>),
    /// Invalid flexible body.
    Flexible(#[from] FlexibleError),
    /// Invalid inertia tensor.
    Inertia(#[from] InertiaError),
    /// Invalid law of viscoelasticity.
    Rheology(#[from] RheologyError),
    /// Reduction that cannot be made.
    Reduction(#[from] ReductionError),
    /// Validity that cannot be assessed.
    Validity(#[from] ValidityError),
    /// Propagation that cannot start.
    Propagate(#[from] PropagateError),
    /// Steady spin that was not found.
    Equilibrium(#[from] EquilibriumError),
    /// Modes about a steady spin that were not found.
    Modes(#[from] ModesError),
    /// Eigenvalues of a spin that were not found.
    Campbell(#[from] CampbellError),
    /// Reduced equations about a steady spin that were not found.
    Submanifold(#[from] SubmanifoldError),
    /// Steady state under forces that was not found.
    Steady(#[from] SteadyError),
    /// Torque-free rotation that no body makes.
    FreeRotation(#[from] FreeRotationError),
    /// Periods that no torque-free rotation has.
    Observed(#[from] ObservedError),
    /// Evolution that cannot be computed.
    Evolution(#[from] EvolutionError),
    /// Force without an average.
    Unaveraged(#[from] Unaveraged),
    /// Response in the spinning frame that cannot be computed.
    Hill(#[from] HillError),
    /// Levels of the slow energy that cannot be followed.
    Level(#[from] LevelError),
    /// Mean power that could not be measured.
    Measure(#[from] MeasureError),
    /// Verification that could not be made.
    Verification(#[from] VerificationError),
    /// Verification of an average that could not be made.
    Average(#[from] AverageError),
    /// Eigenvalue solver that failed.
    Vibration(#[from] NoConvergence),
}

impl From<ElementError> for Error {
    fn from(cause: ElementError) -> Self {
        Self::Element(Box::new(cause))
    }
}
