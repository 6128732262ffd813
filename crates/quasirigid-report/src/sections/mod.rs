//! The sections of the page, in their order.

pub mod answer;
pub mod body;
pub mod figures;
pub mod head;
pub mod provenance;
pub mod reduction;
mod table;
pub mod validity;
pub mod verification;
