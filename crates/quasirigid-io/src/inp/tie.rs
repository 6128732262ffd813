//! *TIE: nodes of a surface follow the nearest points of the faces of another one, by the shape functions of the face. Where the surfaces
//! lie apart, the face also turns the gap, so that the tie strains nothing when the body moves as a whole.
//! Equation (K21), docs/theory/12-structures.md.

use std::collections::HashSet;

use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale, unit};
use quasirigid_mesh::Shape;
use quasirigid_mesh::surface::{NearestTriangles, nearest_weights};

use super::Reader;
use super::faces::Surface;
use super::fields::{fields, real};
use crate::deck::{BASIC, Equations, Term};
use crate::matrix::listed::LocatedProblem;

/// Distance over the size of a face within which nodes are tied, where the card gives none.
const NEAR: f64 = 0.05;
/// Distance over the size of a face up to which a node is on it, or at its corner.
const ON: f64 = 1e-6;
/// Steps towards the nearest point of a curved face: many times the number that a face needs.
const STEPS: usize = 20;

/// A face of an element, or a piece of a quadratic shell between its nodes.
struct Piece {
    shape: Shape,
    nodes: Vec<usize>,
}

/// Pieces of a surface, in triangles that find the nearest.
struct Pieces {
    pieces: Vec<Piece>,
    /// Piece of each triangle, and the places of its corners among the nodes of the piece.
    triangles: Vec<(usize, [usize; 3])>,
    nearest: NearestTriangles,
    /// The longest side.
    width: f64,
}

/// Point of a piece.
struct Point {
    piece: usize,
    /// Place on the reference cell.
    at: [f64; 3],
    /// From the point to the node that follows it.
    gap: [f64; 3],
}

