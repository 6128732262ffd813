//! Elements of a deck: cells by their types and sections, bodies, springs and dashpots.

use std::collections::{BTreeMap, HashMap};

use quasirigid_math::vec3::{cross, minus, norm};
use quasirigid_mesh::Shape;

use super::Reader;
use super::fields::{fields, first, real, reals};
use super::orientation::Orientation;
use super::sections::SectionKind;
use crate::deck::{Axial, BASIC, Line, Plate, Scalar, Solid, SpringEnd, TO_GROUND, Tip, Up};
use crate::matrix::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::Placing;

/// Family of an element, by its type.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Solid,
    Plate,
    Beam { shear: bool },
    Rod,
    Other,
}

impl Family {
    fn of(name: &str) -> Self {
        match name {
            _ if name.starts_with("C3D") => Self::Solid,
            "S3" | "S4" | "S6" | "S8" | "S9" => Self::Plate,
            _ if name.starts_with("STRI") => Self::Plate,
            _ if name.starts_with('S') && name.as_bytes().get(1).is_some_and(u8::is_ascii_digit) => {
                Self::Plate
            }
            _ if name.starts_with("B33") => Self::Beam { shear: false },
            _ if name.starts_with('B') => Self::Beam { shear: true },
            _ if name.starts_with("T3D") => Self::Rod,
            _ => Self::Other,
        }
    }
}

impl Reader {
    pub(super) fn read_elements(&mut self) -> Result<(), LocatedProblem> {
        let thicknesses = self.nodal_thicknesses()?;
        let towards: HashMap<usize, u64> = self.inp.towards.iter().copied().collect();
        for cell in 0..self.inp.mesh.cells.len() {
            let name = &self.inp.types[usize::from(self.inp.type_of[cell])];
            let family = Family::of(name);
            if family == Family::Other {
                let what = format!("{name} elements");
                self.model.leave_out(&what);
                continue;
            }
            let Some(section) = self.section_of[cell] else {
                self.model.leave_out("elements without a section");
                continue;
            };
            let section = &self.sections[section];
            let (kind, placing, line) = (section.kind.clone(), section.placing, section.line);
            match (family, kind) {
                (Family::Solid, SectionKind::Solid { property, material, axes }) => {
                    self.solid(cell, (property, material), axes, &placing, line)?;
                }
                (Family::Rod, SectionKind::Solid { property, .. }) => {
                    self.lines(cell, property, None, line, Family::Rod);
                }
                (Family::Plate, SectionKind::Shell { property, axes, nodal }) => {
                    let thicknesses = nodal.then_some(&thicknesses);
                    self.plate(cell, property, axes, &placing, thicknesses, line)?;
                }
                (Family::Beam { shear }, SectionKind::Beam { properties, up }) => {
                    let up = match towards.get(&cell) {
                        Some(label) => Up::Point(*label),
                        None => Up::Basic(placing.turned(up)),
                    };
                    self.lines(cell, properties[usize::from(!shear)], Some(up), line, family);
                }
                _ => self.model.leave_out("elements with the section of another kind"),
            }
        }
        Ok(())
    }

    /// Numbers of the nodes of a cell.
    pub(super) fn labels(&self, cell: usize) -> Vec<u64> {
        let mesh = &self.inp.mesh;
        mesh.cells[cell].nodes.iter().map(|node| mesh.node_labels[*node]).collect()
    }

    fn solid(
        &mut self,
        cell: usize,
        (property, material): (u64, u64),
        axes: Option<Orientation>,
        placing: &Placing,
        line: usize,
    ) -> Result<(), LocatedProblem> {
        let nodes = self.labels(cell);
        let (label, shape) = (self.inp.mesh.cells[cell].label, self.inp.mesh.cells[cell].shape);
        let mut of = property;
        if let Some(orientation) = axes {
            let place = self.centre(cell);
            let axes = orientation.axes_at(place, placing)?;
            if !orientation.is_uniform() {
                of = self.property();
                self.model.of_solids.insert(of, material);
            }
            self.model.axes_of_solids.insert(of, axes);
        }
        let corners = shape.corners();
        self.model.solids.push(Solid { label, property: of, corners, nodes, line });
        Ok(())
    }

