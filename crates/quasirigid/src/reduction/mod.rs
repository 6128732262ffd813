//! From a flexible body to its reduced equations.

mod energetics;
mod manifold;
mod momentum_form;
mod reduce;
mod residual;

pub use reduce::{MAX_ORDER, ReductionError, reduce};
pub use residual::{Residual, residual};
