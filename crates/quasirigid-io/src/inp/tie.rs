//! *TIE: nodes of a surface follow the nearest points of the faces of another one. A point of a triangle is the mean of its corners by its
//! barycentric coordinates, so that the tie strains nothing when the body moves as a whole, also where the surfaces lie apart.

use std::collections::{HashMap, HashSet};

use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use super::Reader;
use super::faces::Surface;
use super::fields::{fields, real};
use crate::deck::{Mean, Stiff};
use crate::matrix::listed::LocatedProblem;

/// Distance over the size of a face within which nodes are tied, where the card gives none.
const NEAR: f64 = 0.05;
/// Least weight of a corner where the node lies off the face: its rotation needs all three.
const LEAST: f64 = 1e-3;
/// Distance over the size of a face up to which a node is on it, or at its corner.
const ON: f64 = 1e-6;

/// Triangles of a surface, in a grid of boxes as wide as the largest of them.
struct Triangles {
    corners: Vec<[usize; 3]>,
    boxes: HashMap<[i64; 3], Vec<usize>>,
    width: f64,
}

impl Reader {
    pub(super) fn read_ties(&mut self) -> Result<(), LocatedProblem> {
        let plates = self.model.plates.iter().flat_map(|plate| plate.nodes.iter().copied());
        let turned: HashSet<u64> = plates.chain(self.model.beams.iter().flat_map(|beam| beam.ends)).collect();
        for at in self.cards(&["TIE"]) {
            let card = &self.cards[at];
            let line = card.line;
            let tolerance = card.parameter("POSITION TOLERANCE").map(|text| real(text, line)).transpose()?;
            for placed in self.placed(card.scope) {
                for index in 0..self.cards[at].lines.len() {
                    let (line, text) = self.cards[at].lines[index].clone();
                    let names = fields(&text);
                    let [slave, master, ..] = names[..] else { continue };
                    let (slave, master) =
                        (self.surface(&placed, slave, line)?, self.surface(&placed, master, line)?);
                    self.tie([&slave, &master], tolerance, &turned, line);
                }
            }
        }
        Ok(())
    }

    fn tie(
        &mut self,
        [slave, master]: [&Surface; 2],
        tolerance: Option<f64>,
        turned: &HashSet<u64>,
        line: usize,
    ) {
        let triangles = Triangles::new(self, master);
        let own = master.all();
        let (mut apart, mut tied) = (0, 0);
        for node in slave.all() {
            if own.binary_search(&node).is_ok() {
                continue;
            }
            let near = if triangles.corners.is_empty() {
                self.nearest_node(node, &master.nodes, tolerance)
            } else {
                triangles.nearest(self, node, tolerance)
            };
            let label = self.inp.mesh.node_labels[node];
            match near {
                Some(weights) => {
                    tied += 1;
                    self.follow(label, weights, turned, line);
                }
                None => apart += 1,
            }
        }
        if apart > 0 {
            self.model.leave_out_all("nodes of *TIE beyond its tolerance", apart);
        }
        if tied > 0 {
            self.model.simplify("nodes of *TIE follow the nearest triangle of the other surface");
        }
    }

    /// The node follows the mean of others; one at the place of another one that plates or beams turn is one piece with it.
    fn follow(&mut self, node: u64, weights: Vec<(usize, f64)>, turned: &HashSet<u64>, line: usize) {
        let label = |at: usize| self.inp.mesh.node_labels[at];
        let moves = [true, true, true, false, false, false];
        let others: Vec<_> = weights.iter().map(|(at, weight)| (*weight, moves, vec![label(*at)])).collect();
        match weights[..] {
            [(at, _)] if turned.contains(&node) && turned.contains(&label(at)) => {
                let stiff = Stiff { base: label(at), nodes: vec![node], components: [true; 6], line };
                self.model.stiff.push(stiff);
            }
            _ => self.model.means.push(Mean { node, components: [true; 6], others, line }),
        }
    }

