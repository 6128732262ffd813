use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use crate::elements::coefficient;
use crate::elements::error::{Field, Problem};
use crate::math::mesh::Mesh;
use crate::math::meshing::{self, MeshingError};

/// Shape of a cavity, about its middle, in axes of its own.
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
    /// What lies between two circular cylinders along z.
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
    /// What lies between two ellipsoids.
    Shell {
        /// Semi-axes of the outer one along x, y, z (m).
        outer: [f64; 3],
        /// Semi-axes of the inner one (m).
        inner: [f64; 3],
    },
    /// What tetrahedra fill; places from the middle of the shape (m).
    Mesh(Box<Mesh>),
}

/// A liquid that turns as one about some of the axes.
pub(super) struct Turning {
    /// Index of the Bessel functions of its flow.
    pub index: f64,
    /// Distance from the wall to the middle of the flow (m).
    pub radius: f64,
    /// Moment of inertia of what turns, of unit density (m⁵).
    pub inertia: f64,
    /// Numbers of the axes.
    pub axes: Vec<usize>,
}

/// The radius of the tube of a slender ring is at most this share of that of the ring.
pub(super) const SLENDER: f64 = 0.1;

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
    /// Accepts lengths that are positive.
    pub(super) fn check(&self) -> Result<(), (Field, Problem)> {
        let lengths = match self {
            Self::Ellipsoid { semi_axes } => vec![(Field::SemiAxes, semi_axes.to_vec())],
            Self::Cylinder { radius, height } => {
                vec![(Field::Radius, vec![*radius]), (Field::Height, vec![*height])]
            }
            Self::Annulus { radii, height } => {
                vec![(Field::Radii, radii.to_vec()), (Field::Height, vec![*height])]
            }
            Self::Ring { radius, tube_radius } => {
                vec![(Field::Radius, vec![*radius]), (Field::TubeRadius, vec![*tube_radius])]
            }
            Self::Cuboid { sides } => vec![(Field::Sides, sides.to_vec())],
            Self::Shell { outer, inner } => {
                vec![(Field::SemiAxes, outer.to_vec()), (Field::InnerSemiAxes, inner.to_vec())]
            }
            Self::Mesh(_) => Vec::new(),
        };
        for (field, values) in lengths {
            values
                .iter()
                .try_for_each(|value| coefficient::positive(*value))
                .map_err(|problem| (field, problem))?;
        }
        Ok(())
    }

    /// How the liquid in it turns as one, where that is known at every frequency. (C11)
    pub(super) fn turning(&self) -> Option<Turning> {
        match self {
            Self::Ellipsoid { semi_axes: [a, b, c] } if a == b && b == c => {
                let inertia = 8.0 / 15.0 * PI * a.powi(5);
                Some(Turning { index: 1.5, radius: *a, inertia, axes: vec![0, 1, 2] })
            }
            Self::Ring { radius, tube_radius } if *tube_radius <= SLENDER * radius => {
                let inertia = 2.0 * PI * PI * radius.powi(3) * tube_radius * tube_radius;
                Some(Turning { index: 0.0, radius: *tube_radius, inertia, axes: vec![2] })
            }
            _ => None,
        }
    }

    /// Volume and moments in closed form; none of a mesh, which knows its own.
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

    /// Tetrahedra that fill it, so many across its narrowest width; none of an ellipsoid, which needs none, as a slender ring.
    pub(super) fn mesh(&self, resolution: usize) -> Option<Result<Mesh, MeshingError>> {
        let even = 1.0;
        Some(match self {
            Self::Ellipsoid { .. } => return None,
            Self::Ring { radius, tube_radius } if *tube_radius <= SLENDER * radius => return None,
            Self::Cylinder { radius, height } => meshing::cylinder(*radius, *height, resolution, even),
            Self::Annulus { radii, height } => meshing::annulus(*radii, *height, resolution, even),
            Self::Ring { radius, tube_radius } => meshing::ring(*radius, *tube_radius, resolution, even),
            Self::Cuboid { sides } => meshing::cuboid(*sides, resolution, even),
            Self::Shell { outer, inner } => meshing::shell(*outer, *inner, resolution, even),
            Self::Mesh(mesh) => Ok(Mesh::clone(mesh)),
        })
    }
}

/// Volume of an ellipsoid and the mean squares of the coordinates in it.
fn ball(semi_axes: [f64; 3]) -> (f64, [f64; 3]) {
    let volume = 4.0 / 3.0 * PI * semi_axes.iter().product::<f64>();
    (volume, semi_axes.map(|axis| axis * axis / 5.0))
}

/// The same of a cylinder with a hole.
fn tube([inner, outer]: [f64; 2], height: f64) -> (f64, [f64; 3]) {
    let (near, far) = (inner * inner, outer * outer);
    let across = 0.25 * (near + far);
    (PI * (far - near) * height, [across, across, height * height / 12.0])
}

impl Extent {
    /// Inertia tensor about the centre of volume, of unit density (m⁵).
    pub fn inertia(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal_element(self.second.trace()) - self.second
    }
}
