//! Shadows and occultations against areas by hand.

use quasirigid_math::vec3::{dot, unit};
use quasirigid_photometry::{Facets, Scattering};

use crate::support::{V, boxes, law, turned};

/// A tower of height `H` on the far half of a slab, both of width `W`; the Sun behind the tower at an elevation, the observer above.
/// The roof has light `L(1, sin)` on all of its area, and the slab on what the shadow of length `H/tan` leaves.
#[test]
fn the_shadow_of_a_tower_has_its_length() {
    let [width, depth, height] = [3.0, 4.0, 1.5];
    let surface = boxes(
        &[[[0.0, 0.0, -1.0], [depth, width, 0.0]], [[-2.0, 0.0, -1.0], [-1e-9, width, height]]],
        turned,
    );
    for elevation in [30_f64, 45.0, 70.0] {
        let (sine, cosine) = elevation.to_radians().sin_cos();
        let sun = turned([-cosine, 0.0, sine]);
        let observer = turned([0.0, 0.0, 1.0]);
        let alpha = dot(sun, observer).acos();
        let law = law(Scattering::Lambert, alpha);
        let shadow = height * cosine / sine;
        let lit = width * (2.0 + depth - shadow);
        let known = lit * law.light(1.0, sine);
        let found = Facets::of_surface(&surface).refined(&surface, 2).brightness(&law, sun, observer);
        // facets of 1/96 of the slab
        assert!((found / known - 1.0).abs() < 0.02, "{elevation}: {found} {known}");
        let coarse = Facets::of_surface(&surface).brightness(&law, sun, observer);
        assert!((found - known).abs() < (coarse - known).abs() + 1e-3 * known, "{coarse} {found} {known}");
    }
}

/// A tower slimmer than the triangles of its slab throws its shadow, too.
#[test]
fn the_shadow_of_a_slim_tower_is_not_missed() {
    let (half, width, height) = (10.0, 0.8, 12.0);
    let surface = boxes(
        &[
            [[-half, -half, -1.0], [half, half, 0.0]],
            [[-0.5 * width, -0.5 * width, 1e-6], [0.5 * width, 0.5 * width, height]],
        ],
        turned,
    );
    for azimuth in [10_f64, 100.0, 215.0] {
        let (sine, cosine) = azimuth.to_radians().sin_cos();
        let sun = turned(unit([cosine, sine, 2.0]));
        let observer = turned([0.0, 0.0, 1.0]);
        let law = law(Scattering::Lambert, dot(sun, observer).acos());
        let [coarse, fine] = [1, 4].map(|level| {
            Facets::of_surface(&surface).refined(&surface, level).brightness(&law, sun, observer)
        });
        assert!((coarse / fine - 1.0).abs() < 0.01, "{azimuth}: {coarse} {fine}");
        // the roof is in the light of the slab it stands on; the shadow is as wide as the tower aslant
        let across = width * (cosine.abs() + sine.abs());
        let known = 4.0 * half * half - across * 0.5 * height;
        let found = fine / law.light(1.0, dot(sun, observer));
        assert!((found / known - 1.0).abs() < 5e-3, "{azimuth}: {found} {known}");
    }
}

/// Two boxes in a row, seen and lit along the row: the far one is hidden where the near one stands before it.
#[test]
fn a_box_hides_the_one_behind() {
    let view: V = turned(unit([1.0, 0.0, 0.0]));
    let surface = boxes(&[[[0.0, 0.0, 0.0], [1.0, 2.0, 2.0]], [[3.0, 0.0, 0.0], [4.0, 1.0, 2.0]]], turned);
    let found = Facets::of_surface(&surface).refined(&surface, 1).brightness(
        &law(Scattering::LommelSeeliger, 0.0),
        view,
        view,
    );
    // the projected area at opposition: 4, of which the near box covers 2 and shows 2
    assert!((found - 4.0).abs() < 0.03, "{found}");
    let alone = boxes(&[[[0.0, 0.0, 0.0], [1.0, 2.0, 2.0]]], turned);
    let facets = Facets::of_surface(&alone);
    assert!(facets.is_convex() && facets.count() == 12);
    let exact = facets.brightness(&law(Scattering::LommelSeeliger, 0.0), view, view);
    assert!((exact - 4.0).abs() < 1e-12);
    assert!((facets.mean_cross_section() - 4.0).abs() < 1e-12); // 16 of surface
}
