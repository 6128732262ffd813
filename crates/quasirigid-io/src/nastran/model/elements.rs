//! Elements of a deck: solids, plates, beams, rods, bodies at grid points, springs and bushings.

use super::Reader;
use crate::deck::{Bush, Line, Plate, Scalar, Solid, SpringEnd, Tip, Up};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{Card, Field, integer, integer_or, real_or, real_or_zero};

/// Coordinate systems by whose axes elements count, until the systems are known: the index of the element, and the system.
#[derive(Default)]
pub(super) struct Turned {
    plates: Vec<(usize, u64)>,
    /// None for places of the basic system instead of offsets.
    tips: Vec<(usize, Option<u64>)>,
    bushes: Vec<(usize, u64)>,
}

/// Grid points of edges in the order of the shape, from that of NASTRAN, which has the upright edges before the upper ones.
fn in_order(corners: usize, nodes: Vec<u64>) -> Vec<u64> {
    let order: &[usize] = match corners {
        6 => &[0, 1, 2, 6, 7, 8, 3, 4, 5],
        8 => &[0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7],
        _ => return nodes,
    };
    let middles = order.iter().map(|middle| nodes[corners + middle]);
    nodes[..corners].iter().copied().chain(middles).collect()
}

/// Grid points of a card from a field on, as many as the shape may have; zeros where they are blank.
fn nodes(card: &Card, first: usize, most: usize) -> Result<Vec<u64>, LocatedProblem> {
    (first..first + most).map(|number| integer_or(card.field(number), 0, Row::Element)).collect()
}

fn vector(card: &Card, first: usize) -> Result<[f64; 3], LocatedProblem> {
    Ok([
        real_or_zero(card.field(first))?,
        real_or_zero(card.field(first + 1))?,
        real_or_zero(card.field(first + 2))?,
    ])
}

/// Direction in three fields, the first of which may name a grid point instead.
fn up(card: &Card, first: usize) -> Result<Option<Up>, LocatedProblem> {
    let field = card.field(first);
    let blank = (first..first + 3).all(|number| card.field(number).text.is_empty());
    if blank {
        return Ok(None);
    }
    if !field.text.is_empty() && !field.text.contains('.') && card.field(first + 1).text.is_empty() {
        return Ok(Some(Up::Point(integer(field, Row::Element)?)));
    }
    Ok(Some(Up::Vector(vector(card, first)?)))
}

/// A field that may be the real angle of a material or the number of a system.
fn angle(field: Field) -> Result<(f64, Option<u64>), LocatedProblem> {
    if field.text.is_empty() || field.text.contains('.') {
        return Ok((real_or_zero(field)?, None));
    }
    Ok((0.0, Some(integer(field, Row::Element)?)))
}

impl Reader {
    /// Takes the card of an element; false for another card.
    pub(super) fn element(&mut self, card: &Card, name: &str) -> Result<bool, LocatedProblem> {
        match name {
            "CTETRA" => self.solid(card, 4, 10)?,
            "CPYRAM" | "CPYRA" => self.solid(card, 5, 13)?,
            "CPENTA" => self.solid(card, 6, 15)?,
            "CHEXA" => self.solid(card, 8, 20)?,
            "CTRIA3" | "CTRIAR" => self.plate(card, 3, 3, 7)?,
            "CQUAD4" | "CQUADR" => self.plate(card, 4, 4, 8)?,
            "CTRIA6" => self.plate(card, 3, 6, 10)?,
            "CQUAD8" => self.plate(card, 4, 8, 16)?,
            "CQUAD" => self.plate(card, 4, 8, 13)?,
            "CBAR" | "CBEAM" => self.beam(card)?,
            "BAROR" | "BEAMOR" => self.default_up = up(card, 6)?,
            "CROD" | "CTUBE" => self.rod(card)?,
            "CONROD" => self.own_rod(card)?,
            "CONM2" => self.tip(card)?,
            "CELAS1" | "CDAMP1" => {
                let law = Err(integer(card.field(3), Row::Element)?);
                self.scalar(card, law, 4)?;
            }
            "CELAS2" => {
                let stiffness = real_or_zero(card.field(3))?;
                self.scalar(card, Ok([stiffness, 0.0]), 4)?;
            }
            "CDAMP2" => {
                let damping = real_or_zero(card.field(3))?;
                self.scalar(card, Ok([0.0, damping]), 4)?;
            }
            "CBUSH" => self.bush(card)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn solid(&mut self, card: &Card, corners: usize, most: usize) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Element)?;
        let property = integer_or(card.field(3), label, Row::Element)?;
        let nodes = nodes(card, 4, most)?;
        if nodes[..corners].contains(&0) {
            return Err((card.line, MatrixProblem::NoCorner { element: label }));
        }
        let nodes = in_order(corners, nodes);
        self.model.solids.push(Solid { label, property, corners, nodes, line: card.line });
        Ok(())
    }

