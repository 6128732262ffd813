//! Verification of a mean power: the polynomial average beside short runs of the full system, at ever stiffer springs.
//! Both differ by the polhode of the deformed body and by terms of the power two degrees up, so their difference must fall as `ε²`.
//! Equations (Q4) and (Q9), docs/theory/16-methods.md; (E4), docs/theory/09-forced-reduction.md.

use std::ops::ControlFlow;

use thiserror::Error;

use super::verify::{VerificationError, falls, halved};
use crate::averaging::PolynomialPower;
use crate::dynamics::{Forced, Start};
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, Support};
use crate::modes::{EquilibriumError, ModesError};
use crate::reduction::reduce;
use crate::secular::{EnergyRange, MeasureError, MeasureOptions, Poles, SpotChecks};

/// Row of a verification: mean power of the polynomial average against that of the full system, near the polhode of a start, at ever
/// stiffer springs.
#[derive(Clone, Debug, PartialEq)]
pub struct AverageRow {
    /// Factors `ε` of `C → C/ε²`, `B → B/ε`, descending from 1, which is the model itself.
    pub epsilons: Vec<f64>,
    /// Relative differences of the mean power at each `ε`.
    pub errors: Vec<f64>,
    /// Order in `ε` of the differences, from the smallest two that the measurement resolves; none without two.
    pub order: Option<f64>,
    /// Expected order.
    pub expected: usize,
}

/// Error of an average that could not be verified.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum AverageError {
    /// The body has a wheel, a force or a support, outside of the average.
    #[error("the average is of a free body without wheels and forces")]
    NotFree,
    /// The body has materials or liquids outside of the full system.
    #[error("the full system has no equation for part of the dissipation")]
    LeftOut,
    /// The body spins steadily.
    #[error("the body spins steadily, so that there is nothing to average over")]
    Steady,
    /// No steady spin was found.
    #[error(transparent)]
    Equilibrium(#[from] EquilibriumError),
    /// The modes were not found.
    #[error(transparent)]
    Modes(#[from] ModesError),
    /// The mean power was not found.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// The start failed, or the caller asked for an end.
    #[error(transparent)]
    Verification(#[from] VerificationError),
}

/// Relative change of the power from one window of a run to the next: that of the wobble, at whose mean it is compared.
const CHANGE: f64 = 4e-3;
const RUN_TOLERANCE: f64 = 1e-12;
/// Difference below which an error may be that of the window.
const RESOLVED: f64 = 1e-6;
/// Order in `ε` of the difference: the polhode of the deformed body, and terms of the power two degrees up.
const EXPECTED: usize = 2;
/// Least order of the equations with dissipation.
const LOSSY: usize = 3;

/// Compares the mean power of the polynomial average of an order with that of the full system at `ε = 1, ½, ¼, …`, in runs of at most
/// `most_steps` in all. (Q4), (Q9), (E4)
///
/// # Errors
/// [`AverageError`].
pub fn verify_average(
    system: Forced,
    start: &Start,
    order: usize,
    halvings: usize,
    most_steps: u64,
    watch: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<AverageRow, AverageError> {
    let body = system.body;
    if system.acts() || !matches!(body.support(), Support::Free) || !body.wheels().is_empty() {
        return Err(AverageError::NotFree);
    }
    if !body.viscoelastic().is_empty() || !body.memories().is_empty() {
        return Err(AverageError::LeftOut);
    }
    let epsilons = halved(halvings);
    let (mut errors, mut left) = (Vec::new(), most_steps);
    for epsilon in &epsilons {
        let stiff = body.stiffened(*epsilon).map_err(VerificationError::from)?;
        match error(&stiff, start, order.max(LOSSY), left, watch) {
            Err(AverageError::Measure(MeasureError::StepLimit)) if errors.len() > 2 => break,
            found => {
                let (error, steps) = found?;
                errors.push(error);
                left = left.saturating_sub(steps);
            }
        }
    }
    let resolved: Vec<f64> = errors.iter().copied().take_while(|error| *error > RESOLVED).collect();
    let order = match resolved[..] {
        [.., before, last] => Some((before / last).log2()),
        _ => None,
    };
    Ok(AverageRow { epsilons: epsilons[..errors.len()].to_vec(), errors, order, expected: EXPECTED })
}

/// Relative difference of the two mean powers, and the steps of the run.
fn error(
    body: &FlexibleBody,
    start: &Start,
    order: usize,
    most_steps: u64,
    watch: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(f64, u64), AverageError> {
    let full = start.settled(Forced::not(body), order)?;
    let range = EnergyRange::compute(body, norm(full.angular_momentum(body)))?;
    let poles = Poles::compute(body, &range)?;
    if range.rotation_state(full.energy(body)).is_none() {
        return Err(AverageError::Steady);
    }
    let options = MeasureOptions { error: CHANGE, tolerance: RUN_TOLERANCE, most_steps };
    let probes = SpotChecks::from(body, &range, &poles, full, &options, watch)?;
    let power = PolynomialPower::from_reduced(&reduce(body, order).map_err(VerificationError::from)?);
    Ok((probes.error(&power), probes.steps()))
}

impl AverageRow {
    /// True if the difference falls with the expected order, or is below the resolution of the measurement.
    #[must_use]
    pub fn reached(&self) -> bool {
        falls(self.order, self.expected, self.errors.iter().copied())
    }
}
