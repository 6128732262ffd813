//! Sunlight on the outer surface of a body: force and torque by the direction of the Sun, as sums over facets and of spherical harmonics.
//! Equations (F27) to (F29), docs/theory/07-forces.md.

mod harmonics;

use crate::math::vec3::{add, cross, dot, minus, norm, scale};
use quasirigid_mesh::surface::{ClosedSurface, Facet, Facets};

pub use harmonics::{SunlightAccuracy, UNRESOLVED};

/// Level of the facets of an ellipsoid.
const LEVEL: usize = 5;
/// Share of the recoil of light that a surface sends out by Lambert's law which is along its normal.
const LAMBERT: f64 = 2.0 / 3.0;

/// Outer surface of a body in sunlight.
#[derive(Clone, Debug)]
pub struct SunlitShape {
    /// Centre of the volume (m, file's frame), which the places of facets are from.
    center: [f64; 3],
    /// Whole triangles.
    facets: Facets,
    /// Finer facets of a body that throws shadows on itself; none of others.
    shaded: Option<Facets>,
}

impl SunlitShape {
    /// Ellipsoid with semi-axes (m) along the axes of the file and a centre (m).
    #[must_use]
    pub fn of_ellipsoid(semi_axes: [f64; 3], center: [f64; 3]) -> Self {
        Self { center, facets: Facets::of_ellipsoid(semi_axes, LEVEL), shaded: None }
    }

    /// Closed surface in the file's frame, with the shadows that it throws on itself or without.
    #[must_use]
    pub fn of_surface(surface: &ClosedSurface, shadows: bool) -> Self {
        let center = surface.centroid();
        let surface = surface.seen(center, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let facets = Facets::of_surface(&surface);
        let shaded = (shadows && !facets.is_convex()).then(|| facets.refined(&surface, 0));
        Self { center, facets, shaded }
    }

    /// Number of facets.
    #[must_use]
    pub fn count(&self) -> usize {
        self.shaded.as_ref().unwrap_or(&self.facets).list().len()
    }

    /// Whether the body throws shadows on itself that are computed.
    #[must_use]
    pub fn has_shadows(&self) -> bool {
        self.shaded.is_some()
    }

    /// Force (m²) and torque about the centre of the volume (m³), each per pressure of the light, in the light of the Sun along a unit
    /// vector: the sum over the facets. (F27)
    #[must_use]
    pub fn loads(&self, sun: [f64; 3]) -> [[f64; 3]; 2] {
        let mut sum = [[0.0; 3]; 2];
        for facet in self.facets.list() {
            add_facet(&mut sum, facet, sun, 1.0);
        }
        self.take_shadows(&mut sum, sun);
        sum
    }

    /// Takes away what the facets in shadow would add.
    fn take_shadows(&self, sum: &mut [[f64; 3]; 2], sun: [f64; 3]) {
        let Some(shaded) = &self.shaded else { return };
        for facet in shaded.list() {
            if dot(facet.normal, sun) > 0.0 && shaded.may_be_hidden(facet) && shaded.is_hidden(facet, sun) {
                add_facet(sum, facet, sun, -1.0);
            }
        }
    }

    /// Surface (m²).
    fn area(&self) -> f64 {
        self.facets.list().iter().map(|facet| facet.area).sum()
    }
}

/// Adds a multiple of the loads of a facet that sees the Sun, per pressure. (F27)
fn add_facet([force, torque]: &mut [[f64; 3]; 2], facet: &Facet, sun: [f64; 3], factor: f64) {
    let incidence = dot(facet.normal, sun);
    if incidence > 0.0 {
        let pushed = add(sun, scale(LAMBERT, facet.normal));
        let push = scale(-factor * facet.area * incidence, pushed);
        *force = add(*force, push);
        *torque = add(*torque, cross(facet.middle, push));
    }
}

/// Directions spread evenly over the sphere.
fn spread(number: usize) -> Vec<[f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let place = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / number as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let across = ((1.0 - z) * (1.0 + z)).sqrt();
        [across * cos, across * sin, z]
    };
    (0..number).map(place).collect()
}

/// Root mean square of the lengths of vectors.
fn mean_length(vectors: impl ExactSizeIterator<Item = [f64; 3]>) -> f64 {
    let number = vectors.len().max(1) as f64;
    (vectors.map(|vector| dot(vector, vector)).sum::<f64>() / number).sqrt()
}

/// Length of the difference of two vectors.
fn apart([a, b]: [[f64; 3]; 2]) -> f64 {
    norm(minus(a, b))
}
