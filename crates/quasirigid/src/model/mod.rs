//! What a body *is*.

mod inertia;
mod support;

pub use inertia::{Inertia, InertiaError};
pub use support::Support;
