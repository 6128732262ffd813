//! Couplings: nodes that follow a reference node, or a reference node that follows the mean of others; rigid bodies and multi-point constraints.

use std::collections::BTreeMap;

use quasirigid_math::vec3::{add, cross, norm, scale};

use super::Reader;
use super::faces::Surface;
use super::fields::{fields, range, real};
use crate::deck::{Mean, Stiff};
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::Placed;

/// Displacements without rotations.
const MOVES: [bool; 6] = [true, true, true, false, false, false];
/// Distance of two nodes over their coordinates up to which they are at one place.
const TOGETHER: f64 = 1e-6;

impl Reader {
    pub(super) fn read_couplings(&mut self) -> Result<(), LocatedProblem> {
        const NAMES: &[&str] = &[
            "COUPLING",
            "KINEMATIC",
            "DISTRIBUTING",
            "KINEMATIC COUPLING",
            "DISTRIBUTING COUPLING",
            "RIGID BODY",
            "MPC",
        ];
        let mut coupling = None;
        for at in self.cards(NAMES) {
            let card = &self.cards[at];
            let name = card.name.clone();
            for placed in self.placed(card.scope) {
                match (name.as_str(), coupling) {
                    ("KINEMATIC", Some(before)) => self.kinematic(&placed, before, at)?,
                    ("DISTRIBUTING", Some(before)) => self.distributing(&placed, before, at)?,
                    ("KINEMATIC COUPLING", _) => self.kinematic_list(&placed, at)?,
                    ("DISTRIBUTING COUPLING", _) => self.distributing_list(&placed, at)?,
                    ("RIGID BODY", _) => self.rigid_body(&placed, at)?,
                    ("MPC", _) => self.points_tied(&placed, at)?,
                    _ => {}
                }
            }
            match name.as_str() {
                "COUPLING" => coupling = Some(at),
                "KINEMATIC" | "DISTRIBUTING" => coupling = None,
                _ => {}
            }
        }
        Ok(())
    }

    /// Reference node and surface of a *COUPLING.
    fn coupled(&self, placed: &Placed, at: usize) -> Result<(u64, Surface), LocatedProblem> {
        let card = &self.cards[at];
        let node = self.node(placed, card.parameter("REF NODE").unwrap_or_default(), card.line)?;
        let surface = self.surface(placed, card.parameter("SURFACE").unwrap_or_default(), card.line)?;
        Ok((node, surface))
    }

    fn labels_of(&self, nodes: &[usize]) -> Vec<u64> {
        nodes.iter().map(|node| self.inp.mesh.node_labels[*node]).collect()
    }

    /// Degrees of freedom on the lines of a card; all where it has none.
    fn freedoms(&self, at: usize) -> Result<[bool; 6], LocatedProblem> {
        let mut components = [false; 6];
        for (line, text) in &self.cards[at].lines {
            let range = range(&fields(text), *line)?;
            components.iter_mut().zip(range).for_each(|(known, new)| *known |= new);
        }
        Ok(if components == [false; 6] { [true; 6] } else { components })
    }

    fn kinematic(&mut self, placed: &Placed, coupling: usize, at: usize) -> Result<(), LocatedProblem> {
        let (base, surface) = self.coupled(placed, coupling)?;
        let (nodes, components) = (self.labels_of(&surface.all()), self.freedoms(at)?);
        self.model.stiff.push(Stiff { base, nodes, components, line: self.cards[at].line });
        Ok(())
    }

    /// The mean of a surface, by the areas that belong to its nodes.
    fn distributing(&mut self, placed: &Placed, coupling: usize, at: usize) -> Result<(), LocatedProblem> {
        let (node, surface) = self.coupled(placed, coupling)?;
        let mut weights: BTreeMap<usize, f64> = BTreeMap::new();
        for face in &surface.faces {
            let share = self.area(&face.nodes[..face.corners]) / face.nodes.len() as f64;
            face.nodes.iter().for_each(|node| *weights.entry(*node).or_default() += share);
        }
        surface.nodes.iter().for_each(|node| *weights.entry(*node).or_default() += 1.0);
        let label = |(node, weight): (usize, f64)| (weight, MOVES, vec![self.inp.mesh.node_labels[node]]);
        let others = weights.into_iter().map(label).collect();
        let components = self.freedoms(at)?;
        self.model.means.push(Mean { node, components, others, line: self.cards[at].line });
        Ok(())
    }

    /// Area of a triangle or of a quadrilateral by its diagonals.
    fn area(&self, corners: &[usize]) -> f64 {
        let place = |at: usize| self.inp.mesh.nodes[corners[at]];
        let from = |a: [f64; 3], b: [f64; 3]| add(b, scale(-1.0, a));
        match corners.len() {
            3 => 0.5 * norm(cross(from(place(0), place(1)), from(place(0), place(2)))),
            4 => 0.5 * norm(cross(from(place(0), place(2)), from(place(1), place(3)))),
            _ => 0.0,
        }
    }

