//! Range of validity of the paths: displacements of places and angles of hinges that are watched. (K14)

use std::fmt;
use std::ops::Range;

use crate::math::vec3;

/// Watched places and hinges, whose displacements limit the validity of the second order of the paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Watched {
    /// Places on parts.
    pub reaches: Vec<Reach>,
    /// Hinges of appendages on which springs act at places: these take the displacement of the place to first order. (I9)
    pub hinges: Vec<Hinge>,
}

/// Watched place on a part, whose displacement limits the validity of the second order of the paths.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// Name.
    pub name: String,
    /// Distance from the attachment of the part (m).
    pub length: f64,
    /// Coordinates that displace the place, each with the displacement per unit.
    pub shapes: Vec<(usize, [f64; 3])>,
}

/// Place or hinge displaced beyond the range of the equations.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Displaced {
    /// Place on a part.
    Place {
        /// Index in [`Watched`].
        reach: usize,
        /// Displacement over the distance from the attachment of the part.
        share: f64,
    },
    /// Appendage on a hinge.
    Hinge {
        /// Index in [`Watched`].
        hinge: usize,
        /// Angle of the hinge (rad).
        angle: f64,
    },
}

/// Limit of the displacement of a place over its distance from the attachment of its part, for the second order of curved paths: the
/// third order, `(u/L)²` of the first, is a few per cent there. (K14)
pub const RANGE: f64 = 0.2;
/// Limit of the angle (rad) of a hinge on whose appendage springs act, which take the displacement of their place to first order. The
/// paths of the appendage itself have no limit. (K14), (I12)
pub const HINGE_RANGE: f64 = 0.3;

/// Watched hinge with its axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinge {
    /// Name of the appendage.
    pub name: String,
    /// Unit vectors of the axes, by coordinate.
    pub axes: Vec<(usize, [f64; 3])>,
}

impl Hinge {
    /// Angle (rad) of the rotation of the appendage at these coordinates.
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
                    "a hinge turned by {angle:.1} degrees, beyond the {range:.1} degrees to which the springs on its appendage hold"
                )
            }
        }
    }
}

impl Reach {
    /// Displacement over the distance from the attachment of the part. (K14)
    #[must_use]
    pub fn share(&self, q: &[f64]) -> f64 {
        let moved =
            |sum: [f64; 3], (j, shape): &(usize, [f64; 3])| vec3::add(sum, vec3::scale(q[*j], *shape));
        vec3::norm(self.shapes.iter().fold([0.0; 3], moved)) / self.length
    }
}

impl Watched {
    /// Place or hinge farthest beyond its range at these coordinates, hinges first; none within the range. (K14)
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

    /// Watched places and hinges in a body with these coordinates kept and the others locked.
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
