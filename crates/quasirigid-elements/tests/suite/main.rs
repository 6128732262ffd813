//! Bodies that an assembly makes: reduced equations of a body in all its coordinates and in few.
#![allow(clippy::unwrap_used)]

mod condensation;