    /// *KINEMATIC COUPLING, with nodes and their degrees of freedom on its lines.
    fn kinematic_list(&mut self, placed: &Placed, at: usize) -> Result<(), LocatedProblem> {
        let card = &self.cards[at];
        let base = self.node(placed, card.parameter("REF NODE").unwrap_or_default(), card.line)?;
        let mut lists: BTreeMap<[bool; 6], Vec<u64>> = BTreeMap::new();
        for (line, text) in &card.lines {
            let fields = fields(text);
            let nodes = self.nodes(placed, fields.first().copied().unwrap_or_default(), *line)?;
            lists.entry(range(&fields[1..], *line)?).or_default().extend(nodes);
        }
        let line = card.line;
        for (components, nodes) in lists {
            self.model.stiff.push(Stiff { base, nodes, components, line });
        }
        Ok(())
    }

    /// *DISTRIBUTING COUPLING of the node of an element, with nodes and weights on its lines.
    fn distributing_list(&mut self, placed: &Placed, at: usize) -> Result<(), LocatedProblem> {
        let card = &self.cards[at];
        let line = card.line;
        let elements = self.elements(placed, card.parameter("ELSET").unwrap_or_default(), line)?;
        let mut others = Vec::new();
        for (line, text) in &card.lines {
            let fields = fields(text);
            let nodes = self.nodes(placed, fields.first().copied().unwrap_or_default(), *line)?;
            let weight = fields.get(1).map_or(Ok(1.0), |weight| real(weight, *line))?;
            others.push((weight, MOVES, nodes));
        }
        for element in elements.others {
            let Some(node) = self.inp.others.all[element].nodes.first().copied() else { continue };
            self.model.means.push(Mean { node, components: [true; 6], others: others.clone(), line });
        }
        Ok(())
    }

    fn rigid_body(&mut self, placed: &Placed, at: usize) -> Result<(), LocatedProblem> {
        let card = &self.cards[at];
        let line = card.line;
        let Some(reference) = card.parameter("REF NODE") else {
            self.model.leave_out("*RIGID BODY without a reference node");
            return Ok(());
        };
        let base = self.node(placed, reference, line)?;
        let mut lists = Vec::new();
        for (key, components) in [("NSET", [true; 6]), ("TIE NSET", [true; 6]), ("PIN NSET", MOVES)] {
            if let Some(name) = card.parameter(key) {
                lists.push((components, self.nodes(placed, name, line)?));
            }
        }
        if let Some(name) = card.parameter("ELSET") {
            let members = self.elements(placed, name, line)?;
            let mut nodes: Vec<u64> = members.cells.iter().flat_map(|cell| self.labels(*cell)).collect();
            nodes.extend(members.others.iter().flat_map(|other| self.inp.others.all[*other].nodes.clone()));
            nodes.sort_unstable();
            nodes.dedup();
            lists.push(([true; 6], nodes));
        }
        if card.parameter("ROT NODE").is_some() {
            self.model.simplify("rotations of rigid bodies are those of their reference node (ROT NODE)");
        }
        for (components, nodes) in lists {
            self.model.stiff.push(Stiff { base, nodes, components, line });
        }
        Ok(())
    }

    /// *MPC of the types BEAM, TIE and PIN, the first node of which follows the second.
    fn points_tied(&mut self, placed: &Placed, at: usize) -> Result<(), LocatedProblem> {
        for index in 0..self.cards[at].lines.len() {
            let (line, text) = self.cards[at].lines[index].clone();
            let fields = fields(&text);
            let kind = fields.first().copied().unwrap_or_default().to_ascii_uppercase();
            let [_, first, second] = fields[..] else {
                self.model.leave_out(&format!("*MPC {kind}"));
                continue;
            };
            let (nodes, base) = (self.nodes(placed, first, line)?, self.node(placed, second, line)?);
            let apart = nodes.iter().any(|node| !self.together(*node, base));
            let components = match kind.as_str() {
                "BEAM" => [true; 6],
                "TIE" if !apart => [true; 6],
                "PIN" if !apart => MOVES,
                "TIE" | "PIN" => {
                    self.model.leave_out(&format!("*MPC {kind} of nodes that lie apart"));
                    continue;
                }
                _ => {
                    self.model.leave_out(&format!("*MPC {kind}"));
                    continue;
                }
            };
            self.model.stiff.push(Stiff { base, nodes, components, line });
        }
        Ok(())
    }

    /// Whether two nodes are at one place.
    pub(super) fn together(&self, a: u64, b: u64) -> bool {
        let place = |label: u64| self.node_of.get(&label).map(|at| self.inp.mesh.nodes[*at]);
        let (Some(a), Some(b)) = (place(a), place(b)) else { return false };
        norm(add(a, scale(-1.0, b))) <= TOGETHER * norm(a).max(norm(b))
    }
}
