//! Rigid elements, springs and bushings of a deck.

use quasirigid_elements::{Coupling, Mixed, NodeLink, Strain, Weighted};
use quasirigid_math::vec3::{add, cross, minus, norm, scale, unit};

use super::{Made, along, box_around};
use crate::deck::{Axial, BASIC, Bush, Mean, Scalar, SpringEnd, Stiff, TO_GROUND, Up, across};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Force of a unit spring, and its moment over the size of the deck, up to which it holds nothing of the whole: the digits of cards.
pub(super) const AFLOAT: f64 = 1e-6;

impl Made {
    pub(super) fn couplings(&mut self) -> Result<(), LocatedProblem> {
        let turned = Mixed { mesh: self.mesh(), ..self.mixed.clone() }.turned();
        for index in 0..self.deck.stiff.len() {
            let Stiff { base, components, line, .. } = self.deck.stiff[index];
            if components[..3] != [true; 3] {
                self.deck.leave_out("rigid elements in some of the displacements");
                continue;
            }
            let base = self.of(base, line)?;
            for label in self.deck.stiff[index].nodes.clone() {
                let node = self.of(label, line)?;
                let axes = self.axes(label, line)?;
                let turns = turned.get(node).copied().unwrap_or(false);
                let free =
                    (0..3).filter(|axis| turns && !components[3 + axis]).map(|axis| axes[axis]).collect();
                if node != base {
                    self.follow(Coupling::Rigid { node, base, free });
                }
            }
        }
        for index in 0..self.deck.means.len() {
            let Mean { node, components, line, .. } = self.deck.means[index];
            if components[..3] != [true; 3] {
                self.deck.leave_out("means in some of the displacements");
                continue;
            }
            let node = self.of(node, line)?;
            let mut others = Vec::new();
            for other in 0..self.deck.means[index].others.len() {
                let (weight, which, labels) = self.deck.means[index].others[other].clone();
                for label in labels {
                    let axes = self.axes(label, line)?;
                    let at = self.of(label, line)?;
                    let turns = turned.get(at).copied().unwrap_or(false);
                    let of = |first: usize| -> Vec<[f64; 3]> {
                        (0..3).filter(|axis| which[first + axis]).map(|axis| axes[axis]).collect()
                    };
                    let rotations = if turns { of(3) } else { Vec::new() };
                    let weighted = Weighted { node: at, weight, displacements: of(0), rotations };
                    if at != node && weight > 0.0 {
                        others.push(weighted);
                    }
                }
            }
            self.follow(Coupling::Mean { node, others });
        }
        for (node, ends) in std::mem::take(&mut self.tied) {
            let of = |(node, weight): (usize, f64)| {
                let (displacements, rotations) = (BASIC.to_vec(), Vec::new());
                Weighted { node, weight, displacements, rotations }
            };
            self.follow(Coupling::Mean { node, others: ends.map(of).to_vec() });
        }
        Ok(())
    }

    /// Adds a coupling of a node that does not follow yet.
    fn follow(&mut self, coupling: Coupling) {
        if !self.following.insert(coupling.node()) {
            self.deck.leave_out("rigid elements of a point that follows another one already");
        } else {
            self.mixed.couplings.push(coupling);
        }
    }

    pub(super) fn links(&mut self) -> Result<(), LocatedProblem> {
        for index in 0..self.deck.springs.len() {
            let Scalar { ends, ref law, line } = self.deck.springs[index];
            let law = match law {
                Ok(law) => *law,
                Err(label) => {
                    let no = (line, MatrixProblem::NoCardOf { kind: "property", label: *label });
                    *self.deck.of_springs.get(label).ok_or(no)?
                }
            };
            let [Some(from), Some(to)] = ends else {
                self.deck.leave_out(TO_GROUND);
                continue;
            };
            if [from, to]
                .iter()
                .any(|end| !self.index.contains_key(&end.node) || !(1..=6).contains(&end.component))
            {
                self.deck.leave_out("springs of scalar points");
                continue;
            }
            let shares = [self.shares(from, -1.0, line)?, self.shares(to, 1.0, line)?];
            let nodes = [self.of(from.node, line)?, self.of(to.node, line)?];
            if nodes[0] == nodes[1] {
                self.deck.leave_out("springs between components of one point");
                continue;
            }
            if self.resists_the_whole(nodes, &shares) {
                self.deck
                    .leave_out("springs that a motion of the whole body strains, as if held to the ground");
                continue;
            }
            let [stiffness, damping] = law.map(|value| value * self.given.units.mass);
            self.mixed.links.push(NodeLink { nodes, strains: vec![Strain { shares, stiffness, damping }] });
        }
        for index in 0..self.deck.axials.len() {
            self.axial(index)?;
        }
        for index in 0..self.deck.bushes.len() {
            self.bush(index)?;
        }
        Ok(())
    }