    /// Mean place of the corners of a cell.
    fn centre(&self, cell: usize) -> [f64; 3] {
        let mesh = &self.inp.mesh;
        let corners = &mesh.cells[cell].nodes[..mesh.cells[cell].shape.corners()];
        let mean = |axis: usize| corners.iter().map(|node| mesh.nodes[*node][axis]).sum::<f64>();
        [0, 1, 2].map(|axis| mean(axis) / corners.len() as f64)
    }

    fn plate(
        &mut self,
        cell: usize,
        property: u64,
        axes: Option<Orientation>,
        placing: &Placing,
        thicknesses: Option<&HashMap<u64, f64>>,
        line: usize,
    ) -> Result<(), LocatedProblem> {
        let shape = self.inp.mesh.cells[cell].shape;
        let mut nodes = self.labels(cell);
        // The node in the middle of S9 bears nothing of its own.
        nodes.truncate(if shape == Shape::Quad9 { 8 } else { nodes.len() });
        let reference = match axes {
            Some(orientation) => orientation.axes_at(self.centre(cell), placing)?[0],
            None => [1.0, 0.0, 0.0],
        };
        let thickness = thicknesses.and_then(|known| {
            let given: Vec<f64> = nodes.iter().filter_map(|node| known.get(node).copied()).collect();
            (!given.is_empty()).then(|| given.iter().sum::<f64>() / given.len() as f64)
        });
        let oriented = axes.is_some() || self.layered(property);
        self.model.plates.push(Plate {
            label: self.inp.mesh.cells[cell].label,
            property,
            corners: shape.corners(),
            nodes,
            angle: 0.0,
            reference: oriented.then_some(reference),
            offset: 0.0,
            thickness,
            line,
        });
        Ok(())
    }

    /// Whether the direction of the material of plates matters.
    fn layered(&self, property: u64) -> bool {
        use crate::deck::Stuff;
        self.model.of_plates.get(&property).is_some_and(|plating| {
            let stuff = |layer: &crate::deck::Ply| self.model.materials.get(&layer.material);
            plating.layers.iter().any(|layer| !matches!(stuff(layer), Some(Stuff::Isotropic { .. }) | None))
        })
    }

    /// Beams or rods of a cell: two for one with a node in its middle.
    fn lines(&mut self, cell: usize, property: u64, up: Option<Up>, line: usize, family: Family) {
        let label = self.inp.mesh.cells[cell].label;
        let nodes = self.labels(cell);
        let pieces = match nodes[..] {
            // A rod of two pieces would fold in its middle.
            [a, b, _] if family == Family::Rod => vec![[a, b]],
            [a, b, middle] => vec![[a, middle], [middle, b]],
            [a, b] => vec![[a, b]],
            _ => Vec::new(),
        };
        if pieces.len() == 2 {
            self.model.simplify("beams with a node in their middle are two straight ones");
        }
        for ends in pieces {
            let (offsets, released) = ([[0.0; 3]; 2], [0; 2]);
            let piece = Line { label, property, ends, up, offsets, released, line };
            match family {
                Family::Rod => self.model.rods.push(piece),
                _ => self.model.beams.push(piece),
            }
        }
    }

    /// Thickness at nodes.
    fn nodal_thicknesses(&self) -> Result<HashMap<u64, f64>, LocatedProblem> {
        let mut thicknesses = HashMap::new();
        for at in self.cards(&["NODAL THICKNESS"]) {
            let card = &self.cards[at];
            for placed in self.placed(card.scope) {
                for (line, text) in &card.lines {
                    let fields = fields(text);
                    let [name, thickness, ..] = fields[..] else { continue };
                    let thickness = real(thickness, *line)?;
                    let nodes = self.nodes(&placed, name, *line)?;
                    thicknesses.extend(nodes.into_iter().map(|node| (node, thickness)));
                }
            }
        }
        Ok(thicknesses)
    }

