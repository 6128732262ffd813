//! How far the displacements of a body may go before its paths no longer hold.

use std::fmt;
use std::ops::Range;

use crate::math::vec3;

/// Places and hinges whose displacements say how far the second order of the paths holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Watched {
    /// Places on parts.
    pub reaches: Vec<Reach>,
    /// Hinges of appendages.
    pub hinges: Vec<Hinge>,
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
        let turned = |sum: [f64; 3], (j, axis): &(usize, [f64; 3])| vec3::add(sum, vec3::scale(q[*j], *axis));
        vec3::norm(self.axes.iter().fold([0.0; 3], turned))
    }
}

impl fmt::Display for Displaced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place { share, .. } => {
                let [share, range] = [*share, RANGE].map(|share| 100.0 * share);
                write!(
                    f,
                    "a part was displaced by {share:.1} % of its length, beyond the {range} % to which its paths hold"
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
        let moved =
            |sum: [f64; 3], (j, shape): &(usize, [f64; 3])| vec3::add(sum, vec3::scale(q[*j], *shape));
        vec3::norm(self.shapes.iter().fold([0.0; 3], moved)) / self.length
    }
}

impl Watched {
    /// What has left its range the farthest at these coordinates, hinges first; none if nothing has. (K14)
    #[must_use]
    pub fn left(&self, q: &[f64]) -> Option<Displaced> {
        let farthest = |sizes: &mut dyn Iterator<Item = f64>, range: f64| {
            let beyond = sizes.enumerate().filter(|(_, size)| *size > range);
            beyond.max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let turned = farthest(&mut self.hinges.iter().map(|hinge| hinge.angle(q)), HINGE_RANGE);
        let moved = || farthest(&mut self.reaches.iter().map(|reach| reach.share(q)), RANGE);
        match turned {
            Some((hinge, angle)) => Some(Displaced::Hinge { hinge, angle }),
            None => moved().map(|(reach, share)| Displaced::Place { reach, share }),
        }
    }

    /// The same in a body that keeps these coordinates and locks the others.
    pub(super) fn locked(&self, kept: &Range<usize>) -> Self {
        let moved = |shapes: &[(usize, [f64; 3])]| {
            let inside = shapes.iter().filter(|(j, _)| kept.contains(j));
            inside.map(|(j, shape)| (j - kept.start, *shape)).collect()
        };
        let reaches =
            self.reaches.iter().map(|reach| Reach { shapes: moved(&reach.shapes), ..reach.clone() });
        let hinges = self.hinges.iter().map(|hinge| Hinge { axes: moved(&hinge.axes), ..hinge.clone() });
        Self { reaches: reaches.collect(), hinges: hinges.collect() }
    }
}
