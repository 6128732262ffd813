//! Laminated solids of a deck: each is divided into a cell for each ply, across the stack and through its whole thickness. Cells of one
//! laminate share the nodes between plies; where another cell has the undivided edge, those nodes follow its ends.

use std::collections::{BTreeSet, HashMap, HashSet};

use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale, unit};
use quasirigid_mesh::Shape;

use super::cells::Cells;
use super::{Laminate, Solid, edges};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Lower and upper corners of a hexahedron along each of its three directions, counter-clockwise seen from above.
const HEX: [[[usize; 4]; 2]; 3] =
    [[[0, 1, 2, 3], [4, 5, 6, 7]], [[0, 3, 7, 4], [1, 2, 6, 5]], [[0, 4, 5, 1], [3, 7, 6, 2]]];
/// Least cosine between the stack and the edges along which a solid is divided.
const ALONG: f64 = 0.5;
/// Levels on an edge that are the same, as a share of its length.
const SAME: f64 = 1e-9;
/// Difference between the thicknesses of plies and of their solid that is told.
const STRETCH: f64 = 0.01;

/// Material of a ply, and its axes 1, 2, 3.
pub(crate) type OfPly = (u64, [[f64; 3]; 3]);

/// Plies of the solids of a deck.
#[derive(Default)]
pub(crate) struct Layers {
    /// Material and axes of the cells that are plies.
    pub of_cells: HashMap<usize, OfPly>,
    /// Nodes that follow the ends of an undivided edge, with the share of each end.
    pub tied: Vec<(usize, [(usize, f64); 2])>,
    /// Nodes between plies, by the ends of their edge and the level from the first.
    nodes: HashMap<([usize; 2], i64), usize>,
    /// Levels of each divided edge, laminate by laminate.
    levels: HashMap<[usize; 2], BTreeSet<Vec<i64>>>,
    divided: usize,
    stretched: usize,
}

impl Cells {
    /// Adds the plies of a solid; `axes` are those of its material, which tell the stack.
    pub(super) fn laminate(
        &mut self,
        solid: &Solid,
        laminate: &Laminate,
        axes: [[f64; 3]; 3],
    ) -> Result<(), LocatedProblem> {
        let refused = || (solid.line, MatrixProblem::Layered { element: solid.label });
        if !matches!(solid.corners, 6 | 8) || solid.nodes[solid.corners..].iter().any(|node| *node != 0) {
            return Err(refused());
        }
        let corners = solid.nodes[..solid.corners].iter().map(|node| self.of(*node, solid.line));
        let corners = corners.collect::<Result<Vec<_>, _>>()?;
        let stack = axes[laminate.directions[1]];
        let [lower, upper] = self.faces(&corners, stack).ok_or_else(refused)?;
        let whole: f64 = laminate.plies.iter().map(|ply| ply.thickness).sum();
        let height = norm(minus(self.middle_of(&upper), self.middle_of(&lower)));
        self.layers.divided += 1;
        self.layers.stretched += usize::from((whole / height - 1.0).abs() > STRETCH);
        let normal = self.normal(&lower, &upper);
        // a cell may be given inside out
        let normal = if dot(normal, stack) < 0.0 { scale(-1.0, normal) } else { normal };
        let first = axes[laminate.directions[0]];
        let along = add(first, scale(-dot(first, normal), normal));
        if !(norm(along) > ALONG) {
            return Err(refused());
        }
        let along = unit(along);
        let across = cross(normal, along);
        let mut bounds = vec![0.0];
        for ply in &laminate.plies {
            bounds.push(bounds[bounds.len() - 1] + ply.thickness / whole);
        }
        if let Some(last) = bounds.last_mut() {
            *last = 1.0;
        }
        let levels = bounds.iter().map(|level| self.level(&lower, &upper, *level)).collect::<Vec<_>>();
        self.note_levels(&lower, &upper, &bounds);
        let shape = if corners.len() == 8 { Shape::Hex8 } else { Shape::Wedge6 };
        for (ply, pair) in laminate.plies.iter().zip(levels.windows(2)) {
            let (sin, cos) = ply.angle.to_radians().sin_cos();
            let own = add(scale(cos, along), scale(sin, across));
            let axes = [own, cross(normal, own), normal];
            self.layers.of_cells.insert(self.mesh.cells.len(), (ply.material, axes));
            self.add(solid.label, shape, &pair.concat());
        }
        Ok(())
    }

    /// Lower and upper corners of a cell along a direction; none where no edges are along it.
    fn faces(&self, corners: &[usize], stack: [f64; 3]) -> Option<[Vec<usize>; 2]> {
        let of = |places: &[usize]| places.iter().map(|place| corners[*place]).collect::<Vec<_>>();
        let pairs: Vec<[Vec<usize>; 2]> = match corners.len() {
            8 => HEX.iter().map(|[lower, upper]| [of(lower), of(upper)]).collect(),
            _ => vec![[of(&[0, 1, 2]), of(&[3, 4, 5])]],
        };
        let cosine = |[lower, upper]: &[Vec<usize>; 2]| {
            let height = minus(self.middle_of(upper), self.middle_of(lower));
            dot(height, stack) / (norm(height) * norm(stack))
        };
        let best = pairs.into_iter().max_by(|a, b| cosine(a).abs().total_cmp(&cosine(b).abs()))?;
        let found = cosine(&best);
        if !(found.abs() > ALONG) {
            return None;
        }
        let [lower, upper] = best;
        if found > 0.0 {
            return Some([lower, upper]);
        }
        // upside down: both faces are walked the other way round
        let turned = |face: Vec<usize>| face[..1].iter().chain(face[1..].iter().rev()).copied().collect();
        Some([turned(upper), turned(lower)])
    }

