//! Bodies of [`quasirigid`](https://docs.rs/quasirigid): flexible with internal coordinates, reduced without them, and their parts.
//!
//! What a body is, without where it comes from (`quasirigid-elements`) or what becomes of it (`quasirigid-dynamics`): coordinates,
//! energies and equations of motion, forces, liquids, rheologies, the reduced equations of motion. `quasirigid::model` is this crate.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

use quasirigid_math as math;

mod advection;
mod balanced;
pub mod control;
mod coordinate;
mod curved;
mod derived;
mod dissipator;
mod drive;
mod energy_form;
mod equations;
mod expanded;
mod flexible;
mod flexible_error;
pub mod force;
mod friction;
mod gimbal;
mod hung;
mod inertia;
mod invariants;
mod kinetics;
mod liquid;
mod mass_inverse;
mod mass_matrix;
mod mean_load;
#[doc(hidden)]
pub mod moment;
mod part_mass;
mod path_series;
mod paths;
mod principal;
mod rational;
mod reduced;
mod rheology;
mod settings;
mod softened;
mod spin_matrix;
mod spinning;
mod straight;
mod support;
mod watched;
mod wheels;

pub use advection::Advection;
pub use balanced::BalancedSpin;
pub use coordinate::{Carried, Coordinate, Marker};
pub use dissipator::{Dissipator, Viscoelastic};
pub use drive::{Drive, DriveFault};
pub use energy_form::EnergyMotion;
#[doc(hidden)]
pub use energy_form::{energy_form, energy_form_under, energy_gradient, momentum_rate};
pub use equations::MotionState;
pub use expanded::ExpandedMotion;
pub use flexible::{BodyParts, FlexibleBody};
pub use flexible_error::FlexibleError;
#[doc(hidden)]
pub use flexible_error::mechanism;
pub use friction::{Friction, TubeFlow, TubeFriction};
pub use gimbal::Gimbal;
pub use hung::Hung;
pub use inertia::{Inertia, InertiaError};
pub use invariants::{Invariants, Pair};
pub use kinetics::{Kinetics, Velocities};
#[doc(hidden)]
pub use liquid::impedance;
pub use liquid::{LiquidFlow, LiquidMemory};
pub use part_mass::PartMass;
pub use paths::{CurvedPaths, Follower};
pub use principal::{Mode, Polhode, Principal};
pub use rational::RationalModulus;
pub use reduced::ReducedBody;
pub use rheology::{Measured, Rheology, RheologyError};
pub use settings::{Form, MAX_DEGREE, MAX_ORDER, Method};
pub use spin_matrix::{Recoiling, SpinMatrix};
pub use spinning::SpinCoefficients;
pub use straight::StraightKinetics;
pub use support::Support;
pub use watched::{Displaced, GIMBAL_LOCK, HINGE_RANGE, Hinge, RANGE, Reach, Watched};
pub use wheels::{DrivenWheel, Wheels};
