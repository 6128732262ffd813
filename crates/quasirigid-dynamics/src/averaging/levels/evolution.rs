//! Secular evolution along level curves of the slow energy, for bodies whose moments are nearly equal.
//! The average along rigid polhodes needs moments that differ by more than the deformation changes them; levels need no such difference.
//! Legs between saddles are found here and followed in `passage.rs`.
//! Equations (N1) to (N6), docs/theory/17-levels.md.

use std::sync::OnceLock;

use thiserror::Error;

use super::descent::Descent;
use super::energy::SlowEnergy;
use super::leg::Leg;
use super::level::{Level, traced};
use super::saddle_passage::Saddles;
use crate::math::sphere::{StationaryKind, StationaryPoint, directions, stationary};
use crate::math::sym3;
use crate::math::vec3::{norm, scale, unit};
use crate::model::{Principal, ReducedBody};

/// Secular evolution of a free body whose moments may be nearly equal: the angular momentum runs along a level curve of the slow energy
/// on the sphere `|K| = G`, and the energy falls at the mean power dissipated on that curve. (N1)–(N6)
///
/// For moments that differ much this is the [`Evolution`](crate::averaging::Evolution) along rigid polhodes, at the order of the reduced
/// body. The power of nearly equal moments needs order 5 or more: (V11) says which.
#[derive(Clone, Debug)]
pub struct LevelEvolution {
    pub(super) energy: SlowEnergy,
    /// Stationary points of the slow energy.
    pub(super) points: Vec<StationaryPoint>,
    /// Range of `h` over the sphere (1/s).
    pub(super) range: f64,
}

/// Error of a level evolution.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum LevelError {
    /// The angular momentum is zero or no number.
    #[error(
        "an angular momentum of {angular_momentum} N m s is out of range; give one that is finite and positive"
    )]
    NoAngularMomentum {
        /// Angular momentum (N·m·s).
        angular_momentum: f64,
    },
    /// The slow energy is the same everywhere.
    #[error("the slow energy is the same for every direction of the angular momentum: every spin is steady")]
    Flat,
    /// The start is a steady spin, which does not evolve.
    #[error("the rotation starts at a steady spin, about which nothing changes")]
    Steady,
    /// The level does not close, as on a separatrix.
    #[error(
        "the level of the slow energy could not be followed from here: it lies on a separatrix; move the start a little"
    )]
    Open,
    /// The wobble is so small that its energy is lost in rounding.
    #[error(
        "an angle of {angle:.3e} rad is too small to be followed: its energy is lost in rounding; ask for a larger one"
    )]
    TooSmall {
        /// The wobble (rad).
        angle: f64,
    },
    /// The wobble is about a family of steady spins.
    #[error(
        "the steady spins that attract form a family, from which there is no angle; give a duration or a share of the energy"
    )]
    Family,
}

/// Share of the angular velocity below which its tangential part is rounding.
const TANGENTIAL_ROUNDING: f64 = 1e-14;
/// Speed along a level, relative to the fastest, below which a spin is steady.
const AT_REST: f64 = 1e-9;
/// Directions in which the range of the energy is looked for.
const ENERGY_DIRECTIONS: usize = 400;

impl LevelEvolution {
    /// The levels of a reduced body with the angular momentum `G` (N·m·s).
    ///
    /// # Errors
    /// [`LevelError::NoAngularMomentum`], and [`LevelError::Flat`] where every spin is steady.
    pub fn new(body: &ReducedBody, G: f64) -> Result<Self, LevelError> {
        if !(G.is_finite() && G > 0.0) {
            return Err(LevelError::NoAngularMomentum { angular_momentum: G });
        }
        let energy = SlowEnergy::of(body, G);
        let given = Principal::compute(body.J).senses();
        let slowness = sym3::inverse(body.J).iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        let found = stationary(&energy.gradient, &given, TANGENTIAL_ROUNDING * slowness * G);
        if found.size <= TANGENTIAL_ROUNDING * slowness * G {
            return Err(LevelError::Flat);
        }
        let places = found.points.iter().map(|point| point.place).chain(directions(ENERGY_DIRECTIONS));
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for h in places.map(|u| energy.energy(u)) {
            (low, high) = (low.min(h), high.max(h));
        }
        Ok(Self { energy, points: found.points, range: high - low })
    }

