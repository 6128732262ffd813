//! Rotation of almost rigid bodies after Chernousko (1978) `[@chernousko1978]`.
//!
//! A rigid carrier bears masses on stiff springs with dashpots. The stiff system reduces to
//!
//! ```text
//! J ω̇ + ω × Jω = μ₄(ω) + μ₅(ω) + …
//! ```
//!
//! with a small torque that is polynomial in the angular velocity. The modules stand in the order the data flows:
//!
//! - [`model`] describes a body: [`FlexibleBody`](model::FlexibleBody) with its internal coordinates, and
//!   [`ReducedBody`](model::ReducedBody) without them,
//! - [`elements`] are the parts a user describes, assembled into a flexible body,
//! - [`reduction`] derives the reduced equations to any order and assesses their validity,
//! - [`dynamics`] integrates them, and the full stiff system beside them,
//! - [`modes`] has the small motions about a steady spin,
//! - [`submanifold`] has the reduced equations about a steady spin, at any ratio of spin to elastic frequency,
//! - [`averaging`] follows the secular evolution by dissipation over millions of revolutions,
//! - [`verification`] compares full and reduced motions,
//! - [`secular`] judges whether an average holds over many revolutions, and measures the mean power where none does,
//! - [`problems`] are bodies with known answers.
//!
//! A hub with a damped mass on a spring, from its parts to a history of its nutation:
//!
//! ```
//! use quasirigid::prelude::*;
//!
//! let mut satellite = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
//! let mass = satellite.add(Point::new("mass", 1.0, [0.8, 0.3, 0.5]));
//! satellite.add(Spring::isotropic(600.0, 30.0).between(mass, CARRIER));
//! let body = satellite.body()?;
//! let reduced = reduce(&body, 3)?;
//! let start = Start::wobbling(&reduced, Mode::ShortAxis, 0.3, 1.0)?;
//! assert!(Validity::assess_reduced(&body, &reduced, start.omega)?.verdict() != Verdict::Fails);
//!
//! let mut samples: Vec<Sample> = Vec::new();
//! propagate(&reduced, start, &[0.0, 100.0], &Options::default(), &mut samples)?;
//! assert!(samples[1].energy < samples[0].energy);
//! # Ok::<(), quasirigid::Error>(())
//! ```
//!
//! [`prelude`] has the names that most programs need; [`Error`] wraps the errors of all modules. The folder `examples` has six short
//! programs.
//!
//! Mathematics and meshes are crates of their own, `quasirigid-math` and [`quasirigid-mesh`](mesh); their items in public types are
//! re-exported here.
//!
//! SI units throughout. Vectors are in the body frame: the axes of the model file, origin at the pole `O`.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

use quasirigid_math as math;

pub use quasirigid_math::eigen::{Dense, NoConvergence};
pub use quasirigid_math::factor::NotPositive;
pub use quasirigid_math::memory::TooMuchMemory;
pub use quasirigid_math::ode::{StepError, Work};
pub use quasirigid_math::quadrature::Integral;
pub use quasirigid_math::scalar::{Scalar, Smooth};
pub use quasirigid_math::sparse::SparseRows;
pub use quasirigid_math::sphere::StationaryKind;
pub use quasirigid_math::{OPTIMIZED, expression, polynomial, rotation, sym3, vec3, watch};
pub use quasirigid_mesh as mesh;
pub use quasirigid_mesh::surface;

pub use quasirigid_body as model;
pub use quasirigid_dynamics::{averaging, dynamics, modes, reduction, secular, submanifold, verification};
pub use quasirigid_elements as elements;
pub use quasirigid_elements::problems;

pub mod prelude;

mod error;

pub use error::Error;

/// The README's example, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
