//! Tank of revolution, partly full: bobs on springs for the slosh modes of its liquid, and a rigid body for the rest.
//! The liquid has settled under an effective gravity along the axis of the tank; of a sphere every direction is an axis.
//! Equations (U1) to (U9) and (U17), docs/theory/21-slosh.md.

mod baffle;
mod bobs;
mod error;
mod measured;
mod outline;
mod settled;
mod shape;

use crate::Assembly;
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::flow::revolution::Wall;
use crate::number;
use crate::visual::Outline;

pub use baffle::RingBaffle;
pub(crate) use bobs::Sloshing;
pub use bobs::{SettledTank, TankMode};
pub use error::TankError;
pub use measured::MeasuredSlosh;
pub(crate) use settled::Settled;
pub use shape::TankShape;

/// Tank of revolution that is partly full of a liquid, at rest under an effective gravity along its axis. (U1)–(U9)
///
/// The mass of the liquid is added to the carrier's.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Tank {
    /// Unique name.
    pub name: String,
    /// Wall, about the axis.
    pub shape: TankShape,
    /// Middle of the shape, or origin of its profile (m), in the file's frame.
    pub center: [f64; 3],
    /// Axis of revolution, in the file's frame; any length but zero.
    pub axis: [f64; 3],
    /// Amount of liquid.
    pub contents: TankContents,
    /// Density of the liquid (kg/m³).
    pub density: f64,
    /// Damping of the slosh modes.
    pub damping: TankDamping,
    /// Surface tension (N/m); none for that of water, 0.07 N/m, where capillarity is judged.
    pub surface_tension: Option<f64>,
    /// Ring baffles at the wall. (U17)
    pub baffles: Vec<RingBaffle>,
    /// Amplitude of the wave at the wall (m) by which baffles damp.
    pub wave_amplitude: Option<f64>,
    /// Measured values of the slosh modes, slowest first; at most one for each.
    pub measured: Vec<MeasuredSlosh>,
    /// What the liquid has settled under.
    pub settled_by: Settling,
    /// Number of slosh modes across each of two directions, 1 to [`MOST_MODES`](Self::MOST_MODES).
    pub modes: usize,
}

/// Amount of liquid in a tank.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TankContents {
    /// Share of the volume, between 0 and 1.
    Fill(f64),
    /// Mass (kg).
    Mass(f64),
}

/// Damping of the slosh modes of a tank.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TankDamping {
    /// That of the laminar layer at the wall, of a liquid of this kinematic viscosity (m²/s). (U7)
    WallLayer(f64),
    /// The same with that under a surface whose film of dirt does not stretch. (U7)
    ContaminatedLayer(f64),
    /// A damping ratio, the same of every mode.
    Ratio(f64),
}

/// What the liquid of a tank has settled under.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Settling {
    /// An acceleration (m/s²) that the liquid feels, as a weight, in the file's axes; it lies on the side to which this points.
    Acceleration([f64; 3]),
    /// A steady spin (rad/s), in the file's axes, about the centre of mass or the point that is held.
    Spin([f64; 3]),
}

/// Key of the fill.
const FILL: Field = Field::new("fill");
/// Key of the mass of the liquid.
const LIQUID_MASS: Field = Field::new("liquid_mass");
/// Key of what the liquid has settled under.
const SETTLED_BY: Field = Field::new("settled_by");
/// Key of the baffles.
const BAFFLES: Field = Field::new("baffles");
/// Key of the amplitude by which baffles damp.
const WAVE_AMPLITUDE: Field = Field::new("wave_amplitude");
/// Key of measured values.
const MEASURED: Field = Field::new("measured");
/// Key of a damping ratio.
const DAMPING_RATIO: Field = Field::new("damping_ratio");
/// Key of the surface tension.
const SURFACE_TENSION: Field = Field::new("surface_tension");

impl Tank {
    /// The most slosh modes of a tank.
    pub const MOST_MODES: usize = 6;

    /// Number of coordinates: two for each mode.
    pub(crate) fn coordinates(&self) -> usize {
        2 * self.modes
    }

    /// The wall, with heights along the axis from the centre, after a check of the values.
    fn checked_wall(&self, id: ElementId) -> Result<Wall, ElementError> {
        number::finite(&self.center).map_err(at(id, Field::CENTER))?;
        number::unit(self.axis).map_err(at(id, Field::AXIS))?;
        number::positive(self.density).map_err(at(id, Field::DENSITY))?;
        match self.damping {
            TankDamping::WallLayer(viscosity) | TankDamping::ContaminatedLayer(viscosity) => {
                number::positive(viscosity).map_err(at(id, Field::VISCOSITY))?;
            }
            TankDamping::Ratio(ratio) => number::non_negative(ratio).map_err(at(id, DAMPING_RATIO))?,
        }
        self.surface_tension.map_or(Ok(()), number::positive).map_err(at(id, SURFACE_TENSION))?;
        if !(1..=Self::MOST_MODES).contains(&self.modes) {
            let error = TankError::Modes { modes: self.modes, most: Self::MOST_MODES };
            return Err(at(id, Field::MODES)(error.into()));
        }
        self.check_measured(id)?;
        let (Settling::Acceleration(felt) | Settling::Spin(felt)) = self.settled_by;
        number::finite(&felt).map_err(at(id, SETTLED_BY))?;
        self.shape.wall().map_err(|(field, problem)| at(id, field)(problem))
    }

    /// Volume of the liquid (m³) in a wall.
    fn volume(&self, id: ElementId, wall: &Wall) -> Result<f64, ElementError> {
        let capacity = wall.moments().volume;
        let refused = |field: Field, error: TankError| Err(at(id, field)(error.into()));
        let volume = match self.contents {
            TankContents::Fill(fill) if fill > 0.0 && fill < 1.0 => fill * capacity,
            TankContents::Fill(fill) => return refused(FILL, TankError::Fill { fill }),
            TankContents::Mass(mass) => {
                number::mass(mass).map_err(at(id, LIQUID_MASS))?;
                let most = self.density * capacity;
                if mass >= most {
                    return refused(LIQUID_MASS, TankError::Overfull { mass, most });
                }
                mass / self.density
            }
        };
        if volume.is_normal() && capacity.is_normal() {
            Ok(volume)
        } else {
            Err(at(id, Field::SHAPE)(Problem::NotFinite { value: capacity }))
        }
    }
}

impl Element for Tank {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        let check = || {
            let wall = self.checked_wall(id)?;
            self.volume(id, &wall)?;
            match self.settled_by {
                Settling::Acceleration(_) => self.settle(id, self.center.into()).map(drop),
                Settling::Spin(_) => Ok(()),
            }
        };
        check().err().into_iter().collect()
    }

    fn outline(&self, id: ElementId, _: &Assembly) -> Option<Outline> {
        self.drawn(id)
    }
}
