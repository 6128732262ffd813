//! Range of validity of the paths: displacements of places and angles of hinges that are watched. (K14)

use std::fmt;
use std::ops::Range;

use super::gimbal::Gimbal;
use crate::math::vec3;

/// Watched places and hinges, whose displacements limit the validity of the second order of the paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Watched {
    /// Places on parts.
    pub reaches: Vec<Reach>,
    /// Hinges of appendages on which springs act at places: these take the displacement of the place to first order. (I9)
    pub hinges: Vec<Hinge>,
    /// Hinges of three axes, which lock where these come into one plane. (I14)
    pub gimbals: Vec<Hinge>,
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
    /// Hinge of three axes next to its gimbal lock.
    Gimbal {
        /// Index in [`Watched`].
        gimbal: usize,
        /// Volume that the axes span, over that at rest: zero in one plane.
        volume: f64,
    },
}

/// Limit of the displacement of a place over its distance from the attachment of its part, for the second order of curved paths: the
/// third order, `(u/L)²` of the first, is a few per cent there. (K14)
pub const RANGE: f64 = 0.2;
/// Limit of the angle (rad) of a hinge on whose appendage springs act, which take the displacement of their place to first order. The
/// paths of the appendage itself have no limit. (K14), (I12)
pub const HINGE_RANGE: f64 = 0.3;
/// Volume spanned by the three axes of a hinge, over that at rest, below which its angles no longer follow a rotation. (I14)
pub const GIMBAL_LOCK: f64 = 2e-3;

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

    /// Volume spanned by three axes as the appendage turns the inner ones, over that at rest; none of fewer axes. (I14)
    #[must_use]
    pub fn volume(&self, q: &[f64]) -> Option<f64> {
        let [(_, outer), (j, middle), (_, inner)] = *self.axes.as_slice() else { return None };
        let turned = Gimbal { axes: vec![(j, middle)] }.turned(q, inner);
        let [now, at_rest] = [turned, inner].map(|inner| vec3::dot(outer, vec3::cross(middle, inner)));
        Some((now / at_rest).abs())
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
            Self::Gimbal { .. } => f.write_str(
                "the three axes of a hinge came into one plane (gimbal lock), where its angles end",
            ),
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
    /// Hinge in its gimbal lock, or place or hinge farthest beyond its range at these coordinates, hinges first; none within the range. (K14), (I14)
    #[must_use]
    pub fn left(&self, q: &[f64]) -> Option<Displaced> {
        let locked = |(gimbal, hinge): (usize, &Hinge)| {
            let volume = hinge.volume(q).filter(|volume| *volume < GIMBAL_LOCK)?;
            Some(Displaced::Gimbal { gimbal, volume })
        };
        if let Some(locked) = self.gimbals.iter().enumerate().find_map(locked) {
            return Some(locked);
        }
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
        let kept = |hinges: &[Hinge]| {
            hinges.iter().map(|hinge| Hinge { axes: moved(&hinge.axes), ..hinge.clone() }).collect()
        };
        Self { reaches: reaches.collect(), hinges: kept(&self.hinges), gimbals: kept(&self.gimbals) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::{cross, dot, unit};

    /// The volume is that of the axes as they stand, each turned by those before it; a quarter turn of the middle one locks axes across each other.
    #[test]
    fn volume_of_three_axes_is_that_of_the_turned_ones() {
        let axes: Vec<(usize, [f64; 3])> =
            vec![(1, unit([1.0, 0.2, -0.4])), (2, unit([-0.3, 1.0, 0.1])), (3, unit([0.5, 0.6, 1.0]))];
        let q = [9.0, 0.7, -1.1, 2.3];
        let turned = |count: usize| {
            let before = Gimbal { axes: axes[..count].to_vec() };
            before.turned(&q, axes[count].1)
        };
        let at_rest = dot(axes[0].1, cross(axes[1].1, axes[2].1));
        let expected = (dot(turned(0), cross(turned(1), turned(2))) / at_rest).abs();
        let hinge = Hinge { name: "flap".into(), axes: axes.clone() };
        assert!((hinge.volume(&q).unwrap() / expected - 1.0).abs() < 1e-14);
        assert_eq!(Hinge { axes: axes[..2].to_vec(), ..hinge }.volume(&q), None);
        let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let across = Hinge { name: "flap".into(), axes: units.into_iter().enumerate().collect() };
        let watched = Watched { gimbals: vec![across], ..Watched::default() };
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_eq!(watched.left(&[3.0, quarter - 0.003, -2.0]), None);
        assert!(matches!(
            watched.left(&[3.0, 0.001 - quarter, -2.0]),
            Some(Displaced::Gimbal { gimbal: 0, .. })
        ));
    }
}
