//! Rigid elements of a deck: RBE2, RBAR and RBE3.

use super::Reader;
use crate::deck::{Mean, Stiff};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{Card, integer, integer_or, real_or_zero};

/// Components from the digits of a number.
pub(crate) fn components(digits: u64, line: usize) -> Result<[bool; 6], LocatedProblem> {
    let mut components = [false; 6];
    for digit in digits.to_string().bytes() {
        let component = usize::from(digit - b'0').checked_sub(1).and_then(|at| components.get_mut(at));
        let found = || MatrixProblem::Component { found: digits.to_string().into() };
        *component.ok_or_else(|| (line, found()))? = true;
    }
    Ok(components)
}

impl Reader {
    /// Takes the card of a rigid element that is carried; false for another card.
    pub(super) fn rigid(&mut self, card: &Card, name: &str) -> Result<bool, LocatedProblem> {
        match name {
            "RBE2" => {
                let base = integer(card.field(3), Row::Element)?;
                let followed = components(integer(card.field(4), Row::Element)?, card.line)?;
                let mut nodes = Vec::new();
                for field in card.fields_from(5).iter().filter(|field| !field.text.is_empty()) {
                    if field.text.contains('.') {
                        break; // coefficient of thermal expansion
                    }
                    nodes.push(integer(*field, Row::Element)?);
                }
                self.model.stiff.push(Stiff { base, nodes, components: followed, line: card.line });
                Ok(true)
            }
            "RBAR" => self.bar_of_rigid(card),
            "RBE3" => self.mean(card),
            _ => Ok(false),
        }
    }

    /// A rigid bar with all independent components at one end.
    fn bar_of_rigid(&mut self, card: &Card) -> Result<bool, LocatedProblem> {
        let ends = [integer(card.field(3), Row::Element)?, integer(card.field(4), Row::Element)?];
        let independent = [5, 6].map(|number| integer_or(card.field(number), 0, Row::Element));
        let dependent = [7, 8].map(|number| integer_or(card.field(number), 0, Row::Element));
        let ([first, second], [of_first, of_second]) = (independent, dependent);
        let (base, node, digits) = match (first?, second?) {
            (123_456, 0) => (ends[0], ends[1], of_second?),
            (0, 123_456) => (ends[1], ends[0], of_first?),
            _ => return Ok(false),
        };
        let followed = components(if digits == 0 { 123_456 } else { digits }, card.line)?;
        self.model.stiff.push(Stiff { base, nodes: vec![node], components: followed, line: card.line });
        Ok(true)
    }

    fn mean(&mut self, card: &Card) -> Result<bool, LocatedProblem> {
        let node = integer(card.field(4), Row::Element)?;
        let followed = components(integer(card.field(5), Row::Element)?, card.line)?;
        let mut others: Vec<(f64, [bool; 6], Vec<u64>)> = Vec::new();
        let fields: Vec<_> = card.fields_from(6).iter().filter(|field| !field.text.is_empty()).collect();
        let mut at = 0;
        while let Some(field) = fields.get(at) {
            let word = field.text.to_ascii_uppercase();
            if word == "ALPHA" {
                break;
            }
            if word == "UM" {
                return Ok(false);
            }
            if field.text.contains('.') {
                let weight = real_or_zero(**field)?;
                let digits = fields.get(at + 1).ok_or((card.line, MatrixProblem::NoWeighted { node }))?;
                others.push((weight, components(integer(**digits, Row::Element)?, card.line)?, Vec::new()));
                at += 2;
                continue;
            }
            let (_, _, nodes) = others.last_mut().ok_or((card.line, MatrixProblem::NoWeighted { node }))?;
            nodes.push(integer(**field, Row::Element)?);
            at += 1;
        }
        self.model.means.push(Mean { node, components: followed, others, line: card.line });
        Ok(true)
    }
}
