//! Bodies at grid points, and the grid points that a part keeps.

use std::sync::Arc;

use quasirigid_elements::{Bar, Coupling, ElasticMaterial, Mixed, NodeBody};
use quasirigid_math::vec3::scale;
use quasirigid_mesh::{Cell, Mesh, Shape};

use super::super::super::table::Table;
use super::{Made, box_around};
use crate::deck::{BASIC, Tip};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Most frequencies that a note lists.
const LISTED: usize = 8;

impl Made {
    /// Bodies, which need nodes that something holds.
    pub(super) fn bodies(&mut self) -> Result<Vec<NodeBody>, LocatedProblem> {
        let mut bodies = Vec::new();
        let [mass_unit, length] = [self.given.units.mass * self.deck.mass_factor, self.given.units.length];
        for tip in &self.deck.tips {
            let Tip { node, mass, offset, inertia, line, .. } = *tip;
            let node = self.of(node, line)?;
            let offset = scale(length, self.given.placement.turned(offset));
            let columns = BASIC.map(|axis| self.given.placement.turned(axis));
            let turned: [[f64; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let sum: f64 =
                        (0..9).map(|k| columns[k / 3][i] * inertia[k / 3][k % 3] * columns[k % 3][j]).sum();
                    mass_unit * length * length * sum
                })
            });
            bodies.push(NodeBody { node, mass: mass_unit * mass, offset, inertia: turned });
        }
        Ok(bodies)
    }

    pub(super) fn mesh(&self) -> Arc<Mesh> {
        Arc::new(Mesh {
            nodes: self.nodes.clone(),
            node_labels: self.labels.clone(),
            cells: self.cells.clone(),
            sets: Vec::new(),
        })
    }

    /// Refuses a deck without elements or without mass.
    pub(super) fn is_body(&self) -> Result<(), LocatedProblem> {
        let Mixed { mesh, regions, skins, bars, bodies, .. } = &self.mixed;
        if mesh.cells.is_empty() && bodies.is_empty() {
            return Err((0, MatrixProblem::NoElements));
        }
        let layers = skins.iter().flat_map(|skin| &skin.layers);
        let materials =
            regions.iter().map(|region| &region.material).chain(layers.map(|layer| &layer.material));
        let heavy = materials.map(ElasticMaterial::density).any(|density| density > 0.0)
            || bars.iter().any(|bar| bar.material.density > 0.0)
            || !bodies.is_empty();
        if heavy { Ok(()) } else { Err((0, MatrixProblem::NoMass)) }
    }

    /// Takes the bodies that something holds, and leaves out the nodes that belong to nothing.
    pub(super) fn finish(&mut self, bodies: Vec<NodeBody>) {
        let turned = {
            let mixed = Mixed { mesh: self.mesh(), ..self.mixed.clone() };
            mixed.turned()
        };
        let mut used = vec![false; self.nodes.len()];
        for cell in self.cells.iter().filter(|cell| cell.shape.dimension() > 1) {
            cell.nodes.iter().for_each(|node| used[*node] = true);
        }
        self.mixed.bars.iter().flat_map(|bar| bar.ends).for_each(|node| used[node] = true);
        self.mixed.links.iter().flat_map(|link| link.nodes).for_each(|node| used[node] = true);
        for coupling in &self.mixed.couplings {
            used[coupling.node()] = true;
            match coupling {
                Coupling::Rigid { base, .. } => used[*base] = true,
                Coupling::Mean { others, .. } => others.iter().for_each(|other| used[other.node] = true),
                Coupling::Linear { rows, .. } => {
                    rows.iter().flat_map(|(_, terms)| terms).for_each(|term| used[term.node] = true);
                }
            }
        }
        let mut kept = Vec::new();
        for mut body in bodies {
            if !used[body.node] || !(body.mass > 0.0) {
                let what = if used[body.node] { "bodies without mass" } else { "bodies that nothing holds" };
                self.deck.leave_out(what);
                continue;
            }
            if !turned[body.node] && (body.offset != [0.0; 3] || body.inertia != [[0.0; 3]; 3]) {
                self.deck
                    .simplify("bodies at points without rotations have no offset and no moments of inertia");
                (body.offset, body.inertia) = ([0.0; 3], [[0.0; 3]; 3]);
            }
            kept.push(body);
        }
        self.mixed.bodies = kept;
        let loose = used.iter().filter(|used| !**used).count();
        if loose > 0 {
            self.notes.push(format!("grid points that belong to no element are kept aside ({loose})"));
        }
        self.renumber(&used);
    }

    /// Leaves out the nodes that are not used.
    fn renumber(&mut self, used: &[bool]) {
        let mut next = 0;
        let place: Vec<usize> = used
            .iter()
            .map(|used| {
                let here = next;
                next += usize::from(*used);
                here
            })
            .collect();
        let keep = |index: &usize| used[*index];
        let nodes = (0..used.len()).filter(keep).map(|node| self.nodes[node]).collect();
        let node_labels = (0..used.len()).filter(keep).map(|node| self.labels[node]).collect();
        let mixed = &mut self.mixed;
        for bar in &mut mixed.bars {
            bar.ends = bar.ends.map(|node| place[node]);
        }
        for body in &mut mixed.bodies {
            body.node = place[body.node];
        }
        for link in &mut mixed.links {
            link.nodes = link.nodes.map(|node| place[node]);
        }
        for coupling in &mut mixed.couplings {
            match coupling {
                Coupling::Rigid { node, base, .. } => (*node, *base) = (place[*node], place[*base]),
                Coupling::Mean { node, others } => {
                    *node = place[*node];
                    others.iter_mut().for_each(|other| other.node = place[other.node]);
                }
                Coupling::Linear { node, rows } => {
                    *node = place[*node];
                    rows.iter_mut()
                        .flat_map(|(_, terms)| terms)
                        .for_each(|term| term.node = place[term.node]);
                }
            }
        }
        // Lines of the deck are bars, between nodes of their own where they have offsets: they are drawn as such.
        let mut cells: Vec<Cell> = Vec::new();
        for cell in self.cells.iter().filter(|cell| cell.shape.dimension() > 1) {
            let nodes = cell.nodes.iter().map(|node| place[*node]).collect();
            cells.push(Cell { label: cell.label, shape: cell.shape, nodes });
        }
        if cells.is_empty() {
            let line = |(number, bar): (u64, &Bar)| Cell {
                label: number,
                shape: Shape::Line2,
                nodes: bar.ends.into(),
            };
            cells.extend((1..).zip(&mixed.bars).map(line));
        }
        let mut mesh = Mesh { nodes, node_labels, cells, sets: Vec::new() };
        let turned = mesh.turn_right_side_out();
        if turned > 0 {
            self.notes.push(format!(
                "cells inside out are turned, their nodes in the order of their shape ({turned})"
            ));
        }
        mixed.mesh = Arc::new(mesh);
    }

    /// What is left out or changed, and the size that the units give.
    pub(super) fn notes(&mut self, table: &Table<'_>) -> Vec<String> {
        let mut notes = self.deck.notes();
        notes.append(&mut self.notes);
        let stuffs = self.deck.materials.values();
        let light = stuffs.filter(|stuff| stuff.density() == 0.0).count();
        if let Some(density) = self.given.density.filter(|_| light > 0) {
            notes.push(format!("materials without a density have {density} kg/m³ of `density` ({light})"));
        }
        if self.deck.mass_factor != 1.0 {
            notes.push(format!("masses are multiplied by PARAM,WTMASS = {}", self.deck.mass_factor));
        }
        let all = &self.deck.frequencies;
        if !all.is_empty() {
            let hertz = |omega: &f64| format!("{:.4}", omega / std::f64::consts::TAU);
            let first: Vec<String> = all.iter().take(LISTED).map(hertz).collect();
            let more = if all.len() > LISTED { ", …" } else { "" };
            notes.push(format!(
                "NASTRAN found {} modes, under its supports: {}{more} Hz",
                all.len(),
                first.join(", ")
            ));
        }
        if table.get("length_unit").is_none() || table.get("mass_unit").is_none() {
            let [x, y, z] = box_around(&self.mixed.mesh.nodes);
            notes.push(format!(
                "taken in metres and kilograms where `length_unit` and `mass_unit` say nothing: {x:.3} by {y:.3} by {z:.3} m"
            ));
        }
        notes
    }
}
