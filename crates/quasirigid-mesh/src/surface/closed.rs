//! Closed surface of triangles: checked on construction, with volume, centroid, bodies and convexity.
//! Moments, meshes and distances all presume the invariant below, so no surface exists that breaks it.
//! Equation (G9), docs/theory/11-materials.md.

use super::geometry::{bounds, is_flat, normalised};
use super::{Moments, SurfaceError, crossing, shells, topology};
use quasirigid_math::vec3::{cross, dot, minus, norm};

/// Height over a triangle, relative to the largest coordinate, that is rounding.
const FLAT: f64 = 1e-7;

/// A surface of triangles that bounds a body: one shell or several, side by side or as cavities one in the other.
///
/// Invariant: every edge has two triangles that pass it in opposite directions; no triangle is flat, and no two meet except in a corner or
/// an edge that they share; triangles run counterclockwise seen from outside the body, so those of a cavity seen from within it. Shells may
/// share single vertices. All lengths are judged relative to the largest coordinate, so that the unit does not matter.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "super::written::Written", into = "super::written::Written"))]
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedSurface {
    pub(super) vertices: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[usize; 3]>,
    bounds: [[f64; 3]; 2],
}

impl ClosedSurface {
    /// Accepts triangles, given by three of the vertices each, if they bound a body; changes nothing. Vertices of no
    /// triangle are allowed.
    ///
    /// # Errors
    /// [`SurfaceError`] with the kind of fault, its first place and the count.
    pub fn new(vertices: Vec<[f64; 3]>, triangles: Vec<[usize; 3]>) -> Result<Self, SurfaceError> {
        check(&vertices, &triangles)?;
        Ok(Self::accepted(vertices, triangles))
    }

    /// A surface of triangles that [`check`] has accepted.
    pub(super) fn accepted(vertices: Vec<[f64; 3]>, triangles: Vec<[usize; 3]>) -> Self {
        let bounds = bounds(triangles.iter().flatten().map(|vertex| vertices[*vertex]));
        Self { vertices, triangles, bounds }
    }

    /// The surface seen from a place along unit axes at right angles.
    #[must_use]
    pub fn seen(&self, from: [f64; 3], axes: [[f64; 3]; 3]) -> Self {
        let vertices: Vec<[f64; 3]> =
            self.vertices.iter().map(|vertex| axes.map(|axis| dot(axis, minus(*vertex, from)))).collect();
        let bounds = bounds(self.triangles.iter().flatten().map(|vertex| vertices[*vertex]));
        Self { vertices, triangles: self.triangles.clone(), bounds }
    }

    /// All vertices, as they were given.
    #[must_use]
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Corners of each triangle, counterclockwise seen from outside, as indices of vertices.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Every edge once, as indices of its ends, the lower one first.
    pub fn edges(&self) -> impl Iterator<Item = [usize; 2]> {
        self.triangles.iter().flat_map(|corners| topology::edges(*corners)).filter(|[from, to]| from < to)
    }

    /// Lowest and highest corner of the smallest box around the triangles.
    #[must_use]
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        self.bounds
    }

    /// Volume.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let ([_, unit], moments) = self.first_moments();
        unit.into_iter().fold(moments.of([0, 0, 0]), |volume, length| volume * length)
    }

    /// Centre of volume.
    #[must_use]
    pub fn centroid(&self) -> [f64; 3] {
        let ([middle, unit], moments) = self.first_moments();
        let mean = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|axis| moments.of(axis) / moments.of([0, 0, 0]));
        std::array::from_fn(|axis| middle[axis] + unit[axis] * mean[axis])
    }

    /// Number of bodies: shells that look outward. Bodies that share only vertices count each.
    #[must_use]
    pub fn bodies(&self) -> usize {
        // Every edge has two triangles, as it had when the surface was accepted.
        let neighbours = topology::neighbours(&self.triangles).unwrap_or_default();
        let corners = normalised(&self.vertices, &self.triangles);
        shells::outward(&corners, &neighbours)
    }

    /// Whether the surface bounds one convex body: at every edge the next triangle bends inward, or not at all.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        let neighbours = topology::neighbours(&self.triangles).unwrap_or_default();
        let corners = normalised(&self.vertices, &self.triangles);
        let inward = |[a, b]: &[usize; 2]| {
            let [p, q, r] = corners[*a];
            let normal = cross(minus(q, p), minus(r, p));
            corners[*b].iter().all(|corner| dot(normal, minus(*corner, p)) <= FLAT * norm(normal))
        };
        self.bodies() == 1 && neighbours.iter().all(inward)
    }

    /// Moments of degrees 0 and 1 about the middle of the box, in half its sides; the middle and half the sides.
    fn first_moments(&self) -> ([[f64; 3]; 2], Moments) {
        let [low, high] = self.bounds;
        let half = |sign: f64| std::array::from_fn(|axis| 0.5 * high[axis] + sign * 0.5 * low[axis]);
        let [middle, unit] = [half(1.0), half(-1.0)];
        ([middle, unit], self.moments(1, middle, unit))
    }
}

/// Accepts triangles that bound a body.
pub(super) fn check(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> Result<(), SurfaceError> {
    if triangles.len() < 4 {
        return Err(SurfaceError::TooFew { triangles: triangles.len() });
    }
    let missing = |corners: &[usize; 3]| corners.iter().any(|corner| *corner >= vertices.len());
    if let Some((triangle, count)) = found(triangles, missing) {
        let index = triangles[triangle].into_iter().fold(0, usize::max);
        return Err(SurfaceError::NoSuchVertex { triangle, index, vertices: vertices.len(), count });
    }
    let not_finite = |vertex: &[f64; 3]| vertex.iter().any(|x| !x.is_finite());
    if let Some((vertex, count)) = found(vertices, not_finite) {
        return Err(SurfaceError::NotFinite { vertex, count });
    }
    let corners = normalised(vertices, triangles);
    if let Some((triangle, count)) = found(&corners, is_flat) {
        return Err(SurfaceError::Degenerate { triangle, count });
    }
    let neighbours = topology::neighbours(triangles)?;
    crossing::check(&corners, triangles)?;
    shells::check(&corners, &neighbours)
}

/// Index of the first element that has a fault, and how many have it.
fn found<T>(elements: &[T], fault: impl Fn(&T) -> bool) -> Option<(usize, usize)> {
    let first = elements.iter().position(&fault)?;
    Some((first, elements[first..].iter().filter(|element| fault(element)).count()))
}