    fn middle_of(&self, nodes: &[usize]) -> [f64; 3] {
        let sum = nodes.iter().fold([0.0; 3], |sum, node| add(sum, self.mesh.nodes[*node]));
        scale((nodes.len() as f64).recip(), sum)
    }

    /// Unit normal of the face half-way, towards the upper one.
    fn normal(&self, lower: &[usize], upper: &[usize]) -> [f64; 3] {
        let half =
            |corner: usize| scale(0.5, add(self.mesh.nodes[lower[corner]], self.mesh.nodes[upper[corner]]));
        let side = |from: usize, to: usize| minus(half(to), half(from));
        let area =
            if lower.len() == 4 { cross(side(0, 2), side(1, 3)) } else { cross(side(0, 1), side(0, 2)) };
        unit(area)
    }

    /// Nodes at a level between two faces.
    fn level(&mut self, lower: &[usize], upper: &[usize], level: f64) -> Vec<usize> {
        if level <= 0.0 || level >= 1.0 {
            return if level <= 0.0 { lower.to_vec() } else { upper.to_vec() };
        }
        let mut nodes = Vec::with_capacity(lower.len());
        for (a, b) in lower.iter().zip(upper) {
            let (edge, share) = ascending(*a, *b, level);
            let key = (edge, rounded(share));
            let known = self.layers.nodes.get(&key).copied();
            let node = known.unwrap_or_else(|| {
                let [a, b] = edge.map(|end| self.mesh.nodes[end]);
                let node = self.new_node(add(scale(1.0 - share, a), scale(share, b)));
                self.layers.nodes.insert(key, node);
                node
            });
            nodes.push(node);
        }
        nodes
    }

    fn note_levels(&mut self, lower: &[usize], upper: &[usize], bounds: &[f64]) {
        for (a, b) in lower.iter().zip(upper) {
            let mut levels: Vec<i64> =
                bounds.iter().map(|level| rounded(ascending(*a, *b, *level).1)).collect();
            levels.sort_unstable();
            self.layers.levels.entry(ascending(*a, *b, 0.0).0).or_default().insert(levels);
        }
    }

    /// Ties nodes between plies to the ends of edges that another cell has undivided, or divided otherwise.
    pub(super) fn tie(&mut self) {
        if self.layers.nodes.is_empty() {
            return;
        }
        let mut whole: HashSet<[usize; 2]> = HashSet::new();
        for (index, cell) in self.mesh.cells.iter().enumerate() {
            if self.layers.of_cells.contains_key(&index) {
                continue;
            }
            let corners = cell.shape.corners();
            let pairs: Vec<[usize; 2]> = match cell.shape.dimension() {
                3 => edges(corners).to_vec(),
                _ => (0..corners).map(|corner| [corner, (corner + 1) % corners]).collect(),
            };
            whole.extend(pairs.iter().map(|[a, b]| ascending(cell.nodes[*a], cell.nodes[*b], 0.0).0));
        }
        let levels = &self.layers.levels;
        let meets =
            |edge: &[usize; 2]| whole.contains(edge) || levels.get(edge).is_some_and(|sets| sets.len() > 1);
        let mut tied: Vec<(usize, [(usize, f64); 2])> = self
            .layers
            .nodes
            .iter()
            .filter(|((edge, _), _)| meets(edge))
            .map(|(([a, b], level), node)| {
                let share = *level as f64 * SAME;
                (*node, [(*a, 1.0 - share), (*b, share)])
            })
            .collect();
        tied.sort_unstable_by_key(|(node, _)| *node);
        self.layers.tied = tied;
    }
}

impl Layers {
    /// What was divided, in words.
    pub(super) fn notes(&self) -> Vec<String> {
        let counted = [
            (self.divided, "laminated solids are divided into a cell for each ply"),
            (
                self.stretched,
                "plies of laminated solids are stretched to their thickness, from which it differs",
            ),
            (
                self.tied.len(),
                "points between plies follow the ends of an edge that another cell has undivided",
            ),
        ];
        let counted = counted.iter().filter(|(count, _)| *count > 0);
        counted.map(|(count, what)| format!("{what} ({count})")).collect()
    }
}

/// The ends of an edge in ascending order, and the share of a level from the first of them.
fn ascending(a: usize, b: usize, level: f64) -> ([usize; 2], f64) {
    if a < b { ([a, b], level) } else { ([b, a], 1.0 - level) }
}

fn rounded(share: f64) -> i64 {
    (share / SAME).round() as i64
}
