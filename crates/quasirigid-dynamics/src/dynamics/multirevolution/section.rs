//! Section of the sphere `|K| = G`: the half-plane through the axis of the steady spin circled, on which a revolution of the nutation begins
//! and ends. Angular momenta and attitudes are those of the axes of the section.
//! Equation (P9), docs/theory/05-propagation.md.

use std::f64::consts::TAU;

use crate::math::rotation::{self, Attitude};

/// Azimuth (rad) within which an angular momentum is on the half-plane.
const ON: f64 = 1e-6;

/// Half-plane of angular momenta `K = G(cos ψ e + sin ψ d)` about the axis `e` of a steady spin; `d` is the first of its axes, `e` the third. (P9)
#[derive(Clone, Copy, Debug)]
pub(super) struct Section {
    /// `|K|` (N·m·s).
    pub G: f64,
    /// Sense in which the angular momentum circles the axis, ±1.
    pub sense: f64,
}

impl Section {
    /// Angular momentum at an angle `ψ` (rad) from the axis.
    pub fn at(&self, psi: f64) -> [f64; 3] {
        let (sin, cos) = psi.sin_cos();
        [self.G * sin, 0.0, self.G * cos]
    }

    /// `dK/dψ` at an angle from the axis.
    pub fn slope(&self, psi: f64) -> [f64; 3] {
        let (sin, cos) = psi.sin_cos();
        [self.G * cos, 0.0, -self.G * sin]
    }

    /// Angle `ψ` (rad) of an angular momentum in the half-plane.
    pub fn angle([x, _, z]: [f64; 3]) -> f64 {
        x.atan2(z)
    }

    /// Angle (rad) of any angular momentum from the axis.
    pub fn from_axis([x, y, z]: [f64; 3]) -> f64 {
        x.hypot(y).atan2(z)
    }

    /// Azimuth (rad) of an angular momentum about the axis, from the half-plane on in the sense of the motion, from 0 to 2π. One on the
    /// half-plane to rounding has a whole turn before it.
    pub fn azimuth(&self, [x, y, _]: [f64; 3]) -> f64 {
        let azimuth = (self.sense * y).atan2(x);
        if azimuth < -ON { azimuth + TAU } else { azimuth }
    }

    /// Rate of the azimuth of an angular momentum that changes at a rate.
    #[inline(always)]
    pub fn azimuth_rate(&self, [x, y, _]: [f64; 3], [x_rate, y_rate, _]: [f64; 3]) -> f64 {
        self.sense * (x * y_rate - y * x_rate) / (x * x + y * y)
    }

    /// Attitude at the angle `to`, turned in the half-plane from one at the angle `from`: the inertial angular momentum stays, and so does the
    /// direction of the normal.
    pub fn moved(attitude: Attitude, from: f64, to: f64) -> Attitude {
        rotation::turned(attitude, rotation::to_inertial(attitude, [0.0, from - to, 0.0]))
    }
}
