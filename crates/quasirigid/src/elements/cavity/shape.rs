use nalgebra::{Matrix3, Vector3};

use super::ellipsoid::EllipsoidFlow;
use super::liquid::{Memory, Relaxations};
use crate::elements::coefficient;
use crate::elements::error::{Field, Problem};

/// Shape of a cavity, about its middle, in axes of its own.
#[derive(Clone, Debug, PartialEq)]
pub enum CavityShape {
    /// An ellipsoid; a ball if all semi-axes are the same.
    Ellipsoid {
        /// Semi-axes along x, y, z (m).
        semi_axes: [f64; 3],
    },
}

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
    pub(super) fn check(&self) -> Result<(), (Field, Problem)> {
        match self {
            Self::Ellipsoid { semi_axes } => {
                let wrong = semi_axes.iter().find_map(|axis| coefficient::positive(*axis).err());
                wrong.map_or(Ok(()), |problem| Err((Field::SemiAxes, problem)))
            }
        }
    }

    pub(super) fn extent(&self) -> Extent {
        match self {
            Self::Ellipsoid { semi_axes } => {
                let volume = 4.0 / 3.0 * std::f64::consts::PI * semi_axes.iter().product::<f64>();
                let squares = Vector3::from(semi_axes.map(|axis| axis * axis));
                let second = Matrix3::from_diagonal(&(volume / 5.0 * squares));
                Extent { volume, center: Vector3::zeros(), second }
            }
        }
    }

    /// Radius of a ball (m); none of another shape.
    pub(super) fn radius(&self) -> Option<f64> {
        match self {
            Self::Ellipsoid { semi_axes: [a, b, c] } => (a == b && b == c).then_some(*a),
        }
    }

    /// Relaxations of the liquid in it, in the axes of the cavity.
    pub(super) fn relaxations(&self, memory: Memory) -> Result<Relaxations, Problem> {
        let mass = self.extent().inertia().trace() / 3.0;
        match self {
            Self::Ellipsoid { semi_axes } => {
                let steps = memory.depth.saturating_sub(1).max(memory.modes);
                let flow = EllipsoidFlow::new(*semi_axes, 3 + 2 * steps);
                flow.and_then(|flow| Relaxations::of(&flow, memory, mass)).ok_or(Problem::LiquidUnresolved)
            }
        }
    }
}

impl Extent {
    /// Inertia tensor about the centre of volume, of unit density (m⁵).
    pub fn inertia(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal_element(self.second.trace()) - self.second
    }
}
