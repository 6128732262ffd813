use thiserror::Error;

use super::descent::{Descent, unit};
use super::energy::SlowEnergy;
use super::leg::Leg;
use super::level::{Level, traced};
use super::saddle_passage::Saddles;
use crate::math::sphere::{StationaryKind, StationaryPoint, directions, stationary};
use crate::math::sym3;
use crate::math::vec3::{norm, scale};
use crate::model::{Principal, ReducedBody};

/// How the rotation of a free body ages whose moments may be nearly equal: it runs along a level curve of the slow energy on the
/// sphere `|K| = G`, and its energy falls at the mean power dissipated there. (N1)–(N6)
///
/// Where the moments differ much this is the [`Evolution`](crate::averaging::Evolution) along rigid polhodes, at the order of the
/// reduced body. The power of nearly equal moments needs order 5 or more: (V11) says which.
#[derive(Clone, Debug)]
pub struct LevelEvolution {
    pub(super) energy: SlowEnergy,
    /// Stationary points of the slow energy.
    pub(super) points: Vec<StationaryPoint>,
    /// Range of `h` over the sphere (1/s).
    pub(super) range: f64,
}

/// Levels that cannot be followed.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum LevelError {
    /// Nothing turns, or the momentum is no number.
    #[error(
        "an angular momentum of {momentum} N m s means nothing here; give one that is finite and positive"
    )]
    NoMomentum {
        /// Angular momentum (N·m·s).
        momentum: f64,
    },
    /// The slow energy is the same everywhere.
    #[error("the slow energy is the same for every direction of the angular momentum: every spin is steady")]
    Flat,
    /// The start is a steady spin, which does not age.
    #[error("the rotation starts at a steady spin, about which nothing ages")]
    Steady,
    /// The level does not close, as on a separatrix.
    #[error(
        "the level of the slow energy could not be followed from here: it lies on a separatrix; move the start a little"
    )]
    Open,
    /// A wobble so small that its energy is lost in rounding.
    #[error(
        "a wobble of {angle:.3e} rad is too small to be followed: its energy is lost in rounding; ask for a larger one"
    )]
    TooSmall {
        /// The wobble (rad).
        angle: f64,
    },
    /// A wobble about a family of steady spins.
    #[error(
        "the steady spins that attract form a family, and a wobble about them has no angle; give a duration or a share of the energy"
    )]
    Family,
}

/// Share of the spin below which a tangential part of it is rounding.
const ROUNDING: f64 = 1e-14;
/// Speed along a level, relative to the fastest, below which a spin is steady.
const AT_REST: f64 = 1e-9;
/// Directions in which the range of the energy is looked for.
const LOOKS: usize = 400;

impl LevelEvolution {
    /// The levels of a reduced body with the angular momentum `G` (N·m·s).
    ///
    /// # Errors
    /// [`LevelError::NoMomentum`], and [`LevelError::Flat`] where every spin is steady.
    pub fn new(body: &ReducedBody, G: f64) -> Result<Self, LevelError> {
        if !(G.is_finite() && G > 0.0) {
            return Err(LevelError::NoMomentum { momentum: G });
        }
        let energy = SlowEnergy::of(body, G);
        let axes = Principal::compute(body.J).axes;
        let given = [axes, axes.map(|axis| scale(-1.0, axis))].concat();
        let slowness = sym3::inverse(body.J).iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        let found = stationary(&energy.gradient, &given, ROUNDING * slowness * G);
        if found.size <= ROUNDING * slowness * G {
            return Err(LevelError::Flat);
        }
        let places = found.points.iter().map(|point| point.place).chain(directions(LOOKS));
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for h in places.map(|u| energy.energy(u)) {
            (low, high) = (low.min(h), high.max(h));
        }
        Ok(Self { energy, points: found.points, range: high - low })
    }

    /// Angular momentum (N·m·s).
    #[must_use]
    pub fn momentum(&self) -> f64 {
        self.energy.G
    }

    /// Slow energy (J) at a momentum `K` (body axes; its direction counts). (N1)
    #[must_use]
    pub fn slow_energy(&self, K: [f64; 3]) -> f64 {
        self.energy.joules(self.energy.energy(unit(K)))
    }

    /// Momenta (N·m·s) of the isolated steady spins, and what each is for the energy. (N2)
    pub fn steady(&self) -> impl Iterator<Item = ([f64; 3], StationaryKind)> + '_ {
        self.points.iter().map(|point| (scale(self.energy.G, point.place), point.kind))
    }

    /// The level through a momentum `K` (body axes; its direction counts). (N4)
    ///
    /// # Errors
    /// [`LevelError::Steady`] and [`LevelError::Open`].
    pub fn level(&self, K: [f64; 3]) -> Result<Level, LevelError> {
        let u = self.moving(K)?;
        let leg = self.leg(u, None)?;
        let turn = traced(&self.energy, u, leg.circled, |_| {}).ok_or(LevelError::Open)?;
        Ok(turn.level(self.slow_energy(K)))
    }

    /// The direction of a momentum that is not steady.
    pub(super) fn moving(&self, K: [f64; 3]) -> Result<[f64; 3], LevelError> {
        if !(norm(K).is_finite() && norm(K) > 0.0) {
            return Err(LevelError::NoMomentum { momentum: norm(K) });
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

    /// The leg that starts at a place, below a separatrix of this `h` or anywhere.
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
        };
        let margin = saddles.margin();
        let candidates: Vec<_> =
            saddles.below(h - margin).into_iter().filter(|(_, height)| *height > lowest + margin).collect();
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
