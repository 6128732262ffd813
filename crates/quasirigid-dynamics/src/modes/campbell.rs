//! Campbell diagram: eigenvalues of the small motions about a steady spin, for many spins of one body.
//! Equations (M2), (M11), docs/theory/15-modes.md.

use thiserror::Error;

use super::displacements::WHOLE;
use super::equilibrium::{EquilibriumError, RelativeEquilibrium, SpinMagnitude};
use super::error::ModesError;
use super::first_order::FirstOrder;
use super::spectrum::ZERO;
use crate::math::eigen::eigenvalues;
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, Mode};

/// Eigenvalues of the small motions about a steady spin: a column of a Campbell diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinEigenvalues {
    /// Steady spin.
    pub equilibrium: RelativeEquilibrium,
    /// Eigenvalues with `Im λ ≥ 0`, as the rate of growth (1/s) and the frequency (rad/s) in body axes, by ascending frequency and then decay.
    /// Zero ones, of steady spins beside this one, are left out.
    pub eigenvalues: Vec<[f64; 2]>,
}

/// Error of the eigenvalues of a spin that were not found.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
#[error(transparent)]
pub enum CampbellError {
    /// There is no steady spin.
    Equilibrium(#[from] EquilibriumError),
    /// The steady spin has no modes.
    Modes(#[from] ModesError),
}

/// Campbell diagram: eigenvalues at each of many spins (rad/s) about the axis that a mode circles. (M2)
///
/// They are those of the equations of motion, as [`SpinMode::of_motion`](super::SpinMode::of_motion), where materials and liquids without
/// equations of their own are left out or approximated. The motions and their energies are not found: a decay that is
/// lost in the rounding of the largest eigenvalue is so here, while [`SpinModes`](super::SpinModes) has it from the balance of the energy.
///
/// # Errors
/// Each spin has its own [`CampbellError`], where the body has no steady spin there or no modes about it.
///
/// # Example
/// A rigid body nutates at a constant multiple of its spin.
/// ```
/// use quasirigid::modes::campbell;
/// use quasirigid::prelude::*;
///
/// let body = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0])).body()?;
/// let ratio = (7.0_f64 * 3.0 / (9.0 * 13.0)).sqrt();
/// for column in campbell(&body, Mode::ShortAxis, &[0.5, 1.0, 2.0]) {
///     let column = column?;
///     let spin = norm(column.equilibrium.omega);
///     let [[growth, frequency]] = column.eigenvalues[..] else { panic!("one motion") };
///     assert!(growth.abs() < 1e-14 * spin && (frequency - ratio * spin).abs() < 1e-14 * spin);
/// }
/// # Ok::<(), quasirigid::Error>(())
/// ```
#[must_use]
pub fn campbell(
    body: &FlexibleBody,
    mode: Mode,
    spins: &[f64],
) -> Vec<Result<SpinEigenvalues, CampbellError>> {
    spins.iter().map(|spin| column(body, mode, *spin)).collect()
}

/// Eigenvalues at one spin.
fn column(body: &FlexibleBody, mode: Mode, spin: f64) -> Result<SpinEigenvalues, CampbellError> {
    let equilibrium = RelativeEquilibrium::extreme(body, mode, SpinMagnitude::Rate(spin))?;
    let coefficients = equilibrium.coefficients(body);
    let matrix = FirstOrder::of(body, &equilibrium, &coefficients, WHOLE)?.matrix;
    let values = eigenvalues(&matrix).map_err(ModesError::from)?;
    Ok(SpinEigenvalues { eigenvalues: upper(values, norm(equilibrium.omega)), equilibrium })
}

/// Eigenvalues of the upper half plane without zero, in order.
fn upper(mut values: Vec<[f64; 2]>, spin: f64) -> Vec<[f64; 2]> {
    values.retain(|[re, im]| *im >= 0.0 && re.hypot(*im) > ZERO * spin);
    values.sort_by(|a, b| a[1].total_cmp(&b[1]).then(b[0].total_cmp(&a[0])));
    values
}
