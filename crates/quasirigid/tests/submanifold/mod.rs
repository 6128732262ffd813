//! Reduced equations about a steady spin.

mod bodies;
mod orders;
