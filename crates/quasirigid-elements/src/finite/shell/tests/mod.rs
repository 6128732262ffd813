//! Tests of shells; the printed tables are those of convergence.
#![allow(clippy::print_stdout)]

mod beam;
mod buckling;
mod curved;
mod element;
mod grid;
mod laminate;
mod patch;
mod plate;
mod structure;
mod vibration;

use super::{Ply, ShellError, ShellSection};

impl ShellSection {
    /// The section of all layers.
    pub(in crate::finite::shell) fn laminate(plies: &[Ply], offset: f64) -> Result<Self, ShellError> {
        let layers = Self::layers(plies, offset)?;
        Ok(layers.into_iter().reduce(|sum, layer| sum + layer).expect("a laminate has a layer"))
    }
}