    /// A plate whose angle stands in a field, with the offset behind it.
    fn plate(&mut self, card: &Card, corners: usize, most: usize, at: usize) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Element)?;
        let property = integer_or(card.field(3), label, Row::Element)?;
        let nodes = nodes(card, 4, most)?;
        if nodes[..corners].contains(&0) {
            return Err((card.line, MatrixProblem::NoCorner { element: label }));
        }
        let (angle, system) = angle(card.field(at))?;
        let offset = real_or_zero(card.field(at + 1))?;
        let thicknesses = match at {
            7 | 10 => 12..15,
            13 => 12..12, // its field 12 is a point in the middle
            _ => 12..16,
        };
        let given = thicknesses.filter(|number| !card.field(*number).text.is_empty());
        let given = given.map(|number| real_or_zero(card.field(number))).collect::<Result<Vec<f64>, _>>()?;
        // Thicknesses relative to that of the property are one where they are alike.
        let relative = at != 10 && at != 16 && card.field(11).text == "1";
        let thickness = if given.is_empty() || relative {
            None
        } else {
            if given.len() < corners || given.iter().any(|other| *other != given[0]) {
                self.model.simplify("plates with thicknesses at their corners have the mean of those");
            }
            Some(given.iter().sum::<f64>() / given.len() as f64)
        };
        if relative && given.iter().any(|share| *share != 1.0) {
            self.model.simplify("relative thicknesses at the corners of plates (TFLAG) are left out");
        }
        if let Some(system) = system {
            self.turned.plates.push((self.model.plates.len(), system));
        }
        let (reference, line) = (None, card.line);
        let plate = Plate { label, property, corners, nodes, angle, reference, offset, thickness, line };
        self.model.plates.push(plate);
        Ok(())
    }

    fn beam(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Element)?;
        let property = integer_or(card.field(3), label, Row::Element)?;
        let ends = [integer(card.field(4), Row::Element)?, integer(card.field(5), Row::Element)?];
        let released =
            [integer_or(card.field(10), 0, Row::Element)?, integer_or(card.field(11), 0, Row::Element)?];
        let offsets = [vector(card, 12)?, vector(card, 15)?];
        let coordinates = card.field(9).text;
        let own = |text: &str| !text.is_empty() && !text.contains('.') && !text.eq_ignore_ascii_case("GGG");
        if own(coordinates) && offsets != [[0.0; 3]; 2] {
            self.model.simplify(
                "offsets of beams along their own axes (OFFT) are taken along those of the grid points",
            );
        }
        if [18, 19].iter().any(|number| !matches!(card.field(*number).text, "" | "0")) {
            self.model.simplify("warping of beams is left out");
        }
        let up = match up(card, 6)? {
            Some(Up::Vector(vector)) if coordinates.starts_with(['B', 'b']) => Some(Up::Basic(vector)),
            up => up,
        };
        self.model.beams.push(Line { label, property, ends, up, offsets, released, line: card.line });
        Ok(())
    }

    fn rod(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Element)?;
        let property = integer_or(card.field(3), label, Row::Element)?;
        let ends = [integer(card.field(4), Row::Element)?, integer(card.field(5), Row::Element)?];
        self.push_rod(label, property, ends, card.line);
        Ok(())
    }

    fn push_rod(&mut self, label: u64, property: u64, ends: [u64; 2], line: usize) {
        let (offsets, released) = ([[0.0; 3]; 2], [0; 2]);
        self.model.rods.push(Line { label, property, ends, up: None, offsets, released, line });
    }

    /// A rod with its own section, which gets a property of a number that no card can have.
    fn own_rod(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Element)?;
        let ends = [integer(card.field(3), Row::Element)?, integer(card.field(4), Row::Element)?];
        let property = u64::MAX - self.model.rods.len() as u64;
        self.rod_section(card, property, 5, 6, 7)?;
        self.push_rod(label, property, ends, card.line);
        Ok(())
    }

    fn tip(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let node = integer(card.field(3), Row::Element)?;
        let system = match card.field(4).text {
            "-1" => None,
            _ => Some(integer_or(card.field(4), 0, Row::Element)?),
        };
        let mass = real_or_zero(card.field(5))?;
        let offset = vector(card, 6)?;
        let moment = |number: usize| real_or_zero(card.field(number));
        let [xx, xy, yy, xz, yz, zz] =
            [moment(10)?, moment(11)?, moment(12)?, moment(13)?, moment(14)?, moment(15)?];
        // NASTRAN gives the products of inertia, which the tensor has with the other sign.
        let inertia = [[xx, -xy, -xz], [-xy, yy, -yz], [-xz, -yz, zz]];
        self.turned.tips.push((self.model.tips.len(), system));
        self.model.tips.push(Tip { node, mass, offset, inertia, line: card.line });
        Ok(())
    }

    /// A spring or dashpot whose ends stand in four fields.
    fn scalar(
        &mut self,
        card: &Card,
        law: Result<[f64; 2], u64>,
        first: usize,
    ) -> Result<(), LocatedProblem> {
        let end = |number: usize| -> Result<Option<SpringEnd>, LocatedProblem> {
            let node = integer_or(card.field(number), 0, Row::Element)?;
            let component = integer_or(card.field(number + 1), 0, Row::Element)?;
            Ok((node != 0).then_some(SpringEnd { node, component }))
        };
        let ends = [end(first)?, end(first + 2)?];
        self.model.springs.push(Scalar { ends, law, line: card.line });
        Ok(())
    }

    fn bush(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let label = integer(card.field(2), Row::Element)?;
        let property = integer_or(card.field(3), label, Row::Element)?;
        let ends = [integer(card.field(4), Row::Element)?, integer_or(card.field(5), 0, Row::Element)?];
        if !matches!(card.field(9).text, "" | "-1") {
            self.turned.bushes.push((self.model.bushes.len(), integer(card.field(9), Row::Element)?));
        }
        if !matches!(card.field(11).text, "" | "-1") {
            self.model.simplify("places of bushings by OCID are left out, they are taken between their ends");
        }
        let share = real_or(card.field(10), 0.5)?;
        let up = up(card, 6)?;
        self.model.bushes.push(Bush { property, ends, up, axes: None, share, line: card.line });
        Ok(())
    }

    /// Resolves the directions that cards give in coordinate systems.
    pub(super) fn resolve_directions(&mut self) -> Result<(), LocatedProblem> {
        let Turned { plates, tips, bushes } = std::mem::take(&mut self.turned);
        for (index, system) in plates {
            let Plate { nodes, line, .. } = &self.model.plates[index];
            let (first, line) = (nodes[0], *line);
            self.model.plates[index].reference = Some(self.axes_at(system, first, line)?[0]);
        }
        for beam in &mut self.model.beams {
            beam.up = beam.up.or(self.default_up);
        }
        for (index, system) in tips {
            let Tip { node, offset, inertia, line, .. } = self.model.tips[index];
            let place = self.model.point(node, line)?.place;
            let Some(system) = system else {
                self.model.tips[index].offset = [0, 1, 2].map(|axis| offset[axis] - place[axis]);
                continue;
            };
            if system == 0 {
                continue;
            }
            let axes = self.axes_at(system, node, line)?;
            let turned: [[f64; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    (0..9).map(|k| axes[k / 3][i] * inertia[k / 3][k % 3] * axes[k % 3][j]).sum()
                })
            });
            self.model.tips[index].inertia = turned;
            self.model.tips[index].offset =
                [0, 1, 2].map(|axis| (0..3).map(|k| axes[k][axis] * offset[k]).sum());
        }
        for (index, system) in bushes {
            let Bush { ends, line, .. } = self.model.bushes[index];
            if ends[1] != 0 {
                self.model.bushes[index].axes = Some(self.axes_at(system, ends[0], line)?);
            }
        }
        Ok(())
    }

    /// Axes of a coordinate system at a grid point.
    fn axes_at(&mut self, system: u64, node: u64, line: usize) -> Result<[[f64; 3]; 3], LocatedProblem> {
        let place = self.model.point(node, line)?.place;
        Ok(self.grids.system(system, line)?.axes_at(place))
    }
}
