//! Shapes of cavities: their volumes and moments, their meshes or meridians, and responses known at every frequency.
//! Which methods apply (exact flows, a meridian, cells) follows from the shape alone, so a new shape needs a line in each match here.
//! Equations (C11), (L10), (L15) and (L20), docs/theory/13-inside.md.

use std::borrow::Cow;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

use nalgebra::{Matrix3, Vector3};

use crate::error::{Field, Problem};
use crate::flow::revolution::Outline;
use crate::flow::stokes::Moments;
use crate::model::LiquidFlow;
use crate::number;
use quasirigid_mesh::Mesh;
use quasirigid_mesh::meshing::{self, MeshingError};

/// Shape of a cavity, about its middle, in axes of its own.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum CavityShape {
    /// An ellipsoid; a ball if all semi-axes are the same. Its flows are exact.
    Ellipsoid {
        /// Semi-axes along x, y, z (m).
        semi_axes: [f64; 3],
    },
    /// A circular cylinder along z.
    Cylinder {
        /// Radius (m).
        radius: f64,
        /// Height (m).
        height: f64,
    },
    /// A space between two circular cylinders along z.
    Annulus {
        /// Radii of the inner and the outer one (m).
        radii: [f64; 2],
        /// Height (m).
        height: f64,
    },
    /// A round tube bent to a ring about z.
    Ring {
        /// Radius of the middle of the tube (m).
        radius: f64,
        /// Radius of the tube (m).
        tube_radius: f64,
    },
    /// A box.
    Cuboid {
        /// Sides along x, y, z (m).
        sides: [f64; 3],
    },
    /// A space between two ellipsoids.
    Shell {
        /// Semi-axes of the outer one along x, y, z (m).
        outer: [f64; 3],
        /// Semi-axes of the inner one (m).
        inner: [f64; 3],
    },
    /// A space filled by tetrahedra; places from the middle of the shape (m).
    Mesh(Box<Mesh>),
}

/// Liquid whose response about some of the axes is known at every frequency.
pub(super) struct SpinningLiquid {
    /// Kind of flow, in axes of the shape.
    pub flow: LiquidFlow,
    /// Distance from the wall to the middle of the flow, in a spheroid on its equator (m).
    pub radius: f64,
    /// Moment of inertia of the liquid, of unit density, in a spheroid or a cylinder about its axis (m⁵).
    pub inertia: f64,
    /// Numbers of the axes.
    pub axes: Vec<usize>,
}

/// The radius of the tube of a slender ring is at most this share of that of the ring.
pub(super) const SLENDER: f64 = 0.1;

/// Squares of the ratio of the semi-axes of a spheroid between which its spinning flows are known.
const STRETCHES: RangeInclusive<f64> = 0.04..=25.0;

/// Half the height of a cylinder over its radius between which its spinning flows are known.
const HALVES: RangeInclusive<f64> = 0.25..=4.0;

/// Volume of a shape and its second moments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Volume (m³).
    pub volume: f64,
    /// Centre of volume (m).
    pub center: Vector3<f64>,
    /// `∫ r rᵀ dV` from the centre of volume (m⁵).
    pub second: Matrix3<f64>,
}

