//! Reduction: reduced equations of a flexible body, and their validity.

mod angular_momentum_form;
mod couplings;
mod criterion;
mod decay;
mod degrees;
mod energetics;
mod energy_form;
mod meaning;
mod projection;
mod reduce;
mod relaxation;
mod residual;
mod resonance;
mod slow_manifold;
mod validity;
mod vibration;

pub use crate::model::MAX_ORDER;
pub use criterion::{Comparison, Criterion, Verdict};
pub use degrees::{DegreeSize, degree_sizes, optimal_order};
pub use meaning::{manifold_has_meaning, state_has_meaning};
pub use reduce::{ReductionError, reduce};
pub use relaxation::Relaxation;
pub use residual::{Residual, residual};
pub use resonance::{Resonance, resonances};
pub use validity::{Assessment, Validity, ValidityError};
pub use vibration::{Vibrations, frequencies};
