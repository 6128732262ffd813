//! Facets of the outer surface of a body, which of them light reaches.

use std::sync::Arc;

use super::{ClosedSurface, Sight};
use crate::meshing::icosahedron;
use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale, unit};

/// Facets of a body, in its own unit of length.
///
/// Convex bodies throw no shadow on themselves; of others each facet is in light, and seen, as its middle is.
#[derive(Clone, Debug)]
pub struct Facets {
    facets: Vec<Facet>,
    /// Lines of sight from the triangles of a surface that is not convex.
    sight: Option<Arc<Sight>>,
}

/// Parts of the extent of a body that a facet in shadow is no longer than.
const PARTS: f64 = 24.0;

/// Facet of an outer surface.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Unit vector outward.
    pub normal: [f64; 3],
    /// Area.
    pub area: f64,
    /// Middle.
    pub middle: [f64; 3],
    /// Triangle of the surface that the facet is part of.
    triangle: usize,
}

impl Facets {
    /// Facets of an ellipsoid with semi-axes along x, y, z: `20 · 4^level`, each with the exact normal and the area of its share of the
    /// sphere that the ellipsoid is stretched from. (O15)
    #[must_use]
    pub fn of_ellipsoid(semi_axes: [f64; 3], level: usize) -> Self {
        let volume: f64 = semi_axes.iter().product();
        let facet = |corners: [[f64; 3]; 3]| {
            let middle = unit(corners.into_iter().fold([0.0; 3], add));
            let stretched: [f64; 3] = std::array::from_fn(|axis| middle[axis] / semi_axes[axis]);
            Facet {
                normal: unit(stretched),
                area: volume * norm(stretched) * solid_angle(corners),
                middle: std::array::from_fn(|axis| middle[axis] * semi_axes[axis]),
                triangle: 0,
            }
        };
        Self { facets: sphere(level).into_iter().map(facet).collect(), sight: None }
    }

    /// Facets of a closed surface, each triangle as one: exact where the surface is convex.
    #[must_use]
    pub fn of_surface(surface: &ClosedSurface) -> Self {
        let corners = |triangle: &[usize; 3]| triangle.map(|vertex| surface.vertices()[vertex]);
        let facets = surface.triangles().iter().map(corners).enumerate().map(facet).collect();
        let sight = (!surface.is_convex()).then(|| Arc::new(Sight::new(surface)));
        Self { facets, sight }
    }

    /// The same surface with every triangle that may lie in shadow or be hidden cut into facets no longer than a 24th of the body, and each of
    /// those into `4^level`.
    #[must_use]
    pub fn refined(&self, surface: &ClosedSurface, level: usize) -> Self {
        let Some(sight) = &self.sight else { return self.clone() };
        let corners = |triangle: &[usize; 3]| triangle.map(|vertex| surface.vertices()[vertex]);
        let [low, high] = surface.bounds();
        let longest = minus(high, low).into_iter().fold(0.0, f64::max) / PARTS;
        let cut = surface.triangles().iter().map(corners).enumerate().flat_map(|(triangle, corners)| {
            let [a, b, c] = corners;
            let edge = [minus(b, a), minus(c, b), minus(a, c)].map(norm).into_iter().fold(0.0, f64::max);
            let halvings = (edge / longest).log2().ceil().max(0.0) as usize;
            let level = if sight.is_open(triangle) { 0 } else { level + halvings };
            quartered(vec![corners], level).into_iter().map(move |corners| facet((triangle, corners)))
        });
        Self { facets: cut.collect(), sight: self.sight.clone() }
    }

    /// Whether no facet throws a shadow on another.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.sight.is_none()
    }

    /// Cross-section that a convex body of this surface has in the mean over all directions: a quarter of the surface.
    #[must_use]
    pub fn mean_cross_section(&self) -> f64 {
        0.25 * self.facets.iter().map(|facet| facet.area).sum::<f64>()
    }

    /// Every facet.
    #[must_use]
    pub fn list(&self) -> &[Facet] {
        &self.facets
    }

    /// Whether anything may stop light on its way to a facet.
    #[must_use]
    pub fn may_be_hidden(&self, facet: &Facet) -> bool {
        self.sight.as_ref().is_some_and(|sight| !sight.is_open(facet.triangle))
    }

    /// Whether the body stops light on its way to the middle of a facet, from a direction on the outer side of it.
    #[must_use]
    pub fn is_hidden(&self, facet: &Facet, direction: [f64; 3]) -> bool {
        self.sight.as_ref().is_some_and(|sight| sight.is_blocked(facet.triangle, facet.middle, direction))
    }
}

/// The facet that is a triangle, or a part of one.
fn facet((triangle, [a, b, c]): (usize, [[f64; 3]; 3])) -> Facet {
    let across = cross(minus(b, a), minus(c, a));
    let size = norm(across);
    let middle = scale(1.0 / 3.0, add(add(a, b), c));
    Facet { normal: scale(size.recip(), across), area: 0.5 * size, middle, triangle }
}

/// Triangles cut into four by the middles of their edges, so many times.
fn quartered(triangles: Vec<[[f64; 3]; 3]>, times: usize) -> Vec<[[f64; 3]; 3]> {
    (0..times).fold(triangles, |triangles, _| {
        triangles.into_iter().flat_map(|corners| quarters(corners, |m| m)).collect()
    })
}

fn quarters([a, b, c]: [[f64; 3]; 3], place: impl Fn([f64; 3]) -> [f64; 3]) -> [[[f64; 3]; 3]; 4] {
    let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to)| place(scale(0.5, add(from, to))));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Triangles on the unit sphere: an icosahedron, cut into four so many times.
fn sphere(level: usize) -> Vec<[[f64; 3]; 3]> {
    let faces = icosahedron();
    (0..level).fold(faces, |faces, _| faces.into_iter().flat_map(|corners| quarters(corners, unit)).collect())
}

/// Solid angle of a triangle on the unit sphere.
fn solid_angle([a, b, c]: [[f64; 3]; 3]) -> f64 {
    2.0 * dot(a, cross(b, c)).abs().atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn triangles_cover_the_sphere_once() {
        for level in 0..4 {
            let faces = sphere(level);
            assert_eq!(faces.len(), 20 * 4_usize.pow(level as u32));
            let whole: f64 = faces.iter().map(|corners| solid_angle(*corners)).sum();
            assert!((whole / (4.0 * PI) - 1.0).abs() < 1e-13, "{whole}");
        }
    }
}