impl CavityShape {
    /// Accepts lengths that are positive, inner ones less than the outer.
    pub(super) fn check(&self) -> Result<(), (Field, Problem)> {
        let lengths = match self {
            Self::Ellipsoid { semi_axes } => vec![(Field::SEMI_AXES, semi_axes.to_vec())],
            Self::Cylinder { radius, height } => {
                vec![(Field::RADIUS, vec![*radius]), (Field::HEIGHT, vec![*height])]
            }
            Self::Annulus { radii, height } => {
                vec![(Field::RADII, radii.to_vec()), (Field::HEIGHT, vec![*height])]
            }
            Self::Ring { radius, tube_radius } => {
                vec![(Field::RADIUS, vec![*radius]), (Field::TUBE_RADIUS, vec![*tube_radius])]
            }
            Self::Cuboid { sides } => vec![(Field::SIDES, sides.to_vec())],
            Self::Shell { outer, inner } => {
                vec![(Field::SEMI_AXES, outer.to_vec()), (Field::INNER_SEMI_AXES, inner.to_vec())]
            }
            Self::Mesh(_) => Vec::new(),
        };
        for (field, values) in lengths {
            values
                .iter()
                .try_for_each(|value| number::positive(*value))
                .map_err(|problem| (field, problem))?;
        }
        let pairs = match *self {
            Self::Annulus { radii, .. } => vec![radii],
            Self::Ring { radius, tube_radius } => vec![[tube_radius, radius]],
            Self::Shell { outer, inner } => [0, 1, 2].map(|axis| [inner[axis], outer[axis]]).to_vec(),
            _ => Vec::new(),
        };
        match pairs.into_iter().find(|[inner, outer]| !(inner < outer)) {
            Some([inner, outer]) => Err((Field::SHAPE, MeshingError::NotWithin { inner, outer }.into())),
            None => Ok(()),
        }
    }

    /// Whether the flows in this shape are known exactly.
    pub(super) fn is_known(&self) -> bool {
        match self {
            Self::Ellipsoid { .. } => true,
            Self::Ring { radius, tube_radius } => *tube_radius <= SLENDER * radius,
            _ => false,
        }
    }

    /// Meridian and number of the axis of a cavity of revolution.
    pub(super) fn revolution(&self) -> Option<(Outline, usize)> {
        match *self {
            Self::Ellipsoid { semi_axes } => {
                let [axis, across] = round_about(&[semi_axes])?;
                Some((Outline::Spheroid { across: semi_axes[across], along: semi_axes[axis] }, axis))
            }
            Self::Cylinder { radius, height } => Some((Outline::Cylinder { radius, height }, 2)),
            Self::Annulus { radii, height } => Some((Outline::Annulus { radii, height }, 2)),
            Self::Ring { radius, tube_radius } => Some((Outline::Ring { radius, tube_radius }, 2)),
            Self::Shell { outer, inner } => {
                let [axis, across] = round_about(&[inner, outer])?;
                let pair = |axis: usize| [inner[axis], outer[axis]];
                Some((Outline::Shell { across: pair(across), along: pair(axis) }, axis))
            }
            Self::Cuboid { .. } | Self::Mesh(_) => None,
        }
    }

    /// Response of the liquid in this shape, where it is known at every frequency. (L15)
    pub(super) fn turning(&self) -> Option<SpinningLiquid> {
        match self {
            Self::Ellipsoid { semi_axes: [a, b, c] } if a == b && b == c => {
                let inertia = 8.0 / 15.0 * PI * a.powi(5);
                Some(SpinningLiquid { flow: LiquidFlow::Ball, radius: *a, inertia, axes: vec![0, 1, 2] })
            }
            Self::Ellipsoid { semi_axes } => {
                let [axis, across] = round_about(&[*semi_axes])?;
                let (along, across) = (semi_axes[axis], semi_axes[across]);
                let stretch = (along / across).powi(2);
                let unit = [0, 1, 2].map(|place| if place == axis { 1.0 } else { 0.0 });
                STRETCHES.contains(&stretch).then(|| SpinningLiquid {
                    flow: LiquidFlow::Spheroid { axis: unit, stretch },
                    radius: across,
                    inertia: 8.0 / 15.0 * PI * across.powi(4) * along,
                    axes: vec![0, 1, 2],
                })
            }
            Self::Cylinder { radius, height } => {
                let half = 0.5 * height / radius;
                HALVES.contains(&half).then(|| SpinningLiquid {
                    flow: LiquidFlow::Cylinder { axis: [0.0, 0.0, 1.0], half },
                    radius: *radius,
                    inertia: 0.5 * PI * radius.powi(4) * height,
                    axes: vec![0, 1, 2],
                })
            }
            Self::Ring { radius, tube_radius } if *tube_radius <= SLENDER * radius => {
                let inertia = 2.0 * PI * PI * radius.powi(3) * tube_radius * tube_radius;
                Some(SpinningLiquid { flow: LiquidFlow::Tube, radius: *tube_radius, inertia, axes: vec![2] })
            }
            _ => None,
        }
    }