impl Reader {
    pub(super) fn read_ties(&mut self) -> Result<(), LocatedProblem> {
        let turned = self.turned();
        for at in self.cards(&["TIE"]) {
            let card = &self.cards[at];
            let line = card.line;
            if let Some(kind) =
                ["CYCLIC SYMMETRY", "MULTISTAGE"].iter().find(|kind| card.parameter(kind).is_some())
            {
                self.model.leave_out(&format!("*TIE, {kind}"));
                continue;
            }
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

    /// Nodes whose rotations something turns.
    pub(super) fn turned(&self) -> HashSet<usize> {
        let plates = self.model.plates.iter().flat_map(|plate| plate.nodes.iter().copied());
        let beams = self.model.beams.iter().flat_map(|beam| beam.ends);
        let bodies = self.model.tips.iter().filter(|tip| tip.inertia != [[0.0; 3]; 3]).map(|tip| tip.node);
        let pieces = self.model.stiff.iter().map(|piece| piece.base);
        let means = self.model.means.iter().map(|mean| mean.node);
        let all = plates.chain(beams).chain(bodies).chain(pieces).chain(means);
        all.filter_map(|label| self.node_of.get(&label).copied()).collect()
    }

    fn tie(
        &mut self,
        [slave, master]: [&Surface; 2],
        tolerance: Option<f64>,
        turned: &HashSet<usize>,
        line: usize,
    ) {
        let pieces = Pieces::new(&self.inp.mesh.nodes, master);
        let own = master.all();
        let [mut apart, mut tied, mut gaps, mut flat] = [0; 4];
        for node in slave.all() {
            if own.binary_search(&node).is_ok() {
                continue;
            }
            let Some(pieces) = &pieces else {
                match self.at_node(node, &master.nodes, tolerance, turned) {
                    Some(sums) => {
                        tied += 1;
                        self.follow(node, sums, line);
                    }
                    None => apart += 1,
                }
                continue;
            };
            let places = &self.inp.mesh.nodes;
            let Some(point) = pieces.nearest(places, places[node], tolerance) else {
                apart += 1;
                continue;
            };
            gaps += usize::from(norm(point.gap) > ON * pieces.width);
            match self.on_face(node, &pieces.pieces[point.piece], &point, turned) {
                Some(sums) => {
                    tied += 1;
                    self.follow(node, sums, line);
                }
                None => flat += 1,
            }
        }
        self.model.leave_out_all("nodes of *TIE beyond its tolerance", apart);
        self.model.leave_out_all("nodes of *TIE on faces without area", flat);
        self.model.simplify_all("nodes of *TIE follow the nearest points of faces", tied);
        self.model.simplify_all("nodes of *TIE are turned with a face across a gap", gaps);
    }

    fn follow(&mut self, node: usize, sums: Vec<Vec<Term>>, line: usize) {
        let follower = Some(self.inp.mesh.node_labels[node]);
        self.model.equations.push(Equations { follower, sums, line });
    }

    fn term(&self, node: usize, rotates: bool, along: [f64; 3]) -> Term {
        Term { node: self.inp.mesh.node_labels[node], rotates, along }
    }

    /// Sums that hold a node at a point of a face, and its rotation to that of the face; none where the face has no area. (K21)
    fn on_face(
        &self,
        node: usize,
        piece: &Piece,
        point: &Point,
        turned: &HashSet<usize>,
    ) -> Option<Vec<Vec<Term>>> {
        let slopes = piece.slopes(&self.inp.mesh.nodes, point.at)?;
        let values = piece.shape.functions(point.at);
        let shell = piece.nodes.iter().all(|node| turned.contains(node));
        let parts = || piece.nodes.iter().zip(&values).zip(&slopes.of);
        let mut sums = Vec::new();
        for axis in BASIC {
            let turn = slopes.halved(cross(point.gap, axis));
            let shares = parts().map(|((other, value), slope)| {
                self.term(*other, false, scale(-1.0, add(scale(*value, axis), cross(turn, *slope))))
            });
            sums.push([self.term(node, false, axis)].into_iter().chain(shares).collect());
        }
        for axis in BASIC.into_iter().filter(|_| turned.contains(&node)) {
            let turn = slopes.halved(axis);
            let share = |((other, value), slope): ((&usize, &f64), &[f64; 3])| match shell {
                true => self.term(*other, true, scale(-value, axis)),
                false => self.term(*other, false, cross(*slope, turn)),
            };
            sums.push([self.term(node, true, axis)].into_iter().chain(parts().map(share)).collect());
        }
        Some(sums)
    }

    /// Sums that hold a node at the nearest of others, which turns it across a gap; none beyond the tolerance, or where nothing turns.
    fn at_node(
        &self,
        node: usize,
        others: &[usize],
        tolerance: Option<f64>,
        turned: &HashSet<usize>,
    ) -> Option<Vec<Vec<Term>>> {
        let places = &self.inp.mesh.nodes;
        let gap = |other: usize| minus(places[node], places[other]);
        let nearest = others.iter().copied().min_by(|a, b| norm(gap(*a)).total_cmp(&norm(gap(*b))))?;
        let (gap, on) = (gap(nearest), ON * norm(places[node]));
        let turns = turned.contains(&nearest);
        if norm(gap) > tolerance.unwrap_or(on).max(on) || (norm(gap) > on && !turns) {
            return None;
        }
        let mut sums = Vec::new();
        for axis in BASIC {
            let mut sum = vec![self.term(node, false, axis), self.term(nearest, false, scale(-1.0, axis))];
            if turns && gap != [0.0; 3] {
                sum.push(self.term(nearest, true, cross(axis, gap)));
            }
            sums.push(sum);
        }
        for axis in BASIC.into_iter().filter(|_| turns && turned.contains(&node)) {
            sums.push(vec![self.term(node, true, axis), self.term(nearest, true, scale(-1.0, axis))]);
        }
        Some(sums)
    }
}

/// Gradients of the shape functions of a face in its plane.
struct Slopes {
    of: Vec<[f64; 3]>,
    normal: [f64; 3],
}

impl Slopes {
    /// `v − ½ n (n·v)`: the curl of a displacement has twice the rotation about the normal, and once that across it.
    fn halved(&self, vector: [f64; 3]) -> [f64; 3] {
        add(vector, scale(-0.5 * dot(self.normal, vector), self.normal))
    }
}

impl Piece {
    fn place(&self, places: &[[f64; 3]], at: [f64; 3]) -> [f64; 3] {
        let values = self.shape.functions(at);
        let parts = self.nodes.iter().zip(values);
        parts.fold([0.0; 3], |sum, (node, value)| add(sum, scale(value, places[*node])))
    }

    /// Tangents at a place of the reference cell.
    fn tangents(&self, places: &[[f64; 3]], at: [f64; 3]) -> [[f64; 3]; 2] {
        let gradients = self.shape.gradients(at);
        let along = |axis: usize| {
            let parts = self.nodes.iter().zip(&gradients);
            parts.fold([0.0; 3], |sum, (node, gradient)| add(sum, scale(gradient[axis], places[*node])))
        };
        [along(0), along(1)]
    }

    fn slopes(&self, places: &[[f64; 3]], at: [f64; 3]) -> Option<Slopes> {
        let [a, b] = self.tangents(places, at);
        let area = cross(a, b);
        if !(norm(area) > ON * norm(a) * norm(b)) {
            return None;
        }
        let square = dot(area, area);
        let dual = [scale(square.recip(), cross(b, area)), scale(square.recip(), cross(area, a))];
        let gradients = self.shape.gradients(at);
        let slope = |gradient: &[f64; 3]| add(scale(gradient[0], dual[0]), scale(gradient[1], dual[1]));
        let of = gradients[..self.nodes.len()].iter().map(slope).collect();
        Some(Slopes { of, normal: unit(area) })
    }

    /// The nearest place of the reference cell, from one that is near.
    fn nearest(&self, places: &[[f64; 3]], point: [f64; 3], from: [f64; 3]) -> [f64; 3] {
        let away = |at: [f64; 3]| norm(minus(point, self.place(places, at)));
        let mut best = from;
        for _ in 0..STEPS {
            let [a, b] = self.tangents(places, best);
            let gap = minus(point, self.place(places, best));
            let determinant = dot(a, a) * dot(b, b) - dot(a, b).powi(2);
            let [x, y] = [dot(a, gap), dot(b, gap)];
            let step = [x * dot(b, b) - y * dot(a, b), y * dot(a, a) - x * dot(a, b)];
            let next = self.inside([0, 1].map(|axis| best[axis] + step[axis] / determinant));
            if !(away(next) < away(best)) {
                break;
            }
            best = next;
        }
        best
    }

    /// The nearest place of the reference cell to one that may lie outside.
    fn inside(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        if self.shape.corners() == 4 {
            return [x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0), 0.0];
        }
        let (x, y) = if x + y > 1.0 { (0.5 * (1.0 + x - y), 0.5 * (1.0 + y - x)) } else { (x, y) };
        let x = x.clamp(0.0, 1.0);
        [x, y.clamp(0.0, 1.0 - x), 0.0]
    }
}

impl Pieces {
    fn new(places: &[[f64; 3]], surface: &Surface) -> Option<Self> {
        let mut pieces = Vec::new();
        for face in &surface.faces {
            let (count, nodes) = (face.corners, &face.nodes);
            let shape = match (count, nodes.len()) {
                (3, 6) => Shape::Triangle6,
                (3, _) => Shape::Triangle3,
                (_, 8) => Shape::Quad8,
                _ => Shape::Quad4,
            };
            if !face.shell || shape.nodes() == count {
                pieces.push(Piece { shape, nodes: nodes[..shape.nodes()].to_vec() });
                continue;
            }
            // A quadratic shell is linear ones between its nodes.
            let middle = |at: usize| nodes[count + at % count];
            let corner = |at: usize| vec![nodes[at], middle(at), middle(at + count - 1)];
            pieces.extend((0..count).map(|at| Piece { shape: Shape::Triangle3, nodes: corner(at) }));
            let shape = if count == 3 { Shape::Triangle3 } else { Shape::Quad4 };
            pieces.push(Piece { shape, nodes: (0..count).map(middle).collect() });
        }
        let mut triangles = Vec::new();
        for (index, piece) in pieces.iter().enumerate() {
            let count = piece.shape.corners();
            let middle = |at: usize| count + at % count;
            let fan: Vec<[usize; 3]> = if piece.nodes.len() == count {
                (1..count - 1).map(|at| [0, at, at + 1]).collect()
            } else {
                let corners = (0..count).map(|at| [at, middle(at), middle(at + count - 1)]);
                corners.chain((1..count - 1).map(|at| [middle(0), middle(at), middle(at + 1)])).collect()
            };
            triangles.extend(fan.into_iter().map(|corners| (index, corners)));
        }
        let of = |(piece, corners): &(usize, [usize; 3])| {
            corners.map(|corner| places[pieces[*piece].nodes[corner]])
        };
        let corners: Vec<[[f64; 3]; 3]> = triangles.iter().map(of).collect();
        let sides = corners.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        let width = sides.map(|[a, b]| norm(minus(*a, *b))).fold(0.0, f64::max);
        Some(Self { nearest: NearestTriangles::new(corners)?, pieces, triangles, width })
    }

    /// The point nearest to a place, within the tolerance.
    fn nearest(&self, places: &[[f64; 3]], place: [f64; 3], tolerance: Option<f64>) -> Option<Point> {
        let (triangle, on) = self.nearest.nearest(place);
        let (piece, corners) = self.triangles[triangle];
        let found = &self.pieces[piece];
        let weights = nearest_weights(corners.map(|corner| places[found.nodes[corner]]), place);
        let reference = found.shape.reference();
        let from = (0..3).fold([0.0; 3], |sum, k| add(sum, scale(weights[k], reference[corners[k]])));
        let from = if from.iter().all(|x| x.is_finite()) { from } else { reference[corners[0]] };
        let at = found.nearest(places, place, from);
        let gap = minus(place, found.place(places, at));
        let distance = norm(gap).min(norm(minus(place, on)));
        let limit = tolerance.unwrap_or(NEAR * self.width).max(ON * self.width);
        (distance <= limit).then_some(Point { piece, at, gap })
    }
}
