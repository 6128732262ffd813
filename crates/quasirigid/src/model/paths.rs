use std::fmt;
use std::ops::Range;

use super::{Invariants, Pair};
use crate::math::sparse::SparseRows;
use crate::math::sym;

/// Curved paths point by point, for the full equations: `r = H_j q_j + Ψ_e y_e` with `y_e = ½ qᵀΓ^e q`. (K12)
///
/// A body of more coordinates on straight paths, the last of which follow the others.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvedPaths {
    /// Invariants of the body on straight paths: its own coordinates, then the fields `Ψ_e`.
    pub straight: Invariants,
    /// Coordinates that the fields follow.
    pub coordinates: Range<usize>,
    /// `Γ^e` over those coordinates, symmetric, row by row.
    pub forms: Vec<Vec<f64>>,
    /// Places on the parts, by which their displacement is measured.
    pub reaches: Vec<Reach>,
}

/// A place on a part whose displacement says how far the second order of the paths holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// What it is.
    pub name: String,
    /// Its distance from where the part is held (m).
    pub length: f64,
    /// Coordinates that move it, with the displacement per unit of each.
    pub shapes: Vec<(usize, [f64; 3])>,
}

/// What has left the range in which the equations hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Displaced {
    /// A place on a part.
    Place {
        /// Its number.
        reach: usize,
        /// Its displacement over its distance from where the part is held.
        share: f64,
    },
    /// An appendage on a hinge.
    Hinge {
        /// Its number.
        hinge: usize,
        /// Angle by which it turned (rad).
        angle: f64,
    },
}

/// Displacement of a place over its distance from where its part is held up to which the second order of curved paths is taken for
/// the whole: the third, `(u/L)²` of the first, is a few per cent there. (K14)
pub const RANGE: f64 = 0.2;
/// Angle (rad) of a hinge up to which the second order of its paths is taken for the whole: the third is a few per cent of what the
/// turn changes there. (K14)
pub const HINGE_RANGE: f64 = 0.3;

/// A hinge with its angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinge {
    /// Name of the appendage.
    pub name: String,
    /// Unit vectors of the axes, by coordinate.
    pub axes: Vec<(usize, [f64; 3])>,
}

impl Hinge {
    /// Angle (rad) by which the appendage has turned, from the coordinates.
    #[must_use]
    pub fn angle(&self, q: &[f64]) -> f64 {
        let turned = |sum: [f64; 3], (j, axis): &(usize, [f64; 3])| sym::add(sum, sym::scale(q[*j], *axis));
        sym::norm(self.axes.iter().fold([0.0; 3], turned))
    }
}

impl fmt::Display for Displaced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place { share, .. } => {
                let [share, range] = [*share, RANGE].map(|share| 100.0 * share);
                write!(
                    f,
                    "a beam was displaced by {share:.1} % of its length, beyond the {range} % to which its curved paths hold"
                )
            }
            Self::Hinge { angle, .. } => {
                let [angle, range] = [*angle, HINGE_RANGE].map(f64::to_degrees);
                write!(
                    f,
                    "a hinge turned by {angle:.1} degrees, beyond the {range:.1} degrees to which its paths hold"
                )
            }
        }
    }
}

impl Reach {
    /// Displacement over the distance from where the part is held. (K14)
    #[must_use]
    pub fn share(&self, q: &[f64]) -> f64 {
        let moved = |sum: [f64; 3], (j, shape): &(usize, [f64; 3])| sym::add(sum, sym::scale(q[*j], *shape));
        sym::norm(self.shapes.iter().fold([0.0; 3], moved)) / self.length
    }
}

impl CurvedPaths {
    /// The place that is displaced the most, if that is beyond the range. (K14)
    #[must_use]
    pub fn left(&self, q: &[f64]) -> Option<Displaced> {
        let shares = self.reaches.iter().map(|reach| reach.share(q)).enumerate();
        let shares = shares.filter(|(_, share)| *share > RANGE);
        let farthest = shares.max_by(|a, b| a.1.total_cmp(&b.1));
        farthest.map(|(reach, share)| Displaced::Place { reach, share })
    }

    /// Number of fields.
    #[must_use]
    pub fn fields(&self) -> usize {
        self.forms.len()
    }

    /// The same in a body that keeps these coordinates of `all` and locks the others; none if it locks those of the paths.
    pub(super) fn locked(&self, all: usize, kept: &Range<usize>) -> Option<Self> {
        let Range { start, end } = self.coordinates;
        if !(kept.start <= start && end <= kept.end) {
            return None;
        }
        let places: Vec<usize> = kept.clone().chain(all..all + self.fields()).collect();
        let place = |j: usize| places.iter().position(|place| *place == j);
        let Invariants { mass, J, S, h, J1, pairs } = &self.straight;
        let pairs: Vec<(usize, usize, Pair)> =
            pairs.iter().filter_map(|(j, k, pair)| Some((place(j)?, place(k)?, *pair))).collect();
        let straight = Invariants {
            mass: *mass,
            J: *J,
            S: places.iter().map(|j| S[*j]).collect(),
            h: places.iter().map(|j| h[*j]).collect(),
            J1: places.iter().map(|j| J1[*j]).collect(),
            pairs: SparseRows::sum(places.len(), pairs),
        };
        let coordinates = start - kept.start..end - kept.start;
        let moved = |(j, shape): &(usize, [f64; 3])| Some((place(*j)?, *shape));
        let kept = |reach: &Reach| Reach {
            shapes: reach.shapes.iter().filter_map(moved).collect(),
            ..reach.clone()
        };
        let reaches = self.reaches.iter().map(kept).collect();
        Some(Self { straight, coordinates, forms: self.forms.clone(), reaches })
    }
}