    /// Angular momentum (N·m·s).
    #[must_use]
    pub fn angular_momentum(&self) -> f64 {
        self.energy.G
    }

    /// Slow energy (J) at an angular momentum `K` (body axes; only the direction matters). (N1)
    #[must_use]
    pub fn slow_energy(&self, K: [f64; 3]) -> f64 {
        self.energy.joules(self.energy.energy(unit(K)))
    }

    /// Angular momenta (N·m·s) of the isolated steady spins, each with its kind of stationary point of the energy. (N2)
    pub fn steady(&self) -> impl Iterator<Item = ([f64; 3], StationaryKind)> + '_ {
        self.points.iter().map(|point| (scale(self.energy.G, point.place), point.kind))
    }

    /// Level through an angular momentum `K` (body axes; only the direction matters). (N4)
    ///
    /// # Errors
    /// [`LevelError::Steady`] and [`LevelError::Open`].
    pub fn level(&self, K: [f64; 3]) -> Result<Level, LevelError> {
        let u = self.moving(K)?;
        let leg = self.leg(u, None)?;
        let turn = traced(&self.energy, u, leg.circled, |_| {}).ok_or(LevelError::Open)?;
        Ok(turn.level(self.slow_energy(K)))
    }

    /// Direction of an angular momentum; an error at a steady spin.
    pub(super) fn moving(&self, K: [f64; 3]) -> Result<[f64; 3], LevelError> {
        if !(norm(K).is_finite() && norm(K) > 0.0) {
            return Err(LevelError::NoAngularMomentum { angular_momentum: norm(K) });
        }
        let u = unit(K);
        if norm(self.energy.velocity(u).0) <= AT_REST * self.energy.fastest {
            return Err(LevelError::Steady);
        }
        Ok(u)
    }

    pub(super) fn saddles(&self) -> Saddles<'_> {
        Saddles::new(&self.energy, &self.points, self.range)
    }

    /// Leg that starts at a place, bounded above by a separatrix of this `h` or by the next stationary point.
    pub(super) fn leg(&self, start: [f64; 3], below: Option<f64>) -> Result<Leg, LevelError> {
        let (descent, minimum) =
            Descent::from(&self.energy, &self.points, start, 1.0).ok_or(LevelError::Open)?;
        let center = descent.end();
        let (h, lowest) = (self.energy.energy(start), self.energy.energy(center));
        let above =
            self.points.iter().map(|point| self.energy.energy(point.place)).filter(|height| *height > h);
        let top = below.unwrap_or_else(|| above.fold(h + self.range, f64::min));
        let saddles = self.saddles();
        let mut leg = Leg {
            descent,
            circled: center,
            isolated: minimum.is_some(),
            top,
            bottom: lowest,
            saddles: Vec::new(),
            minimum: lowest,
            smallest: OnceLock::new(),
        };
        let margin = saddles.margin();
        let (candidates, flat): (Vec<_>, Vec<_>) =
            saddles.below(h - margin).into_iter().partition(|(_, height)| *height > lowest + margin);
        // a minimum with a saddle of its own height belongs to a family, to rounding
        leg.isolated &= flat.is_empty();
        for (saddle, height) in &candidates {
            if saddles.meets(leg.descent.at(&self.energy, height + margin), saddle) {
                leg.bottom = *height;
                let beside = candidates.iter().filter(|(_, other)| (other - height).abs() < 0.1 * margin);
                let place = leg.descent.at(&self.energy, height + margin);
                leg.saddles = beside
                    .filter(|(other, _)| saddles.meets(place, other))
                    .map(|(other, _)| *other)
                    .collect();
                break;
            }
        }
        if !leg.saddles.is_empty() || !leg.isolated {
            let summit = Descent::from(&self.energy, &self.points, start, -1.0);
            leg.circled = summit.map_or(center, |(summit, _)| summit.end());
        }
        Ok(leg)
    }
}
