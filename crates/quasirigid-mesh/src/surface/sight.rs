//! Lines of sight from the triangles of a closed surface: which rays the surface itself stops.

use super::ClosedSurface;
use super::geometry::{Corners, bounds};
use super::tree::{Bounds, Tree};
use quasirigid_math::vec3::{cross, dot, minus, norm};

/// Height over the plane of a triangle, relative to the size of the surface, that is rounding.
const LEVEL: f64 = 1e-9;

/// Lines of sight from the triangles of a surface, in its own unit of length.
///
/// A ray starts in the plane of a triangle and leaves its outer side; the other triangles of the surface may stop it.
pub struct Sight {
    corners: Vec<Corners>,
    normals: Vec<[f64; 3]>,
    tree: Tree,
    /// Whether nothing lies above the plane of each triangle.
    open: Vec<bool>,
}

impl std::fmt::Debug for Sight {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Sight from {} triangles", self.corners.len())
    }
}

impl Sight {
    /// Lines of sight from a surface.
    #[must_use]
    pub fn new(surface: &ClosedSurface) -> Self {
        let corners: Vec<Corners> = surface
            .triangles()
            .iter()
            .map(|triangle| triangle.map(|vertex| surface.vertices()[vertex]))
            .collect();
        let normals = corners.iter().map(|[a, b, c]| cross(minus(*b, *a), minus(*c, *a))).collect();
        let boxes: Vec<Bounds> = corners.iter().map(|corners| bounds(corners.iter().copied())).collect();
        let tree = Tree::new(&boxes);
        let mut sight = Self { corners, normals, tree, open: Vec::new() };
        let [low, high] = surface.bounds();
        let level = LEVEL * norm(minus(high, low));
        sight.open =
            (0..sight.corners.len()).map(|triangle| sight.has_nothing_above(triangle, level)).collect();
        sight
    }

    /// Whether no ray from the outer side of a triangle is stopped.
    #[must_use]
    pub fn is_open(&self, triangle: usize) -> bool {
        self.open[triangle]
    }

    /// Whether another triangle stops the ray from a place in a triangle along a direction on its outer side.
    #[must_use]
    pub fn is_blocked(&self, triangle: usize, from: [f64; 3], direction: [f64; 3]) -> bool {
        if self.open[triangle] {
            return false;
        }
        let inverse = direction.map(f64::recip);
        self.any(
            |node| meets_box(node, from, inverse),
            |other| other != triangle && meets(&self.corners[other], from, direction),
        )
    }

    /// Whether no corner lies above the plane of a triangle.
    fn has_nothing_above(&self, triangle: usize, level: f64) -> bool {
        let (normal, at) = (self.normals[triangle], self.corners[triangle][0]);
        let limit = dot(normal, at) + level * norm(normal);
        let highest = |[low, high]: &Bounds| -> f64 {
            (0..3).map(|axis| (normal[axis] * low[axis]).max(normal[axis] * high[axis])).sum()
        };
        !self.any(
            |node| highest(node) > limit,
            |other| self.corners[other].iter().any(|corner| dot(normal, *corner) > limit),
        )
    }

    /// Whether a triangle has a property, among those in boxes that may hold one.
    fn any(&self, enters: impl Fn(&Bounds) -> bool, found: impl Fn(usize) -> bool) -> bool {
        let mut open = vec![self.tree.nodes.len() - 1];
        while let Some(node) = open.pop().map(|index| &self.tree.nodes[index]) {
            if !enters(&node.bounds) {
                continue;
            }
            match node.children {
                Some(children) => open.extend(children),
                None if node.items.clone().any(|item| found(self.tree.order[item])) => return true,
                None => {}
            }
        }
        false
    }
}

/// Whether a ray meets a box; `inverse` has the reciprocal components of its direction.
fn meets_box([low, high]: &Bounds, from: [f64; 3], inverse: [f64; 3]) -> bool {
    let (mut first, mut last) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let [a, b] = [low, high].map(|corner| (corner[axis] - from[axis]) * inverse[axis]);
        // a ray in a face of the box gives 0 · ∞, which `min` and `max` pass over
        (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
    }
    first <= last * (1.0 + 4.0 * f64::EPSILON)
}

/// Whether a ray meets a triangle, from either side.
fn meets([a, b, c]: &Corners, from: [f64; 3], direction: [f64; 3]) -> bool {
    let (first, second, to) = (minus(*b, *a), minus(*c, *a), minus(from, *a));
    let across = cross(direction, second);
    let volume = dot(first, across);
    if volume == 0.0 {
        return false;
    }
    let along = cross(to, first);
    let [u, v, t] = [dot(to, across), dot(direction, along), dot(second, along)].map(|part| part / volume);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0
}

#[cfg(test)]
mod tests {
    use super::super::testing::{ball, block, turned};
    use super::*;

    fn middle([a, b, c]: &Corners) -> [f64; 3] {
        [0, 1, 2].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0)
    }

    /// The tree finds what a look at every triangle finds, in odd units and turned axes.
    #[test]
    fn every_ray_is_stopped_by_what_a_search_of_all_triangles_finds() {
        for unit in [1e-9, 1.0, 1e9] {
            let surface = block(turned(unit));
            let sight = Sight::new(&surface);
            let mut stopped = 0;
            for triangle in 0..sight.corners.len() {
                let (from, normal) = (middle(&sight.corners[triangle]), sight.normals[triangle]);
                for k in 0..600 {
                    let direction = [1.0, 2.0, 3.0].map(|rate| (rate * f64::from(k) + rate).sin());
                    if dot(direction, normal) <= 0.0 {
                        continue;
                    }
                    let others = (0..sight.corners.len()).filter(|other| *other != triangle);
                    let expected =
                        others.into_iter().any(|other| meets(&sight.corners[other], from, direction));
                    assert_eq!(sight.is_blocked(triangle, from, direction), expected);
                    stopped += u32::from(expected);
                }
            }
            assert!(stopped > 100, "{stopped}");
        }
    }

    /// Of an L the two inner walls see each other; every triangle of a ball is open.
    #[test]
    fn triangles_without_anything_above_are_open() {
        let sight = Sight::new(&block(turned(1e3)));
        assert_eq!(sight.open.iter().filter(|open| !**open).count(), 4);
        let sight = Sight::new(&ball(8, turned(1e-3)));
        assert!((0..sight.corners.len()).all(|triangle| sight.is_open(triangle)));
    }
}
