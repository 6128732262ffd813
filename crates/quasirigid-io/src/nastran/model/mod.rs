//! Finite-element model of bulk data: cards are read one after the other and references are resolved afterwards, since their order is free.
//! A card that is not carried is counted by its name, and so is what a carried card has beyond what is carried.

mod beams;
mod constraints;
mod elements;
mod properties;
mod rigid;
mod sections;
mod solids;

use std::path::Path;

use super::bulk::{Card, cards_of, real_or};
use super::grid::Grids;
use super::op2;
use super::text::Text;
use crate::deck::{DeckModel, Up};
use crate::matrix::error::MatrixError;
use crate::matrix::listed::LocatedProblem;

/// A deck while its cards are read.
#[derive(Default)]
struct Reader {
    model: DeckModel,
    grids: Grids,
    /// Direction of the first plane of beams whose cards leave it blank.
    default_up: Option<Up>,
    turned: elements::Turned,
    systems_of_solids: solids::SystemsOfSolids,
    constraints: constraints::Constraints,
}

/// Reads bulk data with the files that they include.
///
/// # Errors
/// [`MatrixError`] says what is wrong, in which file and on which line.
pub(crate) fn read(file: &Path, bytes: &[u8]) -> Result<DeckModel, MatrixError> {
    let text = Text::read(file, bytes)?;
    let mut reader = Reader { model: DeckModel::new(), ..Reader::default() };
    for card in cards_of(text.bulk(), |name| !name.is_empty()) {
        card.and_then(|card| reader.take(&card)).map_err(|fault| text.located(fault))?;
    }
    reader.model.points = reader.grids.points().map_err(|fault| text.located(fault))?;
    reader.resolve_directions().map_err(|fault| text.located(fault))?;
    reader.resolve_solids().map_err(|fault| text.located(fault))?;
    reader.resolve_constraints(text.chosen("MPC").as_deref()).map_err(|fault| text.located(fault))?;
    let mut model = reader.model;
    if text.superelements() > 0 {
        model.left_out.insert("BEGIN SUPER".into(), text.superelements());
    }
    model.places = text.places();
    model.frequencies = op2::frequencies(bytes);
    if op2::lacks_parameters(bytes) {
        model.simplify("the file has no parameters: PARAM,WTMASS is taken as 1, else choose `mass_unit`");
    }
    Ok(model)
}

impl Reader {
    fn take(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        if self.grids.take(card)? {
            return Ok(());
        }
        let name = card.name.to_ascii_uppercase();
        if name == "PARAM" {
            if card.field(2).text.eq_ignore_ascii_case("WTMASS") {
                self.model.mass_factor = real_or(card.field(3), 1.0)?;
            }
            return Ok(());
        }
        let carried = self.element(card, &name)?
            || self.of_solids(card, &name)?
            || self.property(card, &name)?
            || self.rigid(card, &name)?
            || self.constraint(card, &name)?;
        if !carried && !ANALYSIS.contains(&name.as_str()) {
            self.model.leave_out(&name.chars().take(8).collect::<String>());
        }
        Ok(())
    }
}

/// Cards that say what to compute or print, and nothing of the body.
const ANALYSIS: [&str; 10] =
    ["EIGRL", "EIGR", "EIGB", "EIGC", "PLOTEL", "EPOINT", "FREQ1", "TSTEP", "NLPARM", "DOPTPRM"];
