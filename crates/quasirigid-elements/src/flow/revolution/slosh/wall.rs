//! Wall of a tank of revolution: pieces of its meridian from the lower pole to the upper one, with the moments of what it encloses.
//! The distance from the axis is a function of the height, so every level is one disc.
//! Equation (U4), docs/theory/21-slosh.md.

use std::f64::consts::PI;

use crate::math::quadrature::gauss_legendre;

/// Quadrature points along a piece.
const POINTS: usize = 32;
/// Halvings of an interval that leave its ends neighbours in floating point.
const HALVINGS: usize = 200;

/// A piece of the wall, upwards, as `[r, z]`: distance from the axis and height (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum WallPiece {
    /// A straight line.
    Line {
        /// Lower end.
        from: [f64; 2],
        /// Upper end.
        to: [f64; 2],
    },
    /// Part of an ellipse, `r = across sin ψ`, `z = center − along cos ψ`.
    Arc {
        /// Height of the centre (m).
        center: f64,
        /// Semi-axis across the axis (m).
        across: f64,
        /// Semi-axis along it (m).
        along: f64,
        /// Angles of the lower and the upper end (rad).
        angles: [f64; 2],
    },
}

/// A wall, piece after piece from the lowest to the highest point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wall {
    pub pieces: Vec<WallPiece>,
}

/// Moments of the space below a level, about the origin of the heights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moments {
    /// Volume (m³).
    pub volume: f64,
    /// `∫ z dV` (m⁴).
    pub first: f64,
    /// `∫ r² dV` (m⁵).
    pub axial: f64,
    /// `∫ z² dV` (m⁵).
    pub along: f64,
}

impl WallPiece {
    /// Place `[r, z]` at a parameter 0 to 1, and its slopes by the parameter.
    pub fn at(&self, u: f64) -> [[f64; 2]; 2] {
        match *self {
            Self::Line { from, to } => {
                let slope = [to[0] - from[0], to[1] - from[1]];
                [[from[0] + u * slope[0], from[1] + u * slope[1]], slope]
            }
            Self::Arc { center, across, along, angles: [start, end] } => {
                let (sin, cos) = (start + (end - start) * u).sin_cos();
                let turn = end - start;
                [[across * sin, center - along * cos], [across * cos * turn, along * sin * turn]]
            }
        }
    }

    /// The piece below a parameter.
    pub fn below(&self, u: f64) -> Self {
        match *self {
            Self::Line { from, .. } => Self::Line { from, to: self.at(u)[0] },
            Self::Arc { center, across, along, angles: [start, end] } => {
                Self::Arc { center, across, along, angles: [start, start + (end - start) * u] }
            }
        }
    }

    /// The piece upside down.
    fn flipped(&self) -> Self {
        let mirrored = |[r, z]: [f64; 2]| [r, -z];
        match *self {
            Self::Line { from, to } => Self::Line { from: mirrored(to), to: mirrored(from) },
            Self::Arc { center, across, along, angles: [start, end] } => {
                Self::Arc { center: -center, across, along, angles: [PI - end, PI - start] }
            }
        }
    }

    /// Moments of what is inside, from the lower end to a parameter.
    fn moments(&self, u: f64) -> Moments {
        let mut sum = Moments::default();
        for [x, weight] in gauss_legendre(POINTS) {
            let [[r, z], [_, rise]] = self.at(0.5 * u * (1.0 + x));
            let volume = PI * r * r * rise * 0.5 * u * weight;
            sum.add(&Moments {
                volume,
                first: volume * z,
                axial: 0.5 * volume * r * r,
                along: volume * z * z,
            });
        }
        sum
    }

    /// Length, and the greatest distance from the axis (m).
    pub fn size(&self) -> [f64; 2] {
        let points = gauss_legendre(POINTS).into_iter();
        points.fold([0.0, 0.0], |[length, most], [x, weight]| {
            let [[r, _], [out, rise]] = self.at(0.5 * (1.0 + x));
            [length + 0.5 * weight * out.hypot(rise), r.max(most)]
        })
    }
}

impl Moments {
    fn add(&mut self, other: &Self) {
        self.volume += other.volume;
        self.first += other.first;
        self.axial += other.axial;
        self.along += other.along;
    }
}

impl Wall {
    /// The wall upside down.
    pub fn flipped(&self) -> Self {
        Self { pieces: self.pieces.iter().rev().map(WallPiece::flipped).collect() }
    }

    /// Moments of the whole space.
    pub fn moments(&self) -> Moments {
        let mut sum = Moments::default();
        self.pieces.iter().for_each(|piece| sum.add(&piece.moments(1.0)));
        sum
    }

    /// The wall below the level at which it holds a volume (m³), between none and all of it.
    pub fn filled(&self, volume: f64) -> Self {
        let (mut pieces, mut left) = (Vec::new(), volume);
        for piece in &self.pieces {
            let whole = piece.moments(1.0).volume;
            if whole < left {
                left -= whole;
                pieces.push(*piece);
                continue;
            }
            let mut range = [0.0, 1.0];
            for _ in 0..HALVINGS {
                let middle = 0.5 * (range[0] + range[1]);
                range[usize::from(piece.moments(middle).volume > left)] = middle;
            }
            if range[1] > 0.0 {
                pieces.push(piece.below(range[1]));
            }
            break;
        }
        Self { pieces }
    }

    /// Lowest and highest place of the wall.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        let start = self.pieces.first().map_or([0.0; 2], |piece| piece.at(0.0)[0]);
        let end = self.pieces.last().map_or([0.0; 2], |piece| piece.at(1.0)[0]);
        [start, end]
    }
}
