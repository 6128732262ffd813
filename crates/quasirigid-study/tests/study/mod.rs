//! Answers of studies: models are texts, answers are typed.

mod about_spin;
mod as_observed;
mod audit;
mod audit_attitude;
mod checks;
mod derive;
mod eddy_currents;
mod evolution;
mod fill_map;
mod forces;
mod full_system;
mod histories;
mod infer;
mod measured;
mod methods;
mod modes;
mod notes;
mod published;
mod rings;
mod sensitivity;
mod slaved;
mod surfaces;
mod sweep;
mod tanks;
mod thrust;
mod told_errors;
