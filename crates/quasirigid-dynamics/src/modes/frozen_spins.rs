//! Steady spins of the frozen body with momentum wheels: where they lie before its parts yield.
//! Equations (Q15), (M27), docs/theory/16-methods.md and 15-modes.md.

use super::equilibrium::SpinMagnitude;
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sphere::{StationaryKind, deviator, stationary};
use crate::math::sym3::{self, Sym, times};
use crate::math::vec3::{add, norm, scale};
use crate::model::{FlexibleBody, Principal};

/// Steady spin of the frozen body, isolated from others. (M27)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrozenSpin {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Angular momentum with that of wheels (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Kind of stationary point: of the energy without that of wheels on `|K| = G`, or of `½ω·Jω + k·ω` on a sphere of angular velocities.
    pub kind: StationaryKind,
}

/// Share of the field below which a tangential part is rounding.
const TANGENTIAL: f64 = 1e-14;

/// Isolated steady spins of the frozen body with its momentum wheels, at an angular momentum or at a rate; none where every spin is steady.
/// (M27)
#[must_use]
pub fn frozen_spins(body: &FlexibleBody, given: SpinMagnitude) -> Vec<FrozenSpin> {
    let (J, wheels) = (body.invariants().J, body.wheels().angular_momentum(0.0));
    let inverse = sym3::inverse(J);
    let (radius, field) = match given {
        SpinMagnitude::Rate(rate) => (rate, affine(J, wheels)),
        SpinMagnitude::AngularMomentum(G) => (G, affine(inverse, scale(-1.0, times(inverse, wheels)))),
    };
    let principal = Principal::compute(J);
    let along = |axis| norm(field.vector(scale(radius, axis)));
    let size = principal.axes.map(along).into_iter().fold(0.0, f64::max);
    let found = stationary(&deviator(&field, radius), &principal.senses(), TANGENTIAL * size);
    let spin = |place: [f64; 3], kind| {
        let at = scale(radius, place);
        let (omega, angular_momentum) = match given {
            SpinMagnitude::Rate(_) => (at, add(times(J, at), wheels)),
            SpinMagnitude::AngularMomentum(_) => (times(inverse, add(at, scale(-1.0, wheels))), at),
        };
        FrozenSpin { omega, angular_momentum, kind }
    };
    found.points.iter().map(|point| spin(point.place, point.kind)).collect()
}

/// `x ↦ A x + b`.
fn affine(A: Sym, b: [f64; 3]) -> Series {
    let mut linear = Homogeneous::linear(&sym3::rows(A));
    linear.add_scaled(1.0, &Homogeneous::constant(&b));
    let mut map = Series::zero(1, 3);
    map.set(linear);
    map
}