    /// The nearest of nodes, within the tolerance.
    fn nearest_node(
        &self,
        node: usize,
        others: &[usize],
        tolerance: Option<f64>,
    ) -> Option<Vec<(usize, f64)>> {
        let places = &self.inp.mesh.nodes;
        let distance = |other: usize| norm(add(places[other], scale(-1.0, places[node])));
        let nearest = others.iter().copied().min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
        let limit = tolerance.unwrap_or(ON * norm(places[node]));
        (distance(nearest) <= limit).then(|| vec![(nearest, 1.0)])
    }
}

impl Triangles {
    fn new(reader: &Reader, surface: &Surface) -> Self {
        let mut corners = Vec::new();
        for face in &surface.faces {
            let count = face.corners;
            if face.nodes.len() < 2 * count {
                let fan = |at: usize| [face.nodes[0], face.nodes[at], face.nodes[at + 1]];
                corners.extend((1..count - 1).map(fan));
                continue;
            }
            let middle = |at: usize| face.nodes[count + at % count];
            corners.extend((0..count).map(|at| [face.nodes[at], middle(at), middle(at + count - 1)]));
            corners.extend((1..count - 1).map(|at| [middle(0), middle(at), middle(at + 1)]));
        }
        let places = &reader.inp.mesh.nodes;
        let mut width: f64 = 0.0;
        for [a, b, c] in &corners {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                width = width.max(norm(add(places[*from], scale(-1.0, places[*to]))));
            }
        }
        let mut boxes: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        for (index, triangle) in corners.iter().enumerate() {
            let centre = triangle.iter().fold([0.0; 3], |sum, node| add(sum, places[*node]));
            boxes.entry(key(scale(1.0 / 3.0, centre), width)).or_default().push(index);
        }
        Self { corners, boxes, width }
    }

    /// Weights of the corners of the nearest triangle, within the tolerance.
    fn nearest(&self, reader: &Reader, node: usize, tolerance: Option<f64>) -> Option<Vec<(usize, f64)>> {
        let places = &reader.inp.mesh.nodes;
        let point = places[node];
        let [x, y, z] = key(point, self.width);
        let mut best: Option<(f64, [usize; 3], [f64; 3])> = None;
        for at in 0..27 {
            let near = [x + at % 3 - 1, y + at / 3 % 3 - 1, z + at / 9 - 1];
            for triangle in self.boxes.get(&near).into_iter().flatten() {
                let corners = self.corners[*triangle];
                let (distance, weights) = closest(point, corners.map(|corner| places[corner]));
                if best.is_none_or(|(least, ..)| distance < least) {
                    best = Some((distance, corners, weights));
                }
            }
        }
        let (distance, corners, mut weights) = best?;
        if distance > tolerance.unwrap_or(NEAR * self.width).max(ON * self.width) {
            return None;
        }
        if distance > ON * self.width {
            weights = weights.map(|weight| weight.max(LEAST));
        }
        let weighted = corners.into_iter().zip(weights).filter(|(_, weight)| *weight > ON);
        Some(weighted.collect())
    }
}

fn key(place: [f64; 3], width: f64) -> [i64; 3] {
    place.map(|x| if width > 0.0 { (x / width).floor() as i64 } else { 0 })
}

/// Distance of a point from a triangle, and the barycentric coordinates of the nearest point.
fn closest(point: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> (f64, [f64; 3]) {
    let minus = |p: [f64; 3], q: [f64; 3]| add(p, scale(-1.0, q));
    let (ab, ac, ap) = (minus(b, a), minus(c, a), minus(point, a));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let v = dot(cross(ap, ac), normal) / square;
    let w = dot(cross(ab, ap), normal) / square;
    let inside = [1.0 - v - w, v, w];
    if square > 0.0 && inside.iter().all(|weight| *weight >= 0.0) {
        return (dot(ap, normal).abs() / square.sqrt(), inside);
    }
    // on an edge or at a corner
    let corners = [a, b, c];
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        let (edge, away) = (minus(corners[to], corners[from]), minus(point, corners[from]));
        let length = dot(edge, edge);
        let share = if length > 0.0 { (dot(edge, away) / length).clamp(0.0, 1.0) } else { 0.0 };
        let distance = norm(minus(away, scale(share, edge)));
        if distance < best.0 {
            let mut weights = [0.0; 3];
            weights[from] = 1.0 - share;
            weights[to] += share;
            best = (distance, weights);
        }
    }
    best
}
