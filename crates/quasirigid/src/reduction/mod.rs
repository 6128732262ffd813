//! From a flexible body to its reduced equations, and how far they hold.

mod criterion;
mod decay;
mod degrees;
mod energetics;
mod manifold;
mod momentum_form;
mod projection;
mod reduce;
mod relaxation;
mod residual;
mod resonance;
mod validity;
mod vibration;

pub use criterion::{Comparison, Criterion, Verdict};
pub use degrees::{DegreeSize, degree_sizes, optimal_order};
pub use reduce::{MAX_ORDER, ReductionError, reduce};
pub use relaxation::Relaxation;
pub use residual::{Residual, residual};
pub use resonance::{Resonance, resonances};
pub use validity::{Validity, ValidityError};
pub use vibration::{Vibrations, frequencies};
