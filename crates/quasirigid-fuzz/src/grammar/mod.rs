//! Grammars: texts of model files, studies, formulas and quantities, drawn by the bytes of an input.

pub mod choice;
mod element;
pub mod formula;
pub mod model;
mod number;
mod part;
mod setting;
pub mod study;
pub mod unit;
