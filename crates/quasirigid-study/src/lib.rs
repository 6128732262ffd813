//! Studies of almost rigid bodies: from a model to validity, modes, histories, secular evolution and a record.
//!
//! A [`Study`] is a model with its body. Its questions (validity of the reduced equations, modes, histories, evolution, verification
//! against the full system, the record of all) are answered here, with the verdicts and notes in words; nothing is
//! printed, and no flag is known. The command line, Python and the report are interfaces to this crate.
//!
//! The record and the report of `quasirigid run`:
//!
//! ```
//! use quasirigid_study::Study;
//! use quasirigid_study::settings::PartialRun;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = tempfile::tempdir()?;
//! # let (model, folder) = (concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/three-masses/model.toml"), folder.path());
//! let study = Study::open(model, None)?;
//! let found = study.run(&PartialRun::default(), &mut ())?;
//! for note in &found.record.notes {
//!     println!("note: {note}");
//! }
//! found.write(folder)?;
//! assert!(found.holds && folder.join("report.html").is_file());
//! # Ok(())
//! # }
//! ```
//!
//! Validity of the reduced equations, the modes about the steady spins, and the fate of the wobble:
//!
//! ```
//! use quasirigid_study::Study;
//! use quasirigid_study::modes::SteadySpinSettings;
//! use quasirigid_study::settings::PartialEvolve;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/boom-satellite/model.toml");
//! let study = Study::open(model, None)?;
//! assert!(study.check()?.holds());
//! for spin in study.modes(SteadySpinSettings::default())?.spins {
//!     println!("about the axis of {} inertia: {}", spin.axis, spin.sentence);
//! }
//! let evolved = study.evolve(PartialEvolve::default(), &mut ())?;
//! println!("{} after {} s", evolved.record.message, evolved.record.time);
//! # Ok(())
//! # }
//! ```
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

/// The chapter of the guide for programs in Rust, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/guide/16-library.md")]
struct Library;

pub mod about_spin;
mod as_observed;
mod asked;
pub mod audit;
mod campbell;
pub mod certificate;
pub mod check;
pub mod cite;
mod controlled;
pub mod derive;
pub mod difference;
mod driven;
pub mod effective_masses;
mod encounters;
mod equal_moments;
mod error;
pub mod evolution;
pub mod export;
pub mod fill_map;
mod free_rotation;
mod hashed;
pub mod histories;
mod history_columns;
mod history_json;
mod history_sink;
mod incomplete;
pub mod infer;
mod inputs;
mod judged;
mod kept_run;
pub mod layout;
mod left_out;
pub mod light_curve;
pub mod linear;
mod liquids;
mod materials;
pub mod modes;
mod motion;
mod neighbours;
mod record;
pub mod report;
mod resolution;
pub mod run;
mod scene;
pub mod sensitivity;
pub mod settings;
mod shapes;
mod sheets;
mod skin;
mod slugs;
mod spark;
pub mod spins;
mod spun_wobble;
mod start;
mod steady;
mod steady_state;
pub mod steps;
mod study;
pub mod summary;
pub mod sweep;
mod table_sink;
mod tanks;
pub mod verification;
mod watch;
mod words;
pub mod yorp;

pub use as_observed::Turned;
pub use error::StudyError;
pub use incomplete::beyond;
pub use kept_run::Keeping;
pub use left_out::LeftOut;
pub use settings::{Setting, SettingError};
pub use start::NoWobble;
pub use study::Study;
pub use watch::{STACK, Watch, panic_message, watched};
pub use words::MAY_NOT_HOLD;
