use super::{NodeList, NodeTable};
use crate::matrix::error::{Fault, MatrixProblem, Place, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::nastran::{Card, cards, integer, real};
use crate::text_file::text;

/// `GRID` cards in the basic coordinate system.
pub(in crate::matrix) fn read(bytes: &[u8]) -> Result<NodeTable, Fault> {
    nodes(text::<MatrixProblem>(bytes)?).map_err(|(line, problem)| (Place::Line(line), problem))?.sorted()
}

fn nodes(text: &str) -> Result<NodeList, LocatedProblem> {
    let mut found = NodeList::default();
    for card in cards(text, "GRDSET") {
        in_basic_system(&card?, "GRDSET")?;
    }
    for card in cards(text, "GRID") {
        let card = card?;
        in_basic_system(&card, "GRID")?;
        let place = [real(card.field(4))?, real(card.field(5))?, real(card.field(6))?];
        found.add(integer(card.field(2), Row::Grid)?, place, card.line)?;
    }
    Ok(found)
}

/// Refuses a card that gives places (CP, field 3) or displacements (CD, field 7) in another coordinate system.
fn in_basic_system(card: &Card, name: &str) -> Result<(), LocatedProblem> {
    for (number, what) in [(3, "CP"), (7, "CD")] {
        let field = card.field(number);
        if !matches!(field.text, "" | "0") {
            let found = format!("{what} {} of {name}", field.text);
            return Err((field.line, MatrixProblem::OwnSystem { found: found.into() }));
        }
    }
    Ok(())
}
