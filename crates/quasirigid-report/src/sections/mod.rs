//! The sections of the page; `page.rs` orders them.

pub mod about_spin;
pub mod answer;
pub mod body;
pub mod dissipation;
pub mod evolution;
pub mod figures;
pub mod head;
pub mod inputs;
pub mod liquids;
pub mod modes;
pub mod overview;
pub mod provenance;
pub mod reduction;
pub mod table;
pub mod validity;
pub mod verification;
