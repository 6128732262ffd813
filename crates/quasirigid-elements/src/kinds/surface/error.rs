//! Estimates of the error of an approximation.

use std::f64::consts::PI;

use super::elements::Meshed;
use crate::kinds::compliance;
use crate::math::vec3::{add, cross, dot, minus, norm, scale};
use crate::math::watch;
use quasirigid_mesh::meshing::{GradedMesh, Neck};
use quasirigid_mesh::surface::ClosedSurface;

/// Growth of the compliance by the last two degrees at which polynomials have converged.
pub(super) const CONVERGED: f64 = 1e-3;
/// Bound on the contribution of all further degrees, over that growth. (G10)
pub(super) const TAIL: f64 = 3.0;
/// Difference between polynomials and cells at which they agree.
pub(super) const AGREED: f64 = 0.03;
/// Least error that is claimed: that of rounding and of the facets.
pub(super) const LEAST_ERROR: f64 = 2e-3;

/// Margin for meshes of which neither is a refinement of the other. (G12)
const UNEVEN: f64 = 1.5;
/// Share of a cell's width to which the cells of a mesh fill a notch; measured. (G12)
const FILLED: f64 = 0.2;
/// Most triangles around a neck that are examined.
const MOST_TRIANGLES: usize = 1_000;

/// Error of a mesh from its difference to a coarser one: the rest if the error falls with no more than the width of the cells, as it does
/// at a crack, and the error hidden in a neck of few cells. (G12)
pub(super) fn between_meshes(surface: &ClosedSurface, fine: &Meshed, coarse: &Meshed, necks: &[Neck]) -> f64 {
    let apart = compliance::gap(&compliance::of(&fine.body), &compliance::of(&coarse.body));
    let ratio = (fine.cells as f64 / coarse.cells as f64).cbrt();
    (UNEVEN * apart / (ratio - 1.0)).max(hidden(surface, &fine.mesh, necks)).max(LEAST_ERROR)
}

/// Error of the cells in necks, whatever the solution. (G12)
pub(super) fn hidden(surface: &ClosedSurface, mesh: &GradedMesh, necks: &[Neck]) -> f64 {
    let of = |neck: &Neck| {
        watch::ask();
        let width = mesh.width(neck.center);
        let depth = FILLED * width / (2.0 * (0.5 * notch(surface, neck, width)).tan());
        (width / neck.radius).powi(3).max((1.0 + depth / neck.radius).powi(3) - 1.0)
    };
    necks.iter().map(of).sum()
}

/// Smallest angle (rad) between parts of the surface that face each other across less than a width, at a neck; that of a plane
/// where none do.
fn notch(surface: &ClosedSurface, neck: &Neck, width: f64) -> f64 {
    let near = |corners: &[[f64; 3]; 3]| {
        corners.iter().any(|corner| distance(*corner, neck.center) < neck.radius + 1.5 * width)
    };
    let places = surface.vertices();
    let around: Vec<[[f64; 3]; 3]> =
        surface.triangles().iter().map(|corners| corners.map(|corner| places[corner])).filter(near).collect();
    let step = around.len().div_ceil(MOST_TRIANGLES).max(1);
    let around: Vec<&[[f64; 3]; 3]> = around.iter().step_by(step).collect();
    let mut least = PI;
    for (index, one) in around.iter().enumerate() {
        for other in &around[..index] {
            let apart =
                one.iter().flat_map(|a| other.iter().map(|b| distance(*a, *b))).fold(f64::INFINITY, f64::min);
            let [n, m] = [normal(one), normal(other)];
            let across = minus(middle(other), middle(one));
            let rounding = FLAT * norm(across);
            if apart < width && dot(across, n) > rounding && dot(across, m) < -rounding {
                least = least.min(PI - dot(n, m).clamp(-1.0, 1.0).acos());
            }
        }
    }
    least
}

/// Height over a triangle, as a share of the distance, that is rounding.
const FLAT: f64 = 1e-6;

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(minus(a, b))
}

fn middle([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    scale(1.0 / 3.0, add(add(*a, *b), *c))
}

/// Outward unit normal.
fn normal([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let normal = cross(minus(*b, *a), minus(*c, *a));
    scale(norm(normal).recip(), normal)
}