    /// Masses and moments of inertia at nodes; those of one node are one body.
    pub(super) fn read_bodies(&mut self) -> Result<(), LocatedProblem> {
        let mut bodies: BTreeMap<u64, Tip> = BTreeMap::new();
        for at in self.cards(&["MASS", "ROTARY INERTIA"]) {
            let card = &self.cards[at];
            let (line, is_mass) = (card.line, card.name == "MASS");
            let set = card.parameter("ELSET").unwrap_or_default();
            let axes = card.parameter("ORIENTATION").map(|name| self.orientation(name, line)).transpose()?;
            let numbers = first(card, if is_mass { 1 } else { 6 })?;
            for placed in self.placed(card.scope) {
                for other in self.elements(&placed, set, line)?.others {
                    let Some(node) = self.inp.others.all[other].nodes.first().copied() else { continue };
                    let zero = Tip { node, mass: 0.0, offset: [0.0; 3], inertia: [[0.0; 3]; 3], line };
                    let tip = bodies.entry(node).or_insert(zero);
                    if is_mass {
                        tip.mass += numbers[0];
                        continue;
                    }
                    let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|k| numbers[k]);
                    let own = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
                    let place = self.node_of.get(&node).map_or([0.0; 3], |at| self.inp.mesh.nodes[*at]);
                    let columns = match &axes {
                        Some(axes) => axes.axes_at(place, &placed.placing)?,
                        None => BASIC.map(|axis| placed.placing.turned(axis)),
                    };
                    for (i, row) in tip.inertia.iter_mut().enumerate() {
                        for (j, entry) in row.iter_mut().enumerate() {
                            *entry += (0..9)
                                .map(|k| columns[k / 3][i] * own[k / 3][k % 3] * columns[k % 3][j])
                                .sum::<f64>();
                        }
                    }
                }
            }
        }
        self.model.tips = bodies.into_values().collect();
        Ok(())
    }

    pub(super) fn read_springs(&mut self) -> Result<(), LocatedProblem> {
        let mut used = vec![false; self.inp.others.all.len()];
        for at in self.cards(&["SPRING", "DASHPOT"]) {
            let card = &self.cards[at];
            let (line, scope, is_spring) = (card.line, card.scope, card.name == "SPRING");
            let set = card.parameter("ELSET").unwrap_or_default().to_owned();
            let nonlinear = card.parameter("NONLINEAR").is_some();
            let axes = card.parameter("ORIENTATION").map(|name| self.orientation(name, line)).transpose()?;
            let lines = card.lines.clone();
            for placed in self.placed(scope) {
                for other in self.elements(&placed, &set, line)?.others {
                    used[other] = true;
                    let node = self.inp.others.all[other].nodes.first().copied().unwrap_or_default();
                    let place = self.place(node).unwrap_or_default();
                    let axes = axes.map(|axes| axes.axes_at(place, &placed.placing)).transpose()?;
                    let card = SpringCard { lines: &lines, is_spring, nonlinear, axes, line };
                    self.spring(other, &card)?;
                }
            }
        }
        for (index, used) in used.into_iter().enumerate() {
            let kind = &self.inp.types[usize::from(self.inp.others.all[index].kind)];
            let carried = ["MASS", "ROTARYI", "DCOUP3D"].contains(&kind.as_str());
            let rigid = kind.starts_with("R3D") || kind.starts_with("RB3D");
            if !used && !carried && !rigid && !kind.starts_with("CONN") {
                let what = format!("{kind} elements");
                self.model.leave_out(&what);
            }
        }
        Ok(())
    }

    /// A spring or dashpot with the lines of its card: degrees of freedom, unless it acts along its line, then the constant or a table.
    fn spring(&mut self, other: usize, card: &SpringCard<'_>) -> Result<(), LocatedProblem> {
        let element = &self.inp.others.all[other];
        let kind = self.inp.types[usize::from(element.kind)].as_str();
        let axial = kind.ends_with('A');
        let (freedoms, table) = if axial {
            (None, card.lines)
        } else {
            (card.lines.first(), card.lines.get(1..).unwrap_or_default())
        };
        let Some(first) = table.first() else {
            let row = crate::matrix::error::Row::InpCard;
            return Err((card.line, MatrixProblem::Values { found: 0, row }));
        };
        let constant = if card.nonlinear { slope_at_rest(table)? } else { reals(first)?.first().copied() };
        let Some(constant) = constant else {
            self.model.leave_out("nonlinear springs and dashpots without one slope at rest");
            return Ok(());
        };
        let law = if card.is_spring { [constant, 0.0] } else { [0.0, constant] };
        let line = card.line;
        if axial {
            let [a, b, ..] = element.nodes[..] else {
                self.model.leave_out(TO_GROUND);
                return Ok(());
            };
            self.model.axials.push(Axial { ends: [a, b], law, line });
        } else {
            let freedoms = freedoms.map(reals).transpose()?.unwrap_or_default();
            let end = |at: usize| -> Option<SpringEnd> {
                let node = *element.nodes.get(at)?;
                let component = *freedoms.get(at)? as u64;
                (node != 0).then_some(SpringEnd { node, component })
            };
            match (card.axes, end(0), end(1)) {
                (Some(axes), Some(from), Some(to)) => self.oriented([from, to], axes, law, line),
                (_, from, to) => self.model.springs.push(Scalar { ends: [from, to], law: Ok(law), line }),
            }
        }
        if card.nonlinear {
            self.model.simplify("nonlinear springs and dashpots have their slope at rest");
        }
        Ok(())
    }

    /// A spring in one component along given axes: between nodes at one place, or along the line between them.
    fn oriented(&mut self, [from, to]: [SpringEnd; 2], axes: [[f64; 3]; 3], law: [f64; 2], line: usize) {
        let nodes = [from.node, to.node];
        let (Some(a), Some(b)) = (self.place(from.node), self.place(to.node)) else {
            return self.model.leave_out("springs of nodes that are not there");
        };
        let component = from.component as usize;
        if component != to.component as usize || !(1..=6).contains(&component) {
            return self.model.leave_out("springs between different components along an orientation");
        }
        let between = minus(b, a);
        let across = norm(cross(axes[(component - 1) % 3], between));
        if self.together(from.node, to.node) || component > 3 {
            let laws = law.map(|law| std::array::from_fn(|k| if k + 1 == component { law } else { 0.0 }));
            self.bushing_of(nodes, axes, laws, 0.5, line);
        } else if across <= ALONG * norm(between) {
            self.model.axials.push(Axial { ends: nodes, law, line });
        } else {
            self.model.leave_out("springs that a motion of the whole body strains, as if held to the ground");
        }
    }
}

