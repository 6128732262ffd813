//! Structures of finite elements, and the few coordinates that say all about their slow motion.

mod basis;
mod component;
mod condensation;
mod curvature;
mod discrete;
mod freedoms;
mod grains;
mod loads;
mod losses;
mod masses;
mod owned;
mod paths;
mod rigid;
mod rows;
mod solver;
mod sum;

pub(super) use component::{Component, Fault, Load, Purpose};
pub use condensation::Condensation;
pub(super) use discrete::{Joint, Structure};
pub(super) use freedoms::{Freedoms, Hold, Node, Unknown};

#[cfg(test)]
mod tests;
