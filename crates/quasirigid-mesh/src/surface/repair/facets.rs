//! Facets without area and copies of facets, left out.

use std::collections::HashMap;

use super::super::geometry::{is_flat, normalised};
use super::super::topology::edges;
use super::Draft;
use quasirigid_math::vec3::{minus, norm};

/// Times that facets without area are sought: each flip of an edge may leave another one.
const PASSES: usize = 12;

impl Draft {
    /// Leaves out facets that have a corner twice.
    pub(super) fn drop_collapsed(&mut self) {
        let before = self.triangles.len();
        self.triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        self.repairs.degenerate += before - self.triangles.len();
    }

    /// Leaves out copies of facets, and facets back to back: one of each pair if all facets are such pairs, both of a wall inside.
    pub(super) fn drop_repeats(&mut self) {
        let sorted = |corners: &[usize; 3]| {
            let mut sorted = *corners;
            sorted.sort_unstable();
            let [a, b, c] = sorted;
            (sorted, [[a, b, c], [b, c, a], [c, a, b]].contains(corners))
        };
        let mut order: Vec<([usize; 3], bool, usize)> = Vec::with_capacity(self.triangles.len());
        order.extend(self.triangles.iter().enumerate().map(|(index, corners)| {
            let (sorted, even) = sorted(corners);
            (sorted, even, index)
        }));
        order.sort_unstable();
        let both = |group: &[([usize; 3], bool, usize)]| group.iter().any(|(_, even, _)| *even != group[0].1);
        let double_sided = order.chunk_by(|a, b| a.0 == b.0).all(both);
        let mut dropped = Vec::new();
        for group in order.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
            let first = group.iter().map(|(.., index)| *index).min().unwrap_or_default();
            let even = group.iter().filter(|(_, even, _)| *even).count();
            let wall = !double_sided && 2 * even == group.len();
            let kept = match (wall, 2 * even > group.len()) {
                (true, _) => None,
                _ if double_sided || !both(group) => Some(first),
                (_, more) => group.iter().find(|(_, even, _)| *even == more).map(|(.., index)| *index),
            };
            let count = if wall { &mut self.repairs.walls } else { &mut self.repairs.repeated };
            let before = dropped.len();
            dropped.extend(group.iter().map(|(.., index)| *index).filter(|index| Some(*index) != kept));
            *count += dropped.len() - before;
        }
        if dropped.is_empty() {
            return;
        }
        dropped.sort_unstable();
        let mut index = 0;
        self.triangles.retain(|_| {
            index += 1;
            dropped.binary_search(&(index - 1)).is_err()
        });
    }

    /// Takes facets without area out of a surface that is closed: the neighbour across the longest edge is cut there at the corner
    /// between, so that no point of the surface moves.
    pub(super) fn flatten(&mut self) {
        for _ in 0..PASSES {
            let corners = normalised(&self.vertices, &self.triangles);
            let flat: Vec<usize> = (0..corners.len()).filter(|index| is_flat(&corners[*index])).collect();
            if flat.is_empty() || self.open_edges() > 0 {
                return;
            }
            self.flip(&flat);
        }
    }

    /// Flips the longest edge of each of these facets.
    fn flip(&mut self, flat: &[usize]) {
        let mut owners: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
        let mut wanted: HashMap<[usize; 2], usize> = HashMap::new();
        let undirected = |[from, to]: [usize; 2]| [from.min(to), from.max(to)];
        for triangle in flat {
            wanted.insert(undirected(self.longest(*triangle)), *triangle);
        }
        for (triangle, corners) in self.triangles.iter().enumerate() {
            for edge in edges(*corners).map(undirected).into_iter().filter(|edge| wanted.contains_key(edge)) {
                owners.entry(edge).or_default().push(triangle);
            }
        }
        let mut touched = vec![false; self.triangles.len()];
        for triangle in flat {
            let [from, to] = self.longest(*triangle);
            let Some([p, q]) = owners.get(&undirected([from, to])).map(Vec::as_slice) else { continue };
            let other = if p == triangle { *q } else { *p };
            let third = |index: usize| self.triangles[index].into_iter().find(|c| *c != from && *c != to);
            let (Some(between), Some(far)) = (third(*triangle), third(other)) else { continue };
            if touched[*triangle] || touched[other] || between == far {
                continue;
            }
            [touched[*triangle], touched[other]] = [true; 2];
            self.triangles[*triangle] = [from, far, between];
            self.triangles[other] = [far, to, between];
            self.repairs.degenerate += 1;
        }
    }

    /// The longest edge of a facet, in its direction.
    fn longest(&self, triangle: usize) -> [usize; 2] {
        let length = |[from, to]: &[usize; 2]| norm(minus(self.vertices[*from], self.vertices[*to]));
        let [first, rest @ ..] = edges(self.triangles[triangle]);
        rest.into_iter()
            .fold(first, |longest, edge| if length(&edge) > length(&longest) { edge } else { longest })
    }
}
