//! Finite-element model of a deck, whatever program wrote it: grid points, elements with properties and materials, bodies, links and grid
//! points that follow others, by their numbers. `nastran::model` and `inp` read it, `model::part::deck` makes a part of it.

mod cells;
mod elements;
mod layers;
mod places;
mod properties;
pub(crate) mod sections;
mod taper;

use std::collections::{BTreeMap, HashMap};

use crate::matrix::error::{MatrixError, MatrixProblem};
use crate::matrix::listed::LocatedProblem;
pub(crate) use cells::{Cells, edges};
pub(crate) use elements::{
    Axial, Bush, Equations, Line, Mean, Plate, Scalar, Solid, SpringEnd, Stiff, Term, Tip, Up,
};
pub(crate) use layers::OfPly;
pub(crate) use places::{Places, Run};
pub(crate) use properties::{Bending, Laminate, Plating, Ply, RodSection, Station, Stuff};
pub(crate) use taper::Piece;

/// What is left out of every format alike, since the ground holds nothing of a body afloat.
pub(crate) const TO_GROUND: &str = "springs, dashpots, bushings and connectors to the ground";

/// Axes of the basic system.
pub(crate) const BASIC: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Axis of the basic system that is the least parallel to a direction.
pub(crate) fn across(direction: [f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|a, b| direction[*a].abs().total_cmp(&direction[*b].abs()));
    BASIC[least.unwrap_or(0)]
}

/// A grid point in the basic system.
#[derive(Clone, Copy)]
pub(crate) struct Point {
    pub label: u64,
    pub place: [f64; 3],
    /// Unit vectors along which its displacements count; none for those of the basic system.
    pub axes: Option<[[f64; 3]; 3]>,
}

/// The model of a deck.
#[derive(Default)]
pub(crate) struct DeckModel {
    /// Grid points, in ascending order of their labels.
    pub points: Vec<Point>,
    pub solids: Vec<Solid>,
    pub plates: Vec<Plate>,
    pub beams: Vec<Line>,
    pub rods: Vec<Line>,
    pub tips: Vec<Tip>,
    pub springs: Vec<Scalar>,
    pub axials: Vec<Axial>,
    pub bushes: Vec<Bush>,
    pub stiff: Vec<Stiff>,
    pub means: Vec<Mean>,
    pub equations: Vec<Equations>,
    pub materials: HashMap<u64, Stuff>,
    /// Material of each property of solids.
    pub of_solids: HashMap<u64, u64>,
    /// Axes 1, 2, 3 of the material of solids, by property.
    pub axes_of_solids: HashMap<u64, [[f64; 3]; 3]>,
    /// The same for single solids, by index.
    pub axes_at_solids: HashMap<usize, [[f64; 3]; 3]>,
    /// Plies of laminated solids, by property.
    pub laminates: HashMap<u64, Laminate>,
    pub of_plates: HashMap<u64, Plating>,
    pub of_beams: HashMap<u64, Bending>,
    pub of_rods: HashMap<u64, RodSection>,
    /// Stiffness and damping of scalar springs.
    pub of_springs: HashMap<u64, [f64; 2]>,
    /// Stiffnesses and dampings of bushings.
    pub of_bushes: HashMap<u64, [[f64; 6]; 2]>,
    /// Names of properties and materials where the deck has them.
    pub names: BTreeMap<u64, String>,
    /// Mass in the unit of the equations of motion for one in that of the cards, `PARAM,WTMASS`.
    pub mass_factor: f64,
    /// Angular frequencies (rad/s) of the solver, which an OUTPUT2 file may have.
    pub frequencies: Vec<f64>,
    /// Cards that are not carried, with their numbers.
    pub left_out: BTreeMap<String, usize>,
    /// What carried cards have beyond what is carried, with the numbers of the cards.
    pub simplified: BTreeMap<&'static str, usize>,
    /// Files and lines of the cards.
    pub places: Places,
}

impl DeckModel {
    /// A model without anything.
    pub fn new() -> Self {
        Self { mass_factor: 1.0, ..Self::default() }
    }

    /// A grid point by its number.
    pub fn point(&self, label: u64, line: usize) -> Result<Point, LocatedProblem> {
        let at = self.points.partition_point(|point| point.label < label);
        let point = self.points.get(at).filter(|point| point.label == label).copied();
        point.ok_or((line, MatrixProblem::NoGrid { node: label }))
    }

    /// The error of a problem on a line of the deck.
    pub fn located(&self, fault: LocatedProblem) -> MatrixError {
        self.places.located(fault)
    }

    /// Counts something that is left out.
    pub fn leave_out(&mut self, what: &str) {
        self.leave_out_all(what, 1);
    }

    /// Counts things that are left out.
    pub fn leave_out_all(&mut self, what: &str, count: usize) {
        if count == 0 {
            return;
        }
        *self.left_out.entry(what.to_owned()).or_default() += count;
    }

    /// Notes that a card has something that is not carried.
    pub fn simplify(&mut self, what: &'static str) {
        self.simplify_all(what, 1);
    }

    /// Notes how many things are carried otherwise than a card says.
    pub fn simplify_all(&mut self, what: &'static str, count: usize) {
        if count > 0 {
            *self.simplified.entry(what).or_default() += count;
        }
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
