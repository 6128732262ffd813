//! Where the liquid of a tank lies: the side to which the effective gravity presses it, and the level there.

use nalgebra::Vector3;

use super::{SETTLED_BY, Settling, Tank, TankError};
use crate::error::{ElementError, ElementId, at};
use crate::flow::revolution::{Moments, Wall};
use crate::number;

/// Greatest angle between the effective gravity and the axis of a tank (degrees).
const MOST_TILT: f64 = 1.0;
/// Distance from the axis of a spin below which a tank is on it, as a share of its distance from the point of reference and its size.
const ON_AXIS: f64 = 1e-9;

/// Liquid of a tank at rest on one side of it.
#[derive(Clone, Debug)]
pub(crate) struct Settled {
    /// Centre of the tank (m).
    center: Vector3<f64>,
    /// Unit vector against the effective gravity along which heights are counted from the centre.
    pub up: Vector3<f64>,
    /// 1 where heights along the axis that the user gives are those along `up`, else −1.
    pub sense: f64,
    /// Angle between the effective gravity and the axis (rad).
    pub tilt: f64,
    /// Effective gravity (m/s²) at the centre, and its change per height (1/s²): the gravity falls towards the axis of a spin.
    pub gravity: [f64; 2],
    /// Lowest and highest place of the tank along the axis that the user gives, from the centre (m).
    pub heights: [f64; 2],
    /// Wall below the level.
    pub wall: Wall,
    /// Moments of the liquid about the centre, of unit density.
    pub moments: Moments,
    /// Mass of the liquid (kg), and as a share of what the tank holds.
    pub mass: f64,
    pub fill: f64,
}

impl Tank {
    /// The liquid at rest; a spin is about an axis through `about` (m).
    pub(crate) fn settle(&self, id: ElementId, about: Vector3<f64>) -> Result<Settled, ElementError> {
        let refused = |error: TankError| at(id, SETTLED_BY)(error.into());
        let center = Vector3::from(self.center);
        let wall = self.checked_wall(id)?;
        let (felt, slope) = match self.settled_by {
            Settling::Acceleration(felt) => (Vector3::from(felt), 0.0),
            Settling::Spin(spin) => {
                let spin = Vector3::from(spin);
                let arm = center - about;
                let felt = -spin.cross(&spin.cross(&arm));
                let off = felt.norm() / spin.norm_squared();
                let size = wall.moments().volume.cbrt();
                if spin != Vector3::zeros() && !(off > ON_AXIS * (arm.norm() + size)) {
                    return Err(refused(TankError::Weightless {
                        cause: "it is on the axis of the spin".into(),
                    }));
                }
                (felt, -spin.norm_squared())
            }
        };
        let down = number::unit(felt.into()).map_err(|_| {
            let cause = match self.settled_by {
                Settling::Acceleration(_) => "the acceleration is zero",
                Settling::Spin(_) => "the spin is zero",
            };
            refused(TankError::Weightless { cause: cause.into() })
        })?;
        let axis = number::unit(self.axis).map_err(at(id, crate::error::Field::AXIS))?;
        let sense = if axis.dot(&down) > 0.0 { -1.0 } else { 1.0 };
        let (up, tilt) = if self.shape.is_sphere() {
            (-down, 0.0)
        } else {
            (sense * axis, axis.cross(&down).norm().atan2(axis.dot(&down).abs()))
        };
        let degrees = tilt.to_degrees();
        if degrees > MOST_TILT {
            return Err(refused(TankError::Tilted { degrees, most: MOST_TILT }));
        }
        let volume = self.volume(id, &wall)?;
        let fill = volume / wall.moments().volume;
        let heights = wall.ends().map(|[_, height]| height);
        let wall = if sense < 0.0 { wall.flipped() } else { wall }.filled(volume);
        let moments = wall.moments();
        let gravity = [felt.norm(), slope];
        let mass = self.density * volume;
        Ok(Settled { center, up, sense, tilt, gravity, heights, wall, moments, mass, fill })
    }
}

impl Settled {
    /// Place at a height (m), in the file's frame.
    pub fn place(&self, height: f64) -> Vector3<f64> {
        self.center + height * self.up
    }

    /// Centre of mass (m), in the file's frame.
    pub fn center_of_mass(&self) -> Vector3<f64> {
        self.place(self.moments.first / self.moments.volume)
    }

    /// Effective gravity (m/s²) at a height.
    pub fn gravity_at(&self, height: f64) -> f64 {
        self.gravity[0] + height * self.gravity[1]
    }
}
