//! Brightness that the facets of a body add up to.

use quasirigid_math::vec3::dot;
use quasirigid_mesh::surface::{ClosedSurface, Facet};

use crate::scattering::LawAt;

/// Facets of a body, in its own unit of length.
///
/// Convex bodies throw no shadow on themselves; of others each facet is in light, and seen, as its middle is.
#[derive(Clone, Debug)]
pub struct Facets(quasirigid_mesh::surface::Facets);

impl Facets {
    /// Facets of an ellipsoid with semi-axes along x, y, z: `20 · 4^level`, each with the exact normal and the area of its share of the
    /// sphere that the ellipsoid is stretched from. (O15)
    #[must_use]
    pub fn of_ellipsoid(semi_axes: [f64; 3], level: usize) -> Self {
        Self(quasirigid_mesh::surface::Facets::of_ellipsoid(semi_axes, level))
    }

    /// Facets of a closed surface, each triangle as one: exact where the surface is convex.
    #[must_use]
    pub fn of_surface(surface: &ClosedSurface) -> Self {
        Self(quasirigid_mesh::surface::Facets::of_surface(surface))
    }

    /// The same surface with every triangle that may lie in shadow or be hidden cut into facets no longer than a 24th of the body, and each of
    /// those into `4^level`.
    #[must_use]
    pub fn refined(&self, surface: &ClosedSurface, level: usize) -> Self {
        Self(self.0.refined(surface, level))
    }

    /// Number of facets.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.list().len()
    }

    /// Whether no facet throws a shadow on another.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.0.is_convex()
    }

    /// Cross-section that a convex body of this surface has in the mean over all directions: a quarter of the surface.
    #[must_use]
    pub fn mean_cross_section(&self) -> f64 {
        self.0.mean_cross_section()
    }

    /// Brightness (area) in the light of the Sun seen by an observer, unit vectors in the axes of the body: that of a disc of this area, as
    /// bright as a white sphere at opposition. (O7)
    #[must_use]
    pub fn brightness(&self, law: &LawAt, sun: [f64; 3], observer: [f64; 3]) -> f64 {
        let light = |facet: &Facet| {
            let [incidence, emission] = [sun, observer].map(|direction| dot(facet.normal, direction));
            if !(incidence > 0.0 && emission > 0.0)
                || self.0.is_hidden(facet, sun)
                || self.0.is_hidden(facet, observer)
            {
                return 0.0;
            }
            facet.area * law.light(emission, incidence)
        };
        self.0.list().iter().map(light).sum()
    }
}
