//! Choice of the method of a secular evolution: what is known before any method runs, a decision that is a pure function of it, and a driver
//! that tries the methods in the order decided.
//!
//! [`Case`] computes the [`Criteria`], [`choose`] turns them into a [`Decision`] without any work, [`follow`] does the work. Nothing here has
//! words for a user: every refusal is a [`Reason`] with its numbers. (Q7)

mod average_powers;
mod case;
mod criteria;
mod decision;
mod follow;
mod gyrostat;
mod limits;
mod reason;
mod reference_spins;
mod span;
mod stiff;

pub use average_powers::AveragePowers;
pub use case::{Case, LEVEL_ORDER};
pub use criteria::{Criteria, GrowingVibration};
pub use decision::{Decision, Last, Method, choose};
pub use follow::{
    AverageBasis, ChoiceError, ChoiceObserver, Followed, Outcome, Stop, Tried, average_under_torque, follow,
    history_options, level_passage, pace_of_work, try_in_order,
};
pub use gyrostat::{GyrostatCriteria, choose_for_gyrostat};
pub use limits::Limits;
pub use reason::{Instability, Reason, UnknownLiquid, Work};
pub use reference_spins::{ReferenceSpins, loss_left_out};
pub use span::{MomentsOnly, Span};
pub use stiff::stiff_average;

#[cfg(test)]
mod tests;
