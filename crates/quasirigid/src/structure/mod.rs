//! Structures of finite elements, and the few coordinates that say all about their slow motion.

mod basis;
mod block;
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

pub(crate) use block::{Block, Entries};
pub(crate) use component::{Component, Fault, Load, Purpose};
pub use condensation::Condensation;
pub(crate) use discrete::{Joint, Structure};
pub(crate) use freedoms::{Freedoms, Hold, Node, Unknown};
