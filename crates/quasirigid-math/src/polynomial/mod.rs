//! Polynomial maps of three variables, graded by degree.

mod axes;
mod homogeneous;
mod kernel;
pub mod monomial;
mod series;
mod ternary;

pub use homogeneous::Homogeneous;
pub use kernel::{Kernel, Number, TensorKernel};
pub use series::Series;
