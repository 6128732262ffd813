//! Verification of a reduction: the full system beside the reduced ones, at ever stiffer springs (E4), or at ever smaller nutations (W14).

mod about_spin;
mod averages;
mod compare;
mod runs;
mod verify;
mod wobbles;

pub use about_spin::{DegreeRow, SpinVerification, SpinVerificationPlan, verify_about_spin};
pub use averages::{AverageError, AverageRow, verify_average};
pub use compare::Difference;
pub use verify::{OrderRow, Verification, VerificationError, VerificationPlan, verify};
pub use wobbles::wobble_difference;