    /// Volume and moments in closed form; none of a mesh, which has its own.
    pub(super) fn extent(&self) -> Option<Extent> {
        let (volume, squares) = match self {
            Self::Ellipsoid { semi_axes } => ball(*semi_axes),
            Self::Cylinder { radius, height } => tube([0.0, *radius], *height),
            Self::Annulus { radii, height } => tube(*radii, *height),
            Self::Ring { radius, tube_radius } => {
                let (own, far) = (tube_radius * tube_radius, radius * radius);
                let across = 0.5 * far + 0.375 * own;
                (2.0 * PI * PI * radius * own, [across, across, 0.25 * own])
            }
            Self::Cuboid { sides } => (sides.iter().product(), sides.map(|side| side * side / 12.0)),
            Self::Shell { outer, inner } => {
                let ((whole, far), (hole, near)) = (ball(*outer), ball(*inner));
                let volume = whole - hole;
                (volume, [0, 1, 2].map(|axis| (whole * far[axis] - hole * near[axis]) / volume))
            }
            Self::Mesh(_) => return None,
        };
        let second = Matrix3::from_diagonal(&(volume * Vector3::from(squares)));
        Some(Extent { volume, center: Vector3::zeros(), second })
    }

    /// Mesh of tetrahedra, `resolution` of them across the narrowest width, with a grading towards the walls; none of a cavity that is of
    /// revolution whatever its lengths.
    pub(super) fn mesh(
        &self,
        resolution: usize,
        grading: f64,
    ) -> Option<Result<Cow<'_, Mesh>, MeshingError>> {
        let made = match self {
            Self::Ellipsoid { semi_axes } => meshing::ellipsoid(*semi_axes, resolution, grading),
            Self::Cuboid { sides } => meshing::cuboid(*sides, resolution, grading),
            Self::Shell { outer, inner } => meshing::shell(*outer, *inner, resolution, grading),
            Self::Mesh(mesh) => return Some(Ok(Cow::Borrowed(mesh))),
            Self::Cylinder { .. } | Self::Annulus { .. } | Self::Ring { .. } => return None,
        };
        Some(made.map(Cow::Owned))
    }
}

/// Axis about which all these semi-axes are those of a body of revolution, and one across it.
fn round_about(all: &[[f64; 3]]) -> Option<[usize; 2]> {
    let across = |axis: usize| [(axis + 1) % 3, (axis + 2) % 3];
    let is_round = |axis: &usize| {
        let [a, b] = across(*axis);
        all.iter().all(|semi_axes| semi_axes[a] == semi_axes[b])
    };
    [2, 1, 0].into_iter().find(is_round).map(|axis| [axis, across(axis)[0]])
}

/// Volume of an ellipsoid and the mean squares of the coordinates in it.
fn ball(semi_axes: [f64; 3]) -> (f64, [f64; 3]) {
    let volume = 4.0 / 3.0 * PI * semi_axes.iter().product::<f64>();
    (volume, semi_axes.map(|axis| axis * axis / 5.0))
}

/// Volume of a cylinder with a hole, and the mean squares of the coordinates in it.
fn tube([inner, outer]: [f64; 2], height: f64) -> (f64, [f64; 3]) {
    let (near, far) = (inner * inner, outer * outer);
    let across = 0.25 * (near + far);
    (PI * (far - near) * height, [across, across, height * height / 12.0])
}

impl From<&Moments> for Extent {
    fn from(moments: &Moments) -> Self {
        let second = Matrix3::from_fn(|row, column| moments.second[row][column]);
        Self { volume: moments.volume, center: moments.center.into(), second }
    }
}

impl Extent {
    /// Inertia tensor about the centre of volume, of unit density (m⁵).
    pub fn inertia(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal_element(self.second.trace()) - self.second
    }

    /// Mean of the principal moments (m⁵).
    pub fn mean_inertia(&self) -> f64 {
        2.0 / 3.0 * self.second.trace()
    }
}