/// Sine of the angle up to which a spring acts along the line between its nodes.
const ALONG: f64 = 1e-6;

/// Lines of a card of springs or dashpots.
struct SpringCard<'a> {
    lines: &'a [(usize, String)],
    is_spring: bool,
    nonlinear: bool,
    /// Axes of its components; none for those of the nodes.
    axes: Option<[[f64; 3]; 3]>,
    line: usize,
}

/// Slope at zero of a table of forces and elongations, at its first temperature; none at a kink, or where the table does not reach.
fn slope_at_rest(table: &[(usize, String)]) -> Result<Option<f64>, LocatedProblem> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for row in table {
        let numbers = reals(row)?;
        let [force, elongation, ..] = numbers[..] else { return Ok(None) };
        if points.last().is_some_and(|last| !(elongation > last[1])) {
            break;
        }
        points.push([force, elongation]);
    }
    let slope = |pair: &[[f64; 2]]| (pair[1][0] - pair[0][0]) / (pair[1][1] - pair[0][1]);
    let about = |pair: &&[[f64; 2]]| pair[0][1] <= 0.0 && pair[1][1] >= 0.0;
    let slopes: Vec<f64> = points.windows(2).filter(about).map(slope).collect();
    let inner =
        points.first().is_some_and(|first| first[1] < 0.0) && points.last().is_some_and(|last| last[1] > 0.0);
    let one = slopes.iter().all(|slope| (slope - slopes[0]).abs() <= ALONG * slopes[0].abs());
    Ok(slopes.first().copied().filter(|_| inner && one))
}
