//! Meridian of the liquid under a free surface: horizontal lines from the axis to the wall, so that the surface is a side of the square.
//! Patches are thin at the contact line and in the corners of the wall, where the flow is singular.

use super::super::outline::{Meridian, Place, Side, graded};
use super::wall::Wall;

/// The liquid inside a wall that ends at the level.
pub(super) struct Pool<'a>(pub &'a Wall);

/// A lower end whose distance from the axis is within this share of the widest is a pole.
const POLE: f64 = 1e-12;
/// Depth of patches at an end, as a share of the narrowest width, above which the end is not graded; see [`graded`].
const UNGRADED: f64 = 0.101;
/// Depth of the flattest liquid over its width.
const FLATTEST: f64 = 1e-4;
/// Most that a side of the square is longer than the other when it is cut.
const LONGEST: f64 = 1e6;
/// Pieces of a wall up to which the joints between them are graded; the lines of a longer profile meet at small angles.
const GRADED_PIECES: usize = 6;
/// Change of direction at a joint of pieces (rad) from which the joint is a corner.
const CORNER: f64 = 1e-6;

impl Pool<'_> {
    /// Whether the lowest place of the liquid is a single one.
    fn is_pointed(&self) -> bool {
        let [[lowest, _], _] = self.0.ends();
        lowest <= POLE * self.width()
    }

    /// Whether width and depth are within a range of each other in which the places are distinct.
    pub fn is_resolved(&self) -> bool {
        let [[_, low], [radius, high]] = self.0.ends();
        let ratio = (high - low) / self.width();
        ratio > FLATTEST && ratio < FLATTEST.recip() && radius > POLE * self.width()
    }

    /// The greatest distance from the axis (m).
    fn width(&self) -> f64 {
        self.0.pieces.iter().map(|piece| piece.size()[1]).fold(0.0, f64::max)
    }

    /// Whether the wall has a corner before each piece and after the last.
    fn corners(&self) -> Vec<bool> {
        let direction = |[_, [out, rise]]: [[f64; 2]; 2]| out.atan2(rise);
        let joints = self.0.pieces.windows(2);
        let joints_graded = self.0.pieces.len() <= GRADED_PIECES;
        let turns = joints.map(|pair| {
            joints_graded && (direction(pair[0].at(1.0)) - direction(pair[1].at(0.0))).abs() > CORNER
        });
        std::iter::once(!self.is_pointed()).chain(turns).chain([true]).collect()
    }
}

impl Meridian for Pool<'_> {
    fn place(&self, [s, t]: [f64; 2]) -> Place {
        let pieces = &self.0.pieces;
        let count = pieces.len() as f64;
        let number = ((t * count) as usize).min(pieces.len() - 1);
        let [[r, z], [out, rise]] = pieces[number].at(t * count - number as f64);
        Place { at: [s * r, z], slopes: [[r, s * out * count], [0.0, rise * count]] }
    }

    fn sides(&self) -> [[Side; 2]; 2] {
        let bottom = if self.is_pointed() { Side::Point } else { Side::Wall };
        [[Side::Axis, Side::Wall], [bottom, Side::Surface]]
    }

    fn cuts(&self, layers: usize) -> [Vec<f64>; 2] {
        let (pieces, corners) = (&self.0.pieces, self.corners());
        let [[_, low], [_, high]] = self.0.ends();
        let whole = graded((2.0 * self.width() / (high - low)).min(LONGEST), layers);
        let half: Vec<f64> = whole.into_iter().map(|cut| 2.0 * cut - 1.0).filter(|cut| *cut > 0.0).collect();
        let mut upwards = vec![0.0];
        for (number, piece) in pieces.iter().enumerate() {
            let [length, width] = piece.size();
            let ratio = (0.5 * length / width).min(LONGEST);
            let least = UNGRADED / ratio.max(1.0);
            let keeps =
                |cut: &f64| (corners[number] || *cut > least) && (corners[number + 1] || 1.0 - cut > least);
            let inner =
                graded(ratio, layers).into_iter().filter(|cut| *cut > 0.0 && *cut < 1.0 && keeps(cut));
            let end = std::iter::once(1.0);
            upwards.extend(inner.chain(end).map(|cut| (number as f64 + cut) / pieces.len() as f64));
        }
        [[vec![0.0], half].concat(), upwards]
    }
}
