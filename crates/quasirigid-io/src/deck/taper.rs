//! Tapered beams as pieces, each of the section in its middle, with the mass, centre of mass and inertia of the taper.
//! Equation (K22), docs/theory/12-structures.md.

use super::properties::{Bending, Station};

/// Least number of pieces of a tapered beam, and of each of its tapered intervals.
const PIECES: [usize; 2] = [4, 2];

/// A piece of a beam.
pub(crate) struct Piece {
    /// Share of the beam's length where it ends.
    pub end: f64,
    /// Section in its middle.
    pub section: Station,
    /// Area and extra mass per length that give its mass.
    pub heavy: [f64; 2],
}

impl Station {
    /// The section at a share of the way to another one.
    fn between(&self, other: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| (1.0 - share) * a + share * b;
        Self {
            at: mix(self.at, other.at),
            area: mix(self.area, other.area),
            moments: [0, 1, 2].map(|k| mix(self.moments[k], other.moments[k])),
            torsion: mix(self.torsion, other.torsion),
            extra: mix(self.extra, other.extra),
        }
    }

    fn is_like(&self, other: &Self) -> bool {
        Self { at: other.at, ..*self } == *other
    }

    fn bends(&self) -> bool {
        self.moments[0].max(self.moments[1]).max(self.torsion) > 0.0
    }
}

impl Bending {
    /// The section at a share of the length.
    pub fn at(&self, share: f64) -> Station {
        let after = self.stations.partition_point(|station| station.at < share);
        match (self.stations.get(after.saturating_sub(1)), self.stations.get(after)) {
            (Some(a), Some(b)) if b.at > a.at => a.between(b, (share - a.at) / (b.at - a.at)),
            (Some(a), _) => Station { at: share, ..*a },
            (None, _) => Station::default(),
        }
    }

    /// Pieces from the first end to the second: one of a uniform beam, or of one without moments, whose pieces would fold.
    pub fn pieces(&self) -> Vec<Piece> {
        let ends: Vec<f64> = self.stations.iter().skip(1).map(|station| station.at).chain([1.0]).collect();
        let mut bounds = vec![0.0];
        bounds.extend(ends.into_iter().filter(|end| *end > 0.0));
        bounds.dedup();
        let intervals: Vec<[Station; 2]> =
            bounds.windows(2).map(|pair| [self.at(pair[0]), self.at(pair[1])]).collect();
        let tapered = intervals.iter().filter(|[a, b]| !a.is_like(b)).count();
        let folds = !intervals.iter().all(|[a, b]| a.between(b, 0.5).bends());
        if tapered == 0 || folds {
            return vec![self.whole(&intervals)];
        }
        let [most, least] = PIECES;
        let each = most.div_ceil(tapered).max(least);
        let mut pieces = Vec::new();
        for [a, b] in &intervals {
            let count = if a.is_like(b) { 1 } else { each };
            // (K22)
            let wider = if count == 1 { 1.0 } else { (count * count) as f64 / (count * count - 1) as f64 };
            for piece in 0..count {
                let middle = (piece as f64 + 0.5) / count as f64;
                let heavy = a.between(b, 0.5 + wider * (middle - 0.5));
                pieces.push(Piece {
                    end: a.at + (b.at - a.at) * (piece + 1) as f64 / count as f64,
                    section: a.between(b, middle),
                    heavy: [heavy.area, heavy.extra],
                });
            }
        }
        pieces
    }

    /// One piece of the mean section.
    fn whole(&self, intervals: &[[Station; 2]]) -> Piece {
        let mean = |of: &dyn Fn(&Station) -> f64| -> f64 {
            intervals.iter().map(|[a, b]| 0.5 * (b.at - a.at) * (of(a) + of(b))).sum()
        };
        let section = Station {
            at: 0.5,
            area: mean(&|station| station.area),
            moments: [0, 1, 2].map(|k| mean(&|station| station.moments[k])),
            torsion: mean(&|station| station.torsion),
            extra: mean(&|station| station.extra),
        };
        Piece { end: 1.0, section, heavy: [section.area, section.extra] }
    }
}
