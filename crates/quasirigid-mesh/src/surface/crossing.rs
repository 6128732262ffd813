//! Triangles that cross or touch where they should not.

use std::ops::ControlFlow;

use super::SurfaceError;
use super::geometry::{Corners, bounds};
use super::tree::{Bounds, overlapping};
use quasirigid_math::vec3::{cross, dot, minus, norm};

/// Share of the extent of two triangles below which a gap is rounding.
const GAP: f64 = 8.0 * f64::EPSILON;
/// Pairs are counted up to this number.
const COUNTED: usize = 1000;

/// Accepts triangles that share a corner or an edge and meet nowhere else.
pub(super) fn check(corners: &[Corners], triangles: &[[usize; 3]]) -> Result<(), SurfaceError> {
    let boxes: Vec<Bounds> = corners.iter().map(|corners| bounds(corners.iter().copied())).collect();
    let (mut first, mut count) = (None, 0);
    overlapping(&boxes, |a, b| {
        let pair = [a.min(b), a.max(b)];
        if meet(pair.map(|triangle| &corners[triangle]), pair.map(|triangle| triangles[triangle])) {
            first = Some(first.map_or(pair, |first: [usize; 2]| first.min(pair)));
            count += 1;
        }
        if count == COUNTED { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    first.map_or(Ok(()), |triangles| Err(SurfaceError::SelfIntersecting { triangles, count }))
}

/// Whether two triangles have points in common, beside corners and an edge that they share.
fn meet([a, b]: [&Corners; 2], [a_corners, b_corners]: [[usize; 3]; 2]) -> bool {
    let same = |i: usize| b_corners.iter().position(|corner| *corner == a_corners[i]);
    let shared: Vec<[usize; 2]> = (0..3).filter_map(|i| same(i).map(|j| [i, j])).collect();
    match shared.as_slice() {
        [] => !apart(a, b),
        // Seen from the shared corner, any other common point would reach the far side of one of them.
        [[i, j]] => !(apart(&far_side(a, *i), b) && apart(&far_side(b, *j), a)),
        [_, _] => folded(a, b),
        _ => true,
    }
}

/// The side opposite to a corner.
fn far_side(triangle: &Corners, corner: usize) -> [[f64; 3]; 2] {
    [triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]]
}

/// Whether neighbours, both running counterclockwise, lie back to back: their normals are opposite to within rounding.
fn folded(a: &Corners, b: &Corners) -> bool {
    let [(m, rounding_m), (n, rounding_n)] = [a, b].map(|[p, q, r]| {
        let (u, v) = (minus(*q, *p), minus(*r, *p));
        (cross(u, v), GAP * norm(u) * norm(v))
    });
    dot(m, n) < 0.0 && norm(cross(m, n)) <= rounding_m * norm(n) + rounding_n * norm(m)
}

/// Whether a plane separates a triangle, or a segment, from a triangle, with a gap on at least one side.
///
/// If any plane does, one does whose normal is that of a triangle, or is at right angles to an edge of each, or lies in
/// a triangle at right angles to an edge. Whatever rounding does to a normal, a gap along it is a gap.
fn apart<const N: usize>(first: &[[f64; 3]; N], second: &Corners) -> bool {
    let about = second[0];
    let first = first.map(|corner| minus(corner, about));
    let second = second.map(|corner| minus(corner, about));
    let extent = first.iter().chain(&second).map(|r| dot(*r, *r)).fold(0.0, f64::max);
    let separates = |normal: [f64; 3]| {
        let [low, high] = range(&first, normal);
        let [other_low, other_high] = range(&second, normal);
        let gap = (other_low - high).max(low - other_high);
        gap > 0.0 && gap * gap > GAP * GAP * dot(normal, normal) * extent
    };
    let edges = if N == 3 { N } else { 1 };
    let edge = |i: usize| minus(first[(i + 1) % N], first[i]);
    let other_edge = |j: usize| minus(second[(j + 1) % 3], second[j]);
    let normal = cross(other_edge(0), other_edge(1));
    if separates(normal) || (N == 3 && separates(cross(edge(0), edge(1)))) {
        return true;
    }
    (0..edges).any(|i| separates(cross(normal, edge(i))))
        || (0..3).any(|j| separates(cross(normal, other_edge(j))))
        || (0..edges).any(|i| (0..3).any(|j| separates(cross(edge(i), other_edge(j)))))
}

/// Least and greatest of the products of points with a vector.
fn range<const N: usize>(points: &[[f64; 3]; N], along: [f64; 3]) -> [f64; 2] {
    points
        .iter()
        .map(|point| dot(*point, along))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: Corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn meets(other: Corners, corners: [usize; 3]) -> bool {
        // A rotation and a shift, so that no plane is that of two axes.
        let place = |[x, y, z]: [f64; 3]| {
            [0.6 * x - 0.8 * y + 0.3, 0.48 * x + 0.36 * y - 0.8 * z, 0.64 * x + 0.48 * y + 0.6 * z]
        };
        let [a, b] = [BASE, other].map(|triangle| triangle.map(place));
        let found = meet([&a, &b], [[0, 1, 2], corners]);
        assert_eq!(found, meet([&b, &a], [corners, [0, 1, 2]]));
        found
    }

    #[test]
    fn triangles_without_common_corners() {
        let meets = |other| meets(other, [3, 4, 5]);
        assert!(meets([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0]]), "through the inside");
        assert!(!meets([[3.0, 3.0, -1.0], [3.0, 3.0, 1.0], [9.0, 9.0, 1.0]]), "past an edge");
        assert!(meets([[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]), "a corner on the inside");
        assert!(!meets([[1.0, 1.0, 1e-13], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]), "a corner just above");
        assert!(meets([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0]]), "inside one another");
        assert!(meets([[3.0, 3.0, 0.0], [1.0, 1.0, 0.0], [9.0, 9.0, 0.0]]), "in a plane, overlapping");
        assert!(!meets([[3.0, 3.0, 0.0], [3.0, 2.0, 0.0], [9.0, 9.0, 0.0]]), "in a plane, apart");
        assert!(!meets([[1.0, 1.0, 0.1], [2.0, 1.0, 0.1], [1.0, 2.0, 0.1]]), "in parallel planes");
        assert!(!meets([[5.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 0.0, 3.0]]), "an edge in line with an edge");
    }

    #[test]
    fn triangles_with_a_common_corner() {
        let meets = |p, q| meets([[0.0; 3], p, q], [0, 4, 5]);
        assert!(!meets([-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]), "in a plane, opposite, edges in line");
        assert!(!meets([-1.0, 1.0, 0.0], [-1.0, 0.0, 0.0]), "in a plane, beside");
        assert!(meets([1.0, 1.0, 0.0], [1.0, 2.0, 0.0]), "in a plane, over one another");
        assert!(meets([1.0, 0.0, 0.0], [1.0, -1.0, 0.0]), "along an edge");
        assert!(meets([1.0, 1.0, -1.0], [1.0, 1.0, 1.0]), "through the inside, ending there");
        assert!(meets([9.0, 9.0, -1.0], [9.0, 9.0, 1.0]), "through the inside and beyond");
        assert!(!meets([1.0, 1.0, 1.0], [2.0, 1.0, 1.0]), "above");
        assert!(!meets([1.0, 1.0, 1e-13], [2.0, 1.0, 1.0]), "just above");
        assert!(!meets([-1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]), "behind");
    }

    #[test]
    fn triangles_with_a_common_edge() {
        let meets = |apex| meets([[4.0, 0.0, 0.0], [0.0; 3], apex], [1, 0, 5]);
        assert!(meets([1.0, 2.0, 0.0]) && meets([9.0, 9.0, 0.0]), "folded back");
        assert!(!meets([1.0, -2.0, 0.0]), "flat");
        assert!(!meets([1.0, 2.0, 1e-12]) && !meets([1.0, 2.0, -1e-12]), "nearly folded back");
        assert!(super::meet([&BASE, &BASE], [[0, 1, 2], [2, 1, 0]]), "both sides of one triangle");
    }
}
