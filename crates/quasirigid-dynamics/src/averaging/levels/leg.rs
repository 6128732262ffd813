//! Leg of a level evolution: stretch between two stationary energies, with time and revolutions over `ξ`.
//! `ξ` puts both ends at infinity, where the time diverges or has a logarithm; the integrand is interpolated, since each value costs a
//! revolution along a level.
//! Equation (N5), docs/theory/17-levels.md.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::descent::Descent;
use super::energy::SlowEnergy;
use super::level::{Level, Traced, from_nearer_sense, traced};
use crate::math::chebyshev::Chebyshev;
use crate::math::rotation::angle;
use crate::math::sphere::StationaryPoint;

/// Stretch of the evolution between two energies, without a branch between them. (N5)
///
/// The place on it is `ξ = ln (top − h)/(h − bottom)`: both ends, where time diverges or has a logarithm in it, are at infinity.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    pub descent: Descent,
    /// Direction of the steady spin that nutation is measured from.
    pub circled: [f64; 3],
    /// True if the minimum is isolated: a wobble about a family has no angle.
    pub isolated: bool,
    /// `h` that bounds the leg above and below (1/s).
    pub top: f64,
    pub bottom: f64,
    /// Saddles that end the leg; none where the leg ends at the minimum.
    pub saddles: Vec<StationaryPoint>,
    /// `h` of the minimum that the descent leads to (1/s).
    pub minimum: f64,
    /// Circuit of the level at [`AXIS`] about a minimum, followed when first asked for.
    pub smallest: OnceLock<Option<Traced>>,
}

/// Piece of a leg over which time and revolutions are interpolated.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub ends: [f64; 2],
    fit: Chebyshev<2>,
}

/// Place beyond which a wobble about a minimum is so small that the rate is that of the smallest: `e^{−8}` of the leg's widest.
const AXIS: f64 = 16.0;
/// Relative error of a piece, and the limit of halvings to reach it.
const PIECE_TOLERANCE: f64 = 1e-8;
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

    /// One circuit of the level at a place. Levels beyond [`AXIS`] next to a minimum are that of `AXIS` made smaller: their own are lost
    /// in rounding. (N5)
    pub fn turn(&self, energy: &SlowEnergy, xi: f64) -> Option<Traced> {
        let circuit = |xi: f64| traced(energy, self.on(energy, xi), self.circled, |_| {});
        if xi < AXIS || !self.saddles.is_empty() {
            return circuit(xi);
        }
        let smallest = (*self.smallest.get_or_init(|| circuit(AXIS)))?;
        let share = self.height(xi) / self.height(AXIS);
        let end = self.descent.end();
        let limit = [angle(self.circled, end); 2];
        let limit = (!self.isolated).then(|| from_nearer_sense(energy, end, limit)[0]);
        Some(smallest.smaller(share, limit))
    }

    /// The level at a place.
    pub fn level(&self, energy: &SlowEnergy, xi: f64) -> Option<Level> {
        let turn = self.turn(energy, xi)?;
        Some(turn.level(energy.joules(self.bottom + self.height(xi))))
    }

    /// Time (s) and revolutions per unit of `ξ`.
    pub fn slowness(&self, energy: &SlowEnergy, xi: f64) -> Option<[f64; 2]> {
        let xi = if self.saddles.is_empty() { xi.min(AXIS) } else { xi };
        let Traced { period, loss, turned, .. } = self.turn(energy, xi)?;
        let fall = energy.G * self.height(xi) / (1.0 + (-xi).exp());
        Some([fall * period / loss, fall * turned / (TAU * loss)])
    }

    /// Pieces that cover an interval, each short enough for its interpolation; none where a level is not closed.
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
        if halvings == 0 || fit.tail() < PIECE_TOLERANCE {
            pieces.push(Piece { ends, fit });
            return Some(());
        }
        let middle = 0.5 * (ends[0] + ends[1]);
        self.cover(energy, [ends[0], middle], halvings - 1, pieces)?;
        self.cover(energy, [middle, ends[1]], halvings - 1, pieces)
    }
}

impl Piece {
    /// Time (s) and revolutions from the start of the piece to a place in it.
    pub fn until(&self, xi: f64) -> [f64; 2] {
        self.fit.integral(xi)
    }
}
