//! Section of the sphere `|K| = G`: the half-plane through the axis of the steady spin circled, on which a revolution of the nutation begins
//! and ends.
//! Equation (P9), docs/theory/05-propagation.md.

use std::f64::consts::TAU;

use crate::dynamics::steady::IsolatedSpin;
use crate::math::ode::Checkpoint;
use crate::math::rotation::{self, Attitude};
use crate::math::sphere::{StationaryKind, tangents};
use crate::math::vec3::{add, cross, dot, norm, scale};

/// Azimuth (rad) within which an angular momentum is on the half-plane.
const ON: f64 = 1e-6;

/// Half-plane of angular momenta `K = G(cos ψ e + sin ψ d)` about the axis `e` of a steady spin. (P9)
#[derive(Clone, Copy, Debug)]
pub(super) struct Section {
    /// `|K|` (N·m·s).
    pub G: f64,
    /// Axis of the steady spin, and the direction of the half-plane across it.
    e: [f64; 3],
    d: [f64; 3],
    /// Normal of the half-plane, `e × d`.
    n: [f64; 3],
    /// Sense in which the angular momentum circles the axis, ±1.
    pub sense: f64,
}

impl Section {
    /// Sections about the steady spins that others circle, the nearest to an angular momentum first. They pass the saddles, where the motion is
    /// slow, at a right angle.
    pub fn about(spins: &[IsolatedSpin], K: [f64; 3]) -> Vec<Self> {
        let G = norm(K);
        let direction =
            |spin: &IsolatedSpin| scale(norm(spin.angular_momentum).recip(), spin.angular_momentum);
        let saddle = |spin: &&IsolatedSpin| spin.kind == StationaryKind::Saddle;
        let mut axes: Vec<_> = spins.iter().filter(|spin| !saddle(spin)).map(direction).collect();
        axes.sort_by(|a, b| dot(*b, K).total_cmp(&dot(*a, K)));
        let saddles: Vec<_> = spins.iter().filter(saddle).map(direction).collect();
        let section = |e: [f64; 3]| {
            let nearest = saddles.iter().max_by(|a, b| dot(**a, e).total_cmp(&dot(**b, e)));
            let d = match nearest.map(|saddle| cross(*saddle, e)) {
                Some(across) if norm(across) > 0.0 => scale(norm(across).recip(), across),
                _ => tangents(e)[0],
            };
            Self { G, e, d, n: cross(e, d), sense: 1.0 }
        };
        axes.into_iter().map(section).collect()
    }

    /// Angular momentum at an angle `ψ` (rad) from the axis.
    pub fn at(&self, psi: f64) -> [f64; 3] {
        let (sin, cos) = psi.sin_cos();
        add(scale(self.G * cos, self.e), scale(self.G * sin, self.d))
    }

    /// `dK/dψ` at an angle from the axis.
    pub fn slope(&self, psi: f64) -> [f64; 3] {
        let (sin, cos) = psi.sin_cos();
        add(scale(-self.G * sin, self.e), scale(self.G * cos, self.d))
    }

    /// Axis of the steady spin, a unit vector.
    pub fn axis(&self) -> [f64; 3] {
        self.e
    }

    /// Angle `ψ` (rad) of an angular momentum in the half-plane.
    pub fn angle(&self, K: [f64; 3]) -> f64 {
        dot(K, self.d).atan2(dot(K, self.e))
    }

    /// Azimuth (rad) of an angular momentum about the axis, from the half-plane on in the sense of the motion, from 0 to 2π. One on the
    /// half-plane to rounding has a whole turn before it.
    pub fn azimuth(&self, K: [f64; 3]) -> f64 {
        let azimuth = (self.sense * dot(K, self.n)).atan2(dot(K, self.d));
        if azimuth < -ON { azimuth + TAU } else { azimuth }
    }

    /// Rate of the azimuth of an angular momentum that changes at a rate.
    #[inline(always)]
    pub fn azimuth_rate(&self, K: [f64; 3], rate: [f64; 3]) -> f64 {
        let [along, across] = [dot(K, self.d), dot(K, self.n)];
        self.sense * (along * dot(rate, self.n) - across * dot(rate, self.d))
            / (along * along + across * across)
    }

    /// Attitude at the angle `to`, turned in the half-plane from one at the angle `from`: the inertial angular momentum stays, and so does the
    /// direction of the normal.
    pub fn moved(&self, attitude: Attitude, from: f64, to: f64) -> Attitude {
        rotation::turned(attitude, scale(from - to, rotation::to_inertial(attitude, self.n)))
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(&self.e);
        checkpoint.save_list(&self.d);
        checkpoint.save_list(&[self.G, self.sense]);
    }

    pub fn load(checkpoint: &mut Checkpoint) -> Option<Self> {
        let (mut e, mut d, mut rest) = ([0.0; 3], [0.0; 3], [0.0; 2]);
        checkpoint.load_into(&mut e)?;
        checkpoint.load_into(&mut d)?;
        checkpoint.load_into(&mut rest)?;
        let [G, sense] = rest;
        Some(Self { G, e, d, n: cross(e, d), sense })
    }
}
