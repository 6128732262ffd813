//! Couplings: nodes that follow a reference node, or a reference node that follows the mean of others; rigid bodies and multi-point constraints.

use std::collections::{BTreeMap, HashMap, HashSet};

use quasirigid_math::vec3::{cross, dot, minus, norm, scale, unit};

use super::Reader;
use super::faces::Surface;
use super::fields::{fields, range, real};
use crate::deck::{BASIC, Equations, Mean, Stiff, Term, across};
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
        let from = |a: [f64; 3], b: [f64; 3]| minus(b, a);
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

    /// *MPC of the types BEAM, TIE, PIN, LINK and LINEAR, the first node of which follows the others; sets of equal size node by node.
    fn points_tied(&mut self, placed: &Placed, at: usize) -> Result<(), LocatedProblem> {
        let turned = self.turned();
        let solid: HashSet<u64> =
            self.model.solids.iter().flat_map(|solid| solid.nodes.iter().copied()).collect();
        let mut all = Vec::new();
        for index in 0..self.cards[at].lines.len() {
            let (line, text) = self.cards[at].lines[index].clone();
            let fields = fields(&text);
            let kind = fields.first().copied().unwrap_or_default().to_ascii_uppercase();
            let names = &fields[1.min(fields.len())..];
            if let "PLANE" | "STRAIGHT" = kind.as_str() {
                let nodes =
                    names.iter().map(|name| self.nodes(placed, name, line)).collect::<Result<Vec<_>, _>>()?;
                let nodes: Vec<u64> = nodes.into_iter().flatten().filter(|node| *node != 0).collect();
                self.in_line(&nodes, if kind == "PLANE" { 3 } else { 2 }, line);
                continue;
            }
            if names.len() != if kind == "LINEAR" { 3 } else { 2 } {
                self.model.leave_out(&format!("*MPC {kind}"));
                continue;
            }
            let sets =
                names.iter().map(|name| self.nodes(placed, name, line)).collect::<Result<Vec<_>, _>>()?;
            let count = sets[0].len();
            if sets.iter().any(|set| set.len() != count && set.len() != 1) {
                self.model.leave_out(&format!("*MPC {kind} of unequal sets"));
                continue;
            }
            let nodes = |number: usize| sets.iter().map(|set| set[number % set.len()]).collect();
            all.extend((0..count).map(|number| (kind.clone(), nodes(number), line)));
        }
        let mut bases: HashMap<u64, usize> = HashMap::new();
        all.iter()
            .for_each(|(_, nodes, _): &(String, Vec<u64>, usize)| *bases.entry(nodes[1]).or_default() += 1);
        for (kind, nodes, line) in all {
            let turns = |node: u64| self.node_of.get(&node).is_none_or(|node| turned.contains(node));
            let both = turns(nodes[0]) && turns(nodes[1]);
            let pinned = !turns(nodes[1]) && bases[&nodes[1]] == 1 && solid.contains(&nodes[1]);
            self.points_tied_once(&kind, &nodes, [both, pinned], line);
        }
        Ok(())
    }

    /// A rigid beam whose base nothing else turns keeps the distance of its ends, and nothing more.
    fn points_tied_once(&mut self, kind: &str, nodes: &[u64], [both, pinned]: [bool; 2], line: usize) {
        let (node, base) = (nodes[0], nodes[1]);
        match (kind, self.together(node, base)) {
            ("PIN", true) => return self.one_place([node, base], false, line),
            ("TIE", true) => return self.one_place([node, base], both, line),
            ("BEAM", true) if pinned => return self.one_place([node, base], false, line),
            ("BEAM", false) if pinned => return self.link([node, base], line),
            ("BEAM", _) => {
                self.model
                    .simplify("*MPC BEAM are rigid, as in Abaqus; in CalculiX they only keep distances");
            }
            ("TIE" | "PIN", false) => {
                return self.model.leave_out(&format!("*MPC {kind} of nodes that lie apart"));
            }
            ("LINK", false) => return self.link([node, base], line),
            ("LINEAR", _) => return self.between(node, [base, nodes[2]], line),
            _ => return self.model.leave_out(&format!("*MPC {kind}")),
        }
        self.model.stiff.push(Stiff { base, nodes: vec![node], components: [true; 6], line });
    }

    /// Two nodes at one place that move, and rotate, as one.
    fn one_place(&mut self, [node, other]: [u64; 2], rotates: bool, line: usize) {
        let sum = |rotates: bool, axis: [f64; 3]| {
            let term = |node, factor| Term { node, rotates, along: scale(factor, axis) };
            vec![term(node, 1.0), term(other, -1.0)]
        };
        let kinds: &[bool] = if rotates { &[false, true] } else { &[false] };
        let sums = kinds.iter().flat_map(|rotates| BASIC.map(|axis| sum(*rotates, axis))).collect();
        self.model.equations.push(Equations { follower: None, sums, line });
    }

    /// Nodes that stay on the straight line through the first two, or in the plane through the first three.
    fn in_line(&mut self, nodes: &[u64], count: usize, line: usize) {
        let places: Option<Vec<[f64; 3]>> = nodes.iter().map(|node| self.place(*node)).collect();
        let Some((places, true)) = places.map(|places| (places, nodes.len() > count)) else {
            return self.model.leave_out("*MPC PLANE or STRAIGHT of nodes that are not there");
        };
        let first = minus(places[1], places[0]);
        let second = if count == 3 { minus(places[2], places[0]) } else { [0.0; 3] };
        let across = if count == 3 { vec![cross(first, second)] } else { square_to(first) };
        for (node, place) in nodes.iter().zip(&places).skip(count) {
            let away = minus(*place, places[0]);
            // shares of the sides by their duals in the plane, or along the line
            let [s, t] = match count {
                3 => {
                    let normal = across[0];
                    let square = dot(normal, normal);
                    [dot(cross(away, second), normal) / square, dot(cross(first, away), normal) / square]
                }
                _ => [dot(away, first) / dot(first, first), 0.0],
            };
            let shares = [1.0 - s - t, s, t];
            let sum = |axis: &[f64; 3]| {
                let axis = unit(*axis);
                let term = |node, factor| Term { node, rotates: false, along: scale(factor, axis) };
                let bases = nodes[..count].iter().zip(shares).map(|(node, share)| term(*node, -share));
                [term(*node, 1.0)].into_iter().chain(bases).collect()
            };
            let sums = across.iter().map(sum).collect();
            self.model.equations.push(Equations { follower: None, sums, line });
        }
    }

    /// Two nodes whose distance stays.
    pub(super) fn link(&mut self, [node, other]: [u64; 2], line: usize) {
        let (Some(from), Some(to)) = (self.place(other), self.place(node)) else {
            return self.model.leave_out("*MPC LINK of nodes that are not there");
        };
        let along = minus(to, from);
        let along = unit(along);
        let term = |node, along| Term { node, rotates: false, along };
        let sums = vec![vec![term(node, along), term(other, scale(-1.0, along))]];
        self.model.equations.push(Equations { follower: None, sums, line });
    }

    /// A node on the line between two others.
    fn between(&mut self, node: u64, [a, b]: [u64; 2], line: usize) {
        let (Some(here), Some(from), Some(to)) = (self.place(node), self.place(a), self.place(b)) else {
            return self.model.leave_out("*MPC LINEAR of nodes that are not there");
        };
        let (side, away) = (minus(to, from), minus(here, from));
        let share = if dot(side, side) > 0.0 { dot(away, side) / dot(side, side) } else { 0.0 };
        let sum = |axis: [f64; 3]| {
            let term = |node, factor| Term { node, rotates: false, along: scale(factor, axis) };
            vec![term(node, 1.0), term(a, share - 1.0), term(b, -share)]
        };
        let sums = BASIC.map(sum).into();
        self.model.equations.push(Equations { follower: Some(node), sums, line });
    }

    pub(super) fn place(&self, label: u64) -> Option<[f64; 3]> {
        self.node_of.get(&label).map(|at| self.inp.mesh.nodes[*at])
    }

    /// Whether two nodes are at one place.
    pub(super) fn together(&self, a: u64, b: u64) -> bool {
        let (Some(a), Some(b)) = (self.place(a), self.place(b)) else { return false };
        norm(minus(a, b)) <= TOGETHER * norm(a).max(norm(b))
    }
}

/// Two directions across a third.
fn square_to(along: [f64; 3]) -> Vec<[f64; 3]> {
    let first = cross(along, across(along));
    vec![first, cross(along, first)]
}
