//! Polynomial maps of three variables, graded by degree.

mod axes;
mod homogeneous;
mod kernel;
pub mod monomial;
mod quadratic;
mod series;
mod sphere;
mod tangent;
mod ternary;

pub use homogeneous::Homogeneous;
pub use kernel::{Kernel, Number, TensorKernel};
pub use quadratic::QuadraticKernel;
pub use series::Series;
pub use sphere::{SphereKernel, SphereMap};
pub use tangent::{TangentKernel, TangentMap};
