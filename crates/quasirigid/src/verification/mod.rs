//! Verification of a reduction: the full system beside the reduced ones, at ever stiffer springs. (E4)

mod averages;
mod compare;
mod runs;
mod verify;

pub use averages::{AverageError, AverageRow, verify_average};
pub use compare::Difference;
pub use verify::{OrderRow, Verification, VerificationError, VerificationPlan, verify};
