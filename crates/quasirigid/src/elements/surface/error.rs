//! Estimates of what an approximation leaves out.

use super::compliance;
use super::elements::Meshed;
use crate::math::meshing::Neck;

/// Growth of the compliance by the last two degrees at which polynomials have converged.
pub(super) const CONVERGED: f64 = 1e-3;
/// What all further degrees may bring, beside that growth.
pub(super) const TAIL: f64 = 3.0;
/// Difference between polynomials and cells at which they agree.
pub(super) const AGREED: f64 = 0.03;
/// Least error that is claimed: that of rounding and of facets as they are.
pub(super) const LEAST: f64 = 2e-3;

/// Error of a mesh beside a coarser one: what cells of no width would bring if it fell with no more than their width, as it does at
/// a crack, and what a neck of few cells hides. (G12)
pub(super) fn between_meshes(fine: &Meshed, coarse: &Meshed, necks: &[Neck]) -> f64 {
    let apart = compliance::gap(&compliance::of(&fine.body), &compliance::of(&coarse.body));
    let ratio = (fine.cells as f64 / coarse.cells as f64).cbrt();
    let hidden: f64 = necks.iter().map(|neck| (fine.mesh.width(neck.center) / neck.radius).powi(3)).sum();
    (apart / (ratio - 1.0)).max(hidden).max(LEAST)
}
