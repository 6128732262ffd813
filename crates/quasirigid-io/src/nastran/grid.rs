//! Grid points of NASTRAN in the basic system, each with the axes of its displacements.

use std::collections::HashMap;

use super::bulk::{Card, Field, integer, integer_or, real_or_zero};
use super::systems::{Grid, System, Systems};
use crate::deck::Point;
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;

/// Cards of grid points and systems as they come up.
#[derive(Default)]
pub(crate) struct Grids {
    pub systems: Systems,
    /// Systems of coordinates and displacements where a card leaves them blank.
    defaults: [u64; 2],
    /// Grid points by label; those of blank systems are noted.
    grids: HashMap<u64, Grid>,
    /// Label, system of the coordinates and of the displacements, in order; none where the card is blank.
    listed: Vec<(u64, [Option<u64>; 2])>,
}

/// A system of a field: none in a blank one. −1 marks a fluid point.
fn system(field: Field) -> Result<Option<u64>, LocatedProblem> {
    match field.text {
        "" => Ok(None),
        "-1" => Ok(Some(0)),
        _ => integer(field, Row::Grid).map(Some),
    }
}

impl Grids {
    /// Takes a card of a grid point, of the defaults or of a system; false for another card.
    pub fn take(&mut self, card: &Card) -> Result<bool, LocatedProblem> {
        let name = card.name.to_ascii_uppercase();
        match name.as_str() {
            "GRID" => self.add(card)?,
            "GRDSET" => {
                self.defaults =
                    [integer_or(card.field(3), 0, Row::Grid)?, integer_or(card.field(7), 0, Row::Grid)?];
            }
            _ if super::systems::CARDS.contains(&name.as_str()) => self.systems.define(card)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn add(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Grid)?;
        let systems = [system(card.field(3))?, system(card.field(7))?];
        let coordinates =
            [real_or_zero(card.field(4))?, real_or_zero(card.field(5))?, real_or_zero(card.field(6))?];
        let grid = Grid { system: systems[0].unwrap_or(0), coordinates, line: card.line };
        match self.grids.insert(label, grid) {
            Some(other) if other.coordinates != coordinates || other.system != grid.system => {
                Err((card.line, MatrixProblem::NodeTwice { node: label }))
            }
            Some(_) => Ok(()), // the same card twice, as files that include each other have it
            None => {
                self.listed.push((label, systems));
                Ok(())
            }
        }
    }

    /// A system by its number.
    pub fn system(&mut self, label: u64, line: usize) -> Result<System, LocatedProblem> {
        self.systems.system(label, &self.grids, line)
    }

    /// The points, in ascending order of their labels.
    pub fn points(&mut self) -> Result<Vec<Point>, LocatedProblem> {
        let [places, displacements] = self.defaults;
        for (label, systems) in &self.listed {
            if let (None, Some(grid)) = (systems[0], self.grids.get_mut(label)) {
                grid.system = places;
            }
        }
        self.listed.sort_unstable_by_key(|(label, _)| *label);
        let mut points = Vec::with_capacity(self.listed.len());
        for (label, systems) in &self.listed {
            let Some(grid) = self.grids.get(label) else { continue };
            let place = self.systems.place(grid, &self.grids)?;
            if let Some(x) = place.iter().find(|x| !x.is_finite()) {
                return Err((grid.line, MatrixProblem::NotFinite { found: x.to_string().into() }));
            }
            let axes = match systems[1].unwrap_or(displacements) {
                0 => None,
                system => Some(self.systems.system(system, &self.grids, grid.line)?.axes_at(place)),
            };
            points.push(Point { label: *label, place, axes });
        }
        Ok(points)
    }
}