    /// A spring along the line between two nodes.
    fn axial(&mut self, index: usize) -> Result<(), LocatedProblem> {
        let Axial { ends: labels, law, line } = self.deck.axials[index];
        if labels.contains(&0) {
            self.deck.leave_out(TO_GROUND);
            return Ok(());
        }
        let nodes = [self.of(labels[0], line)?, self.of(labels[1], line)?];
        let between = minus(self.nodes[nodes[1]], self.nodes[nodes[0]]);
        if !(norm(between) > 0.0) {
            self.deck.leave_out("springs along a line of no length");
            return Ok(());
        }
        let [x, y, z] = unit(between);
        let shares = [[-x, -y, -z, 0.0, 0.0, 0.0], [x, y, z, 0.0, 0.0, 0.0]];
        let [stiffness, damping] = law.map(|value| value * self.given.units.mass);
        self.mixed.links.push(NodeLink { nodes, strains: vec![Strain { shares, stiffness, damping }] });
        Ok(())
    }

    /// Shares of the six components of a node in the strain of a scalar spring; a rotation counts in units of the deck's length.
    fn shares(&self, end: SpringEnd, sign: f64, line: usize) -> Result<[f64; 6], LocatedProblem> {
        let axes = self.axes(end.node, line)?;
        let (first, axis) = ((end.component as usize - 1) / 3 * 3, (end.component as usize - 1) % 3);
        let unit = if first == 3 { self.given.units.length } else { 1.0 };
        let mut shares = [0.0; 6];
        for (along, share) in axes[axis].iter().enumerate() {
            shares[first + along] = sign * unit * share;
        }
        Ok(shares)
    }

    /// Whether a motion of the whole body strains a link: no spring inside it does that, but one across the line between two points would.
    fn resists_the_whole(&self, nodes: [usize; 2], shares: &[[f64; 6]; 2]) -> bool {
        let first = self.nodes[nodes[0]];
        let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
        for (node, [x, y, z, about @ ..]) in nodes.into_iter().zip(shares) {
            let (along, arm) = ([*x, *y, *z], minus(self.nodes[node], first));
            force = add(force, along);
            moment = add(moment, add(cross(arm, along), *about));
        }
        norm(force) > AFLOAT || norm(moment) > AFLOAT * norm(box_around(&self.nodes))
    }

    fn bush(&mut self, index: usize) -> Result<(), LocatedProblem> {
        let Bush { property, ends: labels, up, axes, share, line } = self.deck.bushes[index];
        if labels[1] == 0 {
            self.deck.leave_out(TO_GROUND);
            return Ok(());
        }
        let no = (line, MatrixProblem::NoCardOf { kind: "property", label: property });
        let laws = *self.deck.of_bushes.get(&property).ok_or(no)?;
        let nodes = [self.of(labels[0], line)?, self.of(labels[1], line)?];
        let places = nodes.map(|node| self.nodes[node]);
        let between = minus(places[1], places[0]);
        let axes = match axes {
            Some(axes) => axes.map(|axis| self.given.placement.turned(axis)),
            None if norm(between) > 0.0 => {
                let first_axes = self.axes(labels[0], line)?;
                let up = match up {
                    Some(Up::Vector(vector)) => along(&first_axes, vector),
                    Some(Up::Basic(vector)) => self.given.placement.turned(vector),
                    Some(Up::Point(label)) => minus(self.nodes[self.of(label, line)?], places[0]),
                    None => BASIC[0],
                };
                let x = unit(between);
                let z = cross(x, up);
                let z = if norm(z) > 1e-9 * norm(up) { z } else { cross(x, across(x)) };
                let z = unit(z);
                [x, cross(z, x), z]
            }
            None => {
                self.deck.simplify("CBUSH between points at one place without CID has the basic axes");
                BASIC.map(|axis| self.given.placement.turned(axis))
            }
        };
        let centre = add(places[0], scale(share, between));
        let [mass, length] = [self.given.units.mass, self.given.units.length];
        let mut strains = Vec::new();
        for component in 0..6 {
            let axis = axes[component % 3];
            let unit = if component < 3 { mass } else { mass * length * length };
            let [stiffness, damping] = [0, 1].map(|law| unit * laws[law][component]);
            if stiffness == 0.0 && damping == 0.0 {
                continue;
            }
            let mut shares = [[0.0; 6]; 2];
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                let arm = minus(centre, places[end]);
                let (along, about) = if component < 3 { (axis, cross(arm, axis)) } else { ([0.0; 3], axis) };
                for k in 0..3 {
                    shares[end][k] = sign * along[k];
                    shares[end][3 + k] = sign * about[k];
                }
            }
            strains.push(Strain { shares, stiffness, damping });
        }
        if !strains.is_empty() {
            self.mixed.links.push(NodeLink { nodes, strains });
        }
        Ok(())
    }
}
