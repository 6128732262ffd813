//! Steady spins of a body with momentum wheels at a given angular momentum, and the wobble about one of them.
//! The axes of these spins are not those of inertia, and their number is two to six: they are the stationary points of the energy on the
//! sphere `|K| = G`, found for the frozen body and continued to the deformed one.
//! Equations (Q15) and (Q16), docs/theory/16-methods.md.

use std::f64::consts::{PI, TAU};

use crate::math::bisection::bisected;
use crate::math::sphere::{StationaryKind, tangents};
use crate::math::sym3::{self, Sym, times};
use crate::math::vec3::{add, dot, norm, scale};
use crate::model::FlexibleBody;
use crate::modes::{FrozenSpin, RelativeEquilibrium, SpinMagnitude, frozen_spins};

/// Steady spins of a body with momentum wheels at an angular momentum, by the kind of stationary point of the energy without that of wheels.
/// (Q15)
#[derive(Clone, Debug)]
pub struct GyrostatSpins {
    /// Spins of least energy, which attract.
    pub minima: Vec<RelativeEquilibrium>,
    /// Spins of which the energy falls to two sides.
    pub saddles: Vec<RelativeEquilibrium>,
    /// Spins of greatest energy.
    pub maxima: Vec<RelativeEquilibrium>,
    /// Angular momentum (N·m·s) of each spin of least energy of the frozen body, and its place among the minima where it was found.
    frozen_minima: Vec<([f64; 3], Option<usize>)>,
}

impl GyrostatSpins {
    /// Steady spins at an angular momentum `G` (N·m·s), from those of the frozen body.
    ///
    /// Spins that the body loses as its parts yield are left out; there is none where every spin is steady.
    #[must_use]
    pub fn compute(body: &FlexibleBody, G: f64) -> Self {
        let given = SpinMagnitude::AngularMomentum(G);
        let mut spins =
            Self { minima: Vec::new(), saddles: Vec::new(), maxima: Vec::new(), frozen_minima: Vec::new() };
        for FrozenSpin { omega, angular_momentum, kind } in frozen_spins(body, given) {
            let found = RelativeEquilibrium::next_to(body, omega, given);
            if kind == StationaryKind::Minimum {
                spins.frozen_minima.push((angular_momentum, found.is_ok().then_some(spins.minima.len())));
            }
            let Ok(spin) = found else { continue };
            match kind {
                StationaryKind::Minimum => spins.minima.push(spin),
                StationaryKind::Saddle => spins.saddles.push(spin),
                StationaryKind::Maximum => spins.maxima.push(spin),
            }
        }
        spins
    }

    /// Spin of least energy that the one of the frozen body next to a direction of the angular momentum becomes; none if it was lost.
    #[must_use]
    pub fn attracting(&self, direction: [f64; 3]) -> Option<&RelativeEquilibrium> {
        let along = |(K, _): &&([f64; 3], _)| dot(*K, direction);
        let (_, place) = self.frozen_minima.iter().max_by(|a, b| along(a).total_cmp(&along(b)))?;
        place.map(|place| &self.minima[place])
    }

    /// Energy (J) of the lowest separatrix, below which a motion stays about one steady spin; infinite if a single spin attracts.
    #[must_use]
    pub fn barrier(&self) -> f64 {
        if self.minima.len() < 2 {
            return f64::INFINITY;
        }
        self.saddles.iter().map(|spin| spin.energy).fold(f64::INFINITY, f64::min)
    }
}

/// Wobble about a steady spin of least energy: the body as deformed by that spin, in free rotation. (Q16)
#[derive(Clone, Debug)]
pub struct GyrostatWobble {
    inverse: Sym,
    wheels: [f64; 3],
    /// `K` of the steady spin and two vectors across it, all of length `G`.
    frame: [[f64; 3]; 3],
    /// Energy (J) of the steady spin, and the part of it that is not that of rotation.
    steady: f64,
    elastic: f64,
}

/// Azimuths about the steady spin at which a level is looked at, and the halvings of the way between two of them.
const AZIMUTHS: usize = 72;
const HALVINGS: usize = 40;

impl GyrostatWobble {
    /// Wobble about a steady spin.
    #[must_use]
    pub fn about(body: &FlexibleBody, spin: &RelativeEquilibrium) -> Self {
        let K = spin.angular_momentum;
        let G = norm(K);
        let [first, second] = tangents(scale(G.recip(), K)).map(|across| scale(G, across));
        let inverse = sym3::inverse(body.full_inertia_at(&spin.q));
        let wheels = body.wheels().angular_momentum(0.0);
        let wobble = Self { inverse, wheels, frame: [K, first, second], steady: spin.energy, elastic: 0.0 };
        Self { elastic: spin.energy - wobble.energy(0.0, 0.0), ..wobble }
    }

    /// Energy (J) with the angular momentum at an angle from the steady spin and an azimuth about it (rad).
    fn energy(&self, angle: f64, azimuth: f64) -> f64 {
        let ((sin, cos), (sine, cosine)) = (angle.sin_cos(), azimuth.sin_cos());
        let [along, first, second] = self.frame;
        let across = add(scale(cosine, first), scale(sine, second));
        let own = add(add(scale(cos, along), scale(sin, across)), scale(-1.0, self.wheels));
        0.5 * dot(own, times(self.inverse, own)) + self.elastic
    }

    /// Least (`sign` 1) or greatest (`sign` −1) energy (J) at an angle from the steady spin (rad).
    fn extreme(&self, angle: f64, sign: f64) -> f64 {
        let height = |azimuth: f64| sign * self.energy(angle, azimuth);
        let step = TAU / AZIMUTHS as f64;
        let azimuths = (0..AZIMUTHS).map(|i| i as f64 * step);
        let lowest = azimuths.min_by(|a, b| height(*a).total_cmp(&height(*b))).unwrap_or(0.0);
        let [mut from, mut to] = [lowest - step, lowest + step];
        for _ in 0..HALVINGS {
            let [a, b] = [from + (to - from) / 3.0, to - (to - from) / 3.0];
            if height(a) < height(b) { to = b } else { from = a }
        }
        sign * height(0.5 * (from + to))
    }

    /// Energy (J) of the wobble whose greatest angle from the steady spin is given (rad). (Q16)
    #[must_use]
    pub fn energy_of(&self, angle: f64) -> f64 {
        self.extreme(angle, 1.0)
    }

    /// Least and greatest angle (rad) of the angular momentum from the steady spin at an energy (J); not a number where the level does not
    /// close about the steady spin. (Q16)
    #[must_use]
    pub fn nutation(&self, energy: f64) -> [f64; 2] {
        if energy <= self.steady {
            return [0.0; 2];
        }
        [-1.0, 1.0].map(|sign| self.first_angle(energy, sign))
    }

    /// Smallest angle (rad) at which the extreme energy comes to a value; not a number if it falls before.
    fn first_angle(&self, energy: f64, sign: f64) -> f64 {
        let step = PI / AZIMUTHS as f64;
        let mut below = 0.0;
        for i in 1..=AZIMUTHS {
            let angle = i as f64 * step;
            if self.extreme(angle, sign) >= energy {
                return bisected([below, angle], |angle| self.extreme(angle, sign), energy, true);
            }
            if self.extreme(angle, sign) < self.extreme(below, sign) {
                return f64::NAN;
            }
            below = angle;
        }
        f64::NAN
    }
}
