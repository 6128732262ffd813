//! Structures of finite elements, and their condensation to the few coordinates of their slow motion.

mod assembly;
mod basis;
mod block;
mod component;
mod condensation;
mod curvature;
mod discrete;
mod dofs;
mod follower_paths;
mod loads;
mod losses;
mod lumped_masses;
mod masses;
mod node_paths;
mod owned;
mod pairs;
mod patch;
mod paths;
mod rigid;
mod rows;
mod solver;

pub(crate) use block::{Block, Entries};
pub(crate) use component::{Component, CondensationOptions, Fault, Load};
pub use condensation::Condensation;
pub(crate) use discrete::{Joint, Structure};
pub(crate) use dofs::{Constraint, Dofs, Node, Unknown};
