//! Outlines of cavities of revolution: maps from a square to the meridian, and its cuts into patches.
//! Patches are thin along walls and grow with the distance from the ends: corners and boundary layers are there, and nothing else is sharp.
//! Shapes of (L10), docs/theory/13-inside.md.

use std::f64::consts::PI;

/// Meridian of a cavity of revolution about z: the image of a square of parameters `s` and `t`, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outline {
    /// A circular cylinder.
    Cylinder {
        /// Radius (m).
        radius: f64,
        /// Height (m).
        height: f64,
    },
    /// A space between two circular cylinders.
    Annulus {
        /// Radii of the inner and the outer one (m).
        radii: [f64; 2],
        /// Height (m).
        height: f64,
    },
    /// A round tube bent to a ring.
    Ring {
        /// Radius of the middle of the tube (m).
        radius: f64,
        /// Radius of the tube (m).
        tube_radius: f64,
    },
    /// An ellipsoid of revolution.
    Spheroid {
        /// Semi-axis across the axis (m).
        across: f64,
        /// Semi-axis along the axis (m).
        along: f64,
    },
    /// A space between two ellipsoids of revolution.
    Shell {
        /// Semi-axes of the inner and the outer one across the axis (m).
        across: [f64; 2],
        /// Semi-axes along the axis (m).
        along: [f64; 2],
    },
}

/// A meridian as the image of a square of parameters `s` and `t`, 0 to 1.
pub(super) trait Meridian {
    /// Place of a point of the square.
    fn place(&self, at: [f64; 2]) -> Place;

    /// The sides where `s` is 0 and 1, then those where `t` is.
    fn sides(&self) -> [[Side; 2]; 2];

    /// Lines of `s`, then of `t`, that cut the square into patches, with 0 and 1; `layers` (at least 1) along each wall.
    fn cuts(&self, layers: usize) -> [Vec<f64>; 2];
}

/// Role of a side of the square in the meridian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// A wall.
    Wall,
    /// A free surface.
    Surface,
    /// Part of the axis of revolution.
    Axis,
    /// A line that coincides with the opposite side.
    Seam,
    /// A single place.
    Point,
}

/// A place of the meridian.
pub(super) struct Place {
    /// Distance from the axis, and height (m).
    pub at: [f64; 2],
    /// `∂(r, z)/∂(s, t)` (m).
    pub slopes: [[f64; 2]; 2],
}

/// Depth of the patches along walls, as a share of the narrowest width, and of each further layer: corners and boundary layers need
/// them.
const LAYER: f64 = 0.1;
/// Factor by which patches grow with their distance from the ends of a long meridian.
const GROWTH: f64 = 3.0;
/// Patches round a closed curve, or from pole to pole.
const ROUND: usize = 4;

impl Meridian for Outline {
    fn place(&self, [s, t]: [f64; 2]) -> Place {
        match *self {
            Self::Cylinder { radius, height } => straight([0.0, radius], height, [s, t]),
            Self::Annulus { radii, height } => straight(radii, height, [s, t]),
            Self::Ring { radius, tube_radius } => {
                let (sin, cos) = (2.0 * PI * t).sin_cos();
                Place {
                    at: [radius + tube_radius * s * cos, tube_radius * s * sin],
                    slopes: [
                        [tube_radius * cos, -2.0 * PI * tube_radius * s * sin],
                        [tube_radius * sin, 2.0 * PI * tube_radius * s * cos],
                    ],
                }
            }
            Self::Spheroid { across, along } => round([0.0, across], [0.0, along], [s, t]),
            Self::Shell { across, along } => round(across, along, [s, t]),
        }
    }

    fn sides(&self) -> [[Side; 2]; 2] {
        match self {
            Self::Cylinder { .. } => [[Side::Axis, Side::Wall], [Side::Wall; 2]],
            Self::Annulus { .. } => [[Side::Wall; 2]; 2],
            Self::Ring { .. } => [[Side::Point, Side::Wall], [Side::Seam; 2]],
            Self::Spheroid { .. } => [[Side::Point, Side::Wall], [Side::Axis; 2]],
            Self::Shell { .. } => [[Side::Wall; 2], [Side::Axis; 2]],
        }
    }

    fn cuts(&self, layers: usize) -> [Vec<f64>; 2] {
        let even = || (0..=ROUND).map(|cut| cut as f64 / ROUND as f64).collect();
        match *self {
            // The axis is the middle of a cylinder: the half beyond it is the mirror image.
            Self::Cylinder { radius, height } => {
                let whole = graded(2.0 * radius / height, layers).into_iter().map(|cut| 2.0 * cut - 1.0);
                let half: Vec<f64> = whole.filter(|cut| *cut > 0.0).collect();
                [[vec![0.0], half].concat(), graded(height / (2.0 * radius), layers)]
            }
            Self::Annulus { radii: [inner, outer], height } => {
                let width = outer - inner;
                [graded(width / height, layers), graded(height / width, layers)]
            }
            Self::Ring { .. } | Self::Spheroid { .. } => {
                let mut outer: Vec<f64> = depths(layers).map(|depth| 1.0 - 2.0 * depth).collect();
                outer.reverse();
                [[vec![0.0], outer, vec![1.0]].concat(), even()]
            }
            Self::Shell { .. } => [graded(1.0, layers), even()],
        }
    }
}

fn straight([inner, outer]: [f64; 2], height: f64, [s, t]: [f64; 2]) -> Place {
    let width = outer - inner;
    Place { at: [inner + width * s, height * (t - 0.5)], slopes: [[width, 0.0], [0.0, height]] }
}

fn round(across: [f64; 2], along: [f64; 2], [s, t]: [f64; 2]) -> Place {
    let (sin, cos) = (PI * t).sin_cos();
    let [r, z] = [across, along].map(|[inner, outer]| inner + (outer - inner) * s);
    Place {
        at: [r * sin, z * cos],
        slopes: [[(across[1] - across[0]) * sin, PI * r * cos], [(along[1] - along[0]) * cos, -PI * z * sin]],
    }
}

/// Depths of the patches along a wall as shares of the narrowest width, ascending.
fn depths(layers: usize) -> impl Iterator<Item = f64> {
    (1..=layers as i32).rev().map(|layer| LAYER.powi(layer))
}

/// Cuts of a side that is so many times as long as the other. Beyond the layers at its ends the flow changes within the other's
/// length of them only.
pub(super) fn graded(ratio: f64, layers: usize) -> Vec<f64> {
    let width = 1.0 / ratio.max(1.0);
    let mut ends: Vec<f64> = depths(layers).map(|depth| depth * width).collect();
    let (mut reach, mut step) = (LAYER * width, width);
    while reach + step < 0.5 {
        reach += step;
        step *= GROWTH;
        ends.push(reach);
    }
    let far: Vec<f64> = ends.iter().rev().map(|cut| 1.0 - cut).collect();
    [vec![0.0], ends, far, vec![1.0]].concat()
}
