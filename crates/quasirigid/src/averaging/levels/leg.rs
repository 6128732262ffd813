use std::f64::consts::TAU;

use super::descent::Descent;
use super::energy::SlowEnergy;
use super::level::{Level, Traced, traced};
use crate::math::chebyshev::Chebyshev;
use crate::math::sphere::StationaryPoint;

/// A stretch of the evolution between two energies where nothing branches. (N5)
///
/// The place on it is `ξ = ln (top − h)/(h − bottom)`: both ends, where time diverges or has a logarithm in it, are at infinity.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    pub descent: Descent,
    /// Place of the steady spin that nutation is measured from.
    pub circled: [f64; 3],
    /// Whether the minimum is isolated: in a family no wobble about it has an angle.
    pub isolated: bool,
    /// `h` that bounds the leg above and below (1/s).
    pub top: f64,
    pub bottom: f64,
    /// The saddles that end it; none where it ends at the minimum.
    pub saddles: Vec<StationaryPoint>,
    /// `h` of the minimum that the descent leads to (1/s).
    pub minimum: f64,
}

/// A piece of a leg over which time and turns are interpolated.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub ends: [f64; 2],
    fit: Chebyshev<2>,
}

/// Place beyond which a wobble about a minimum is so small that the rate is that of the smallest.
const AXIS: f64 = 16.0;
/// Relative error of a piece, and halvings that may be needed for it.
const TOLERANCE: f64 = 1e-8;
const HALVINGS: u32 = 6;

impl Leg {
    /// `h − bottom` at a place (1/s).
    pub fn height(&self, xi: f64) -> f64 {
        (self.top - self.bottom) / (1.0 + xi.exp())
    }

    /// The place of a value of `h − bottom` (1/s).
    pub fn place(&self, height: f64) -> f64 {
        ((self.top - self.bottom - height) / height).ln()
    }

    /// A unit vector on the level at a place.
    pub fn on(&self, energy: &SlowEnergy, xi: f64) -> [f64; 3] {
        self.descent.at(energy, self.bottom + self.height(xi))
    }

    /// One turn along the level at a place.
    pub fn turn(&self, energy: &SlowEnergy, xi: f64) -> Option<Traced> {
        traced(energy, self.on(energy, xi), self.circled, |_| {})
    }

    /// The level at a place.
    pub fn level(&self, energy: &SlowEnergy, xi: f64) -> Option<Level> {
        let turn = self.turn(energy, xi)?;
        Some(turn.level(energy.joules(self.bottom + self.height(xi))))
    }

    /// Time (s) and turns per unit of the way.
    pub fn slowness(&self, energy: &SlowEnergy, xi: f64) -> Option<[f64; 2]> {
        let xi = if self.saddles.is_empty() { xi.min(AXIS) } else { xi };
        let Traced { period, loss, angle, .. } = self.turn(energy, xi)?;
        let fall = energy.G * self.height(xi) / (1.0 + (-xi).exp());
        Some([fall * period / loss, fall * angle / (TAU * loss)])
    }

    /// Pieces that cover an interval, each as long as it is well interpolated; fewer where a level is not closed.
    pub fn pieces(&self, energy: &SlowEnergy, ends: [f64; 2]) -> Option<Vec<Piece>> {
        let mut pieces = Vec::new();
        self.cover(energy, ends, HALVINGS, &mut pieces)?;
        Some(pieces)
    }

    fn cover(
        &self,
        energy: &SlowEnergy,
        ends: [f64; 2],
        halvings: u32,
        pieces: &mut Vec<Piece>,
    ) -> Option<()> {
        let fit = Chebyshev::fit(ends, |xi| self.slowness(energy, xi))?;
        if halvings == 0 || fit.tail() < TOLERANCE {
            pieces.push(Piece { ends, fit });
            return Some(());
        }
        let middle = 0.5 * (ends[0] + ends[1]);
        self.cover(energy, [ends[0], middle], halvings - 1, pieces)?;
        self.cover(energy, [middle, ends[1]], halvings - 1, pieces)
    }
}

impl Piece {
    /// Time (s) and turns from the start of the piece to a place in it.
    pub fn until(&self, xi: f64) -> [f64; 2] {
        self.fit.integral(xi)
    }
}
