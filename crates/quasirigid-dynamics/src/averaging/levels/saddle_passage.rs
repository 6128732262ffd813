//! Passage through the separatrix on level curves of the slow energy: the saddles, and the regions that meet at their energy.

use super::descent::Descent;
use super::energy::SlowEnergy;
use super::level::{Traced, traced};
use crate::math::sphere::{StationaryKind, StationaryPoint};
use crate::math::vec3::{add, norm, scale, unit};

/// Separatrix passed: the energy of saddles, where a level meets itself or its neighbours. (N6)
#[derive(Clone, Debug, PartialEq)]
pub struct Separatrix {
    /// Time (s) since the start.
    pub time: f64,
    /// Slow energy (J).
    pub energy: f64,
    /// Ways behind the separatrix. A fraction of a revolution decides which is taken.
    pub ways: Vec<Way>,
    /// True if the branches differ in nothing but their sense, so that the evolution goes on.
    pub alike: bool,
    /// Angular momentum of the steady spin circled behind it (N·m·s, body axes), where the evolution goes on.
    pub circled: Option<[f64; 3]>,
}

/// Way behind a separatrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Angular momentum (N·m·s, body axes) just below the separatrix, a start to follow the evolution from.
    pub angular_momentum: [f64; 3],
    /// Angular momentum (N·m·s, body axes) of the steady spin of least energy below it.
    pub attractor: [f64; 3],
    /// Share of the energy lost in a circuit of the levels next below: the probability of this way.
    pub share: f64,
}

/// Distance from the energy of a saddle, as a share of the range over the sphere, up to which levels are followed.
pub(super) const MARGIN: f64 = 1e-7;
/// Multiple of the distance at which a level turns before a saddle, within which the level counts as meeting the saddle.
const MET: f64 = 4.0;
/// Relative difference below which ways are alike.
const ALIKE: f64 = 1e-6;

/// Saddles of the slow energy, and the levels beside them.
pub(super) struct Saddles<'a> {
    energy: &'a SlowEnergy,
    points: &'a [StationaryPoint],
    /// Range of `h` over the sphere (1/s).
    range: f64,
}

impl<'a> Saddles<'a> {
    pub fn new(energy: &'a SlowEnergy, points: &'a [StationaryPoint], range: f64) -> Self {
        Self { energy, points, range }
    }

    /// Distance from a saddle's energy (1/s) up to which levels are followed.
    pub fn margin(&self) -> f64 {
        MARGIN * self.range
    }

    /// Saddles below a value of `h`, the highest first.
    pub fn below(&self, h: f64) -> Vec<(StationaryPoint, f64)> {
        let saddles = self.points.iter().filter(|point| point.kind == StationaryKind::Saddle);
        let mut below: Vec<_> = saddles.map(|point| (*point, self.energy.energy(point.place))).collect();
        below.retain(|(_, height)| *height < h);
        below.sort_by(|a, b| b.1.total_cmp(&a.1));
        below
    }

    /// Tells whether the level through a place, a margin above a saddle, meets the saddle.
    pub fn meets(&self, start: [f64; 3], saddle: &StationaryPoint) -> bool {
        let (mut nearest, limit) = (f64::INFINITY, MET * self.reach(saddle, true).0);
        let look = |u: [f64; 3]| nearest = nearest.min(norm(add(u, scale(-1.0, saddle.place))));
        traced(self.energy, start, saddle.place, look);
        nearest < limit
    }

    /// Distance (rad) at which a level a margin away turns before a saddle, and the direction of descent (or ascent).
    fn reach(&self, saddle: &StationaryPoint, ascent: bool) -> (f64, [f64; 3]) {
        let [[a, b], [c, d]] = saddle.slope;
        let mixed = 0.5 * (b + c);
        let (mean, half) = (0.5 * (a + d), 0.5 * (a - d));
        let root = half.hypot(mixed);
        let curvature = if ascent { mean + root } else { mean - root };
        let turn = 0.5 * mixed.atan2(half) + if ascent { 0.0 } else { std::f64::consts::FRAC_PI_2 };
        let (sin, cos) = turn.sin_cos();
        let direction = add(scale(cos, saddle.tangents[0]), scale(sin, saddle.tangents[1]));
        ((2.0 * self.margin() / curvature.abs()).sqrt(), direction)
    }

    /// Levels a margin below saddles of one energy: a place on each, and its circuit.
    pub fn next(&self, saddles: &[StationaryPoint]) -> Vec<([f64; 3], Traced)> {
        let sides = saddles.iter().flat_map(|saddle| {
            let (distance, direction) = self.reach(saddle, false);
            [1.0, -1.0].map(|side| (unit(add(saddle.place, scale(side * distance, direction))), distance))
        });
        let sides: Vec<_> = sides.collect();
        let mut known: Vec<([f64; 3], Traced)> = Vec::new();
        let mut taken = vec![false; sides.len()];
        for i in 0..sides.len() {
            if taken[i] {
                continue;
            }
            let mut look = |u: [f64; 3]| {
                for (taken, (place, distance)) in taken.iter_mut().zip(&sides) {
                    *taken |= norm(add(u, scale(-1.0, *place))) < 0.7 * distance;
                }
            };
            if let Some(turn) = traced(self.energy, sides[i].0, saddles[0].place, &mut look) {
                known.push((sides[i].0, turn));
            }
        }
        known
    }

    /// Public ways, and whether they are alike.
    pub fn ways(&self, next: &[([f64; 3], Traced)]) -> (Vec<Way>, bool) {
        let whole: f64 = next.iter().map(|(_, turn)| turn.loss).sum();
        let bottom = |place: [f64; 3]| {
            Descent::from(self.energy, self.points, place, 1.0).map_or(place, |(descent, _)| descent.end())
        };
        let way = |(place, turn): &([f64; 3], Traced)| Way {
            angular_momentum: scale(self.energy.G, *place),
            attractor: scale(self.energy.G, bottom(*place)),
            share: if whole > 0.0 { turn.loss / whole } else { 1.0 / next.len() as f64 },
        };
        let close = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs().max(b.abs());
        let alike = next.array_windows().all(|[(_, a), (_, b)]| {
            close(a.period, b.period) && close(a.loss, b.loss) && close(a.turned, b.turned)
        });
        (next.iter().map(way).collect(), alike)
    }
}
