use std::f64::consts::{FRAC_PI_2, PI};

use super::TankError;
use crate::error::{Field, Problem};
use crate::flow::revolution::{Wall, WallPiece};
use crate::number;

/// Wall of a tank of revolution about its axis.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum TankShape {
    /// Ellipsoid with its semi-axes (m), the third along the axis; the first two are equal.
    Ellipsoid {
        /// Semi-axes (m).
        semi_axes: [f64; 3],
    },
    /// Circular cylinder.
    Cylinder {
        /// Radius (m).
        radius: f64,
        /// Height (m).
        height: f64,
    },
    /// Circular cylinder with half a ball at each end.
    Capsule {
        /// Radius (m).
        radius: f64,
        /// Height from end to end (m).
        height: f64,
    },
    /// Circular cone or frustum with flat ends.
    Cone {
        /// Radii of the ends (m), the second farther along the axis; one may be zero.
        radii: [f64; 2],
        /// Height (m).
        height: f64,
    },
    /// Straight lines between points: distance from the axis, and height along it from the centre (m), from end to end.
    Profile {
        /// The points; heights ascend, but for flat ends.
        points: Vec<[f64; 2]>,
    },
}

/// Key of a profile.
const PROFILE: Field = Field::new("profile");
/// Most points of a profile.
const MOST_POINTS: usize = 60;
/// Relative difference of semi-axes that is rounding.
const SAME: f64 = 1e-12;

impl TankShape {
    /// Whether every direction through the centre is an axis of revolution.
    pub(super) fn is_sphere(&self) -> bool {
        let Self::Ellipsoid { semi_axes: [a, _, c] } = *self else { return false };
        (a - c).abs() <= SAME * a
    }

    /// The wall, with heights along the axis from the centre.
    pub(super) fn wall(&self) -> Result<Wall, (Field, Problem)> {
        let positive = |field: Field, value: f64| number::positive(value).map_err(|problem| (field, problem));
        let pieces = match *self {
            Self::Ellipsoid { semi_axes } => {
                semi_axes.iter().try_for_each(|value| positive(Field::SEMI_AXES, *value))?;
                let [first, second, along] = semi_axes;
                if (first - second).abs() > SAME * first {
                    return Err((Field::SEMI_AXES, TankError::NotOfRevolution { first, second }.into()));
                }
                vec![WallPiece::Arc { center: 0.0, across: first, along, angles: [0.0, PI] }]
            }
            Self::Cylinder { radius, height } => {
                positive(Field::RADIUS, radius)?;
                positive(Field::HEIGHT, height)?;
                vec![WallPiece::Line { from: [radius, -0.5 * height], to: [radius, 0.5 * height] }]
            }
            Self::Capsule { radius, height } => {
                positive(Field::RADIUS, radius)?;
                positive(Field::HEIGHT, height)?;
                let half = 0.5 * height - radius;
                if !(half > 0.0) {
                    return Err((Field::HEIGHT, TankError::ShortCapsule { radius, height }.into()));
                }
                let end =
                    |center: f64, angles| WallPiece::Arc { center, across: radius, along: radius, angles };
                vec![
                    end(-half, [0.0, FRAC_PI_2]),
                    WallPiece::Line { from: [radius, -half], to: [radius, half] },
                    end(half, [FRAC_PI_2, PI]),
                ]
            }
            Self::Cone { radii, height } => {
                positive(Field::HEIGHT, height)?;
                number::finite(&radii).map_err(|problem| (Field::RADII, problem))?;
                if let Some(value) = radii.into_iter().find(|radius| *radius < 0.0) {
                    return Err((Field::RADII, Problem::NotPositive { value }));
                }
                if radii == [0.0; 2] {
                    return Err((Field::RADII, TankError::NoCone.into()));
                }
                vec![WallPiece::Line { from: [radii[0], -0.5 * height], to: [radii[1], 0.5 * height] }]
            }
            Self::Profile { ref points } => lines(points).map_err(|problem| (PROFILE, problem))?,
        };
        Ok(Wall { pieces })
    }
}

/// Lines between the points of a profile, flat ends left out.
fn lines(points: &[[f64; 2]]) -> Result<Vec<WallPiece>, Problem> {
    if !(3..=MOST_POINTS).contains(&points.len()) {
        return Err(TankError::ProfilePoints { points: points.len(), most: MOST_POINTS }.into());
    }
    number::finite(points.as_flattened())?;
    let last = points.len() - 1;
    for (number, [radius, _]) in points.iter().enumerate() {
        let point = number + 1;
        if [0, last].contains(&number) {
            if *radius != 0.0 {
                return Err(TankError::OpenProfile { point, radius: *radius }.into());
            }
        } else if !(*radius > 0.0) {
            return Err(TankError::ProfileOnAxis { point, radius: *radius }.into());
        }
    }
    let mut pieces = Vec::new();
    for (number, ends) in points.windows(2).enumerate() {
        let [[_, low], [_, high]] = [ends[0], ends[1]];
        let flat = low == high && (number == 0 || number + 1 == last);
        if low > high || low == high && !flat {
            return Err(TankError::FoldedProfile { point: number + 2 }.into());
        }
        if !flat {
            pieces.push(WallPiece::Line { from: ends[0], to: ends[1] });
        }
    }
    if pieces.is_empty() {
        return Err(TankError::FoldedProfile { point: 2 }.into());
    }
    Ok(pieces)
}
