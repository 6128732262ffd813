//! Finite-element model of a deck: grid points, elements with properties and materials, bodies, links and rigid elements, by their numbers.
//! Cards are read one after the other and references are resolved afterwards, since their order is free. A card that is not carried is
//! counted by its name, and so is what a carried card has beyond what is carried.

mod cells;
mod elements;
mod properties;
mod rigid;
mod sections;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use super::bulk::{Card, cards_of, real_or};
use super::grid::{Grids, Point};
use super::op2;
use super::text::Deck;
use crate::matrix::error::MatrixError;
use crate::matrix::listed::LocatedProblem;
pub(crate) use cells::Cells;
pub(crate) use elements::{Bush, Line, Plate, Scalar, Solid, SpringEnd, Tip, Up};
pub(crate) use properties::{Bending, Plating, Ply, RodSection, Stuff};
pub(crate) use rigid::{Mean, Stiff};

/// The model of a deck.
#[derive(Default)]
pub(crate) struct DeckModel {
    pub points: Vec<Point>,
    deck: Deck,
    grids: Grids,
    pub solids: Vec<Solid>,
    pub plates: Vec<Plate>,
    pub beams: Vec<Line>,
    pub rods: Vec<Line>,
    pub tips: Vec<Tip>,
    pub springs: Vec<Scalar>,
    pub bushes: Vec<Bush>,
    pub stiff: Vec<Stiff>,
    pub means: Vec<Mean>,
    pub materials: HashMap<u64, Stuff>,
    /// Material of each property of solids.
    pub of_solids: HashMap<u64, u64>,
    pub of_plates: HashMap<u64, Plating>,
    pub of_beams: HashMap<u64, Bending>,
    pub of_rods: HashMap<u64, RodSection>,
    /// Stiffness and damping of scalar springs.
    pub of_springs: HashMap<u64, [f64; 2]>,
    /// Stiffnesses and dampings of bushings.
    pub of_bushes: HashMap<u64, [[f64; 6]; 2]>,
    /// Direction of the first plane of beams whose cards leave it blank.
    default_up: Option<Up>,
    /// Mass in the unit of the equations of motion for one in that of the cards, `PARAM,WTMASS`.
    pub mass_factor: f64,
    /// Angular frequencies (rad/s) of the solver, which an OUTPUT2 file may have.
    pub frequencies: Vec<f64>,
    /// Cards that are not carried, with their numbers.
    pub left_out: BTreeMap<String, usize>,
    /// What carried cards have beyond what is carried, with the numbers of the cards.
    pub simplified: BTreeMap<&'static str, usize>,
}

impl DeckModel {
    /// Reads a deck with the files that it includes.
    ///
    /// # Errors
    /// [`MatrixError`] says what is wrong, in which file and on which line.
    pub fn read(file: &Path, bytes: &[u8]) -> Result<Self, MatrixError> {
        let deck = Deck::read(file, bytes)?;
        let mut model = Self { mass_factor: 1.0, ..Self::default() };
        for card in cards_of(deck.bulk(), |name| !name.is_empty()) {
            card.and_then(|card| model.take(&card)).map_err(|fault| deck.located(fault))?;
        }
        model.points = model.grids.points().map_err(|fault| deck.located(fault))?;
        model.resolve_directions().map_err(|fault| deck.located(fault))?;
        if deck.superelements() > 0 {
            model.left_out.insert("BEGIN SUPER".into(), deck.superelements());
        }
        model.deck = deck.places();
        model.frequencies = op2::frequencies(bytes);
        if op2::lacks_parameters(bytes) {
            model.simplify("the file has no parameters: PARAM,WTMASS is taken as 1, else choose `mass_unit`");
        }
        Ok(model)
    }

    /// The error of a problem on a line of the deck.
    pub fn located(&self, fault: LocatedProblem) -> MatrixError {
        self.deck.located(fault)
    }

    fn take(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        if self.grids.take(card)? {
            return Ok(());
        }
        let name = card.name.to_ascii_uppercase();
        if name == "PARAM" {
            if card.field(2).text.eq_ignore_ascii_case("WTMASS") {
                self.mass_factor = real_or(card.field(3), 1.0)?;
            }
            return Ok(());
        }
        let carried = self.element(card, &name)? || self.property(card, &name)? || self.rigid(card, &name)?;
        if !carried && !ANALYSIS.contains(&name.as_str()) {
            *self.left_out.entry(name.chars().take(8).collect()).or_default() += 1;
        }
        Ok(())
    }

    /// Counts something that is left out.
    pub fn leave_out(&mut self, what: &str) {
        *self.left_out.entry(what.to_owned()).or_default() += 1;
    }

    /// Notes that a card has something that is not carried.
    pub fn simplify(&mut self, what: &'static str) {
        *self.simplified.entry(what).or_default() += 1;
    }

    /// What is left out or carried in part, in words.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.left_out.is_empty() {
            let counted = self.left_out.iter().map(|(name, count)| format!("{count} {name}"));
            notes.push(format!("left out: {}", counted.collect::<Vec<_>>().join(", ")));
        }
        notes.extend(self.simplified.iter().map(|(what, count)| format!("{what} ({count})")));
        notes
    }
}

/// Cards that say what to compute or print, and nothing of the body.
const ANALYSIS: [&str; 10] =
    ["EIGRL", "EIGR", "EIGB", "EIGC", "PLOTEL", "EPOINT", "FREQ1", "TSTEP", "NLPARM", "DOPTPRM"];
