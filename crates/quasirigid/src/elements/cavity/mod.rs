//! Cavities full of a viscous liquid.

mod ellipsoid;
mod liquid;
mod shape;

use nalgebra::{Matrix3, Vector3};

use super::affine::Piece;
use super::coefficient;
use super::error::{ElementError, Field, Place, Problem, at};
use super::inner::Inner;
use crate::math::rotation::to_inertial;
use crate::model::{Coordinate, Inertia, LiquidMemory, Pair};
use liquid::{Memory, Relaxations};
pub use shape::CavityShape;

/// A cavity of the carrier, full of a viscous liquid. (L1)–(L6)
///
/// Its mass joins that of the carrier. Its motion relative to the carrier is slow: the force of inertia and that of Coriolis act
/// on it, the square of its own velocity is left out. (L2)
#[derive(Clone, Debug, PartialEq)]
pub struct Cavity {
    /// Unique name.
    pub name: String,
    /// Shape.
    pub shape: CavityShape,
    /// Middle of the shape (m), in the file's frame.
    pub center: [f64; 3],
    /// Unit quaternion, scalar first, that turns components along the axes of the shape into those along the file's.
    pub attitude: [f64; 4],
    /// Density of the liquid (kg/m³).
    pub density: f64,
    /// Kinematic viscosity of the liquid (m²/s).
    pub viscosity: f64,
    /// Relaxations that are kept beside those that the slow motion needs, as the length of a chain.
    pub modes: usize,
}

/// What a liquid does to a slow rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowLiquid {
    /// Mass (kg).
    pub mass: f64,
    /// Radius of the ball of as much mass and mean moment of inertia (m).
    pub radius: f64,
    /// Tensor `P` (m⁷), in the file's axes. (L5)
    pub tensor: [[f64; 3]; 3],
    /// Kinematic viscosity (m²/s).
    pub viscosity: f64,
}

/// Most steps of a chain of relaxations.
const MOST_MODES: usize = 6;
/// The square of the norm of an attitude is one but for this.
const UNIT: f64 = 1e-9;

impl Cavity {
    pub(super) fn check(&self, index: usize) -> Result<(), ElementError> {
        let place = Place::Cavity(index);
        self.shape.check().map_err(|(field, problem)| at(place, field)(problem))?;
        coefficient::finite(&self.center).map_err(at(place, Field::Center))?;
        coefficient::positive(self.density).map_err(at(place, Field::Density))?;
        coefficient::positive(self.viscosity).map_err(at(place, Field::Viscosity))?;
        let norm = self.attitude.iter().map(|part| part * part).sum::<f64>();
        if !((norm - 1.0).abs() < UNIT) {
            return Err(at(place, Field::Attitude)(Problem::NotAttitude { norm: norm.sqrt() }));
        }
        if self.modes > MOST_MODES {
            let problem = Problem::TooManyModes { modes: self.modes, most: MOST_MODES };
            return Err(at(place, Field::Modes)(problem));
        }
        Ok(())
    }

    /// The liquid at rest in the cavity, and its centre of mass (m), in the file's frame.
    pub(super) fn frozen(&self, index: usize) -> Result<(Piece, Vector3<f64>), ElementError> {
        self.check(index)?;
        let place = Place::Cavity(index);
        let turn = self.turn();
        let extent = self.shape.extent();
        let inertia = self.density * (turn * extent.inertia() * turn.transpose());
        let rows = std::array::from_fn(|row| std::array::from_fn(|column| inertia[(row, column)]));
        let inertia = Inertia::new(rows).map_err(|error| at(place, Field::Density)(error.into()))?;
        let center = Vector3::from(self.center) + turn * extent.center;
        Ok((Piece::rigid(self.density * extent.volume, Vector3::zeros(), &inertia), center))
    }

    /// The motions of the liquid, to as many steps as an order of the reduction needs.
    pub(super) fn inner(&self, index: usize, order: usize) -> Result<Inner, ElementError> {
        self.check(index)?;
        let place = Place::Cavity(index);
        let turn = self.turn();
        let relaxations = self.relaxations(order).map_err(at(place, Field::Shape))?;
        let Relaxations { mass, friction, momentum, turning } = relaxations;
        let coordinate = |number: usize| Coordinate {
            name: format!("\"{}\" relaxation {}", self.name, number + 1),
            unit: "rad",
        };
        let own = (0..friction.len()).map(|j| (j, j, Pair { A: self.density * mass, ..Pair::default() }));
        let coupled = turning.into_iter().map(|(j, k, turning)| {
            (j, k, Pair { Z: (2.0 * self.density * (turn * turning)).into(), ..Pair::default() })
        });
        let brake = self.density * self.viscosity;
        Ok(Inner {
            memories: self.memory(friction.len()).into_iter().collect(),
            coordinates: (0..friction.len()).map(coordinate).collect(),
            h: momentum.iter().map(|h| (self.density * (turn * h)).into()).collect(),
            pairs: own.chain(coupled).collect(),
            friction: friction.iter().enumerate().map(|(j, friction)| (j, j, brake * friction)).collect(),
            speeds: Vec::new(),
        })
    }

    /// What the liquid does to a slow rotation.
    ///
    /// # Errors
    /// [`ElementError`] if no liquid is like this; `index` is that of the cavity.
    pub fn slow(&self, index: usize) -> Result<SlowLiquid, ElementError> {
        self.check(index)?;
        let place = Place::Cavity(index);
        let turn = self.turn();
        let extent = self.shape.extent();
        let relaxations = self.relaxations(1).map_err(at(place, Field::Shape))?;
        let tensor = turn * relaxations.slow_tensor() * turn.transpose();
        let mean = extent.inertia().trace() / (3.0 * extent.volume);
        Ok(SlowLiquid {
            mass: self.density * extent.volume,
            radius: (2.5 * mean).sqrt(),
            tensor: std::array::from_fn(|row| std::array::from_fn(|column| tensor[(row, column)])),
            viscosity: self.viscosity,
        })
    }

    /// The linear answer of a ball, whose coordinates are so many.
    fn memory(&self, count: usize) -> Option<LiquidMemory> {
        let radius = self.shape.radius()?;
        let axes = Matrix3::<f64>::identity().data.0.to_vec();
        let inertia = self.density * self.shape.extent().inertia()[(0, 0)];
        Some(LiquidMemory {
            coordinates: 0..count,
            axes,
            index: 1.5,
            inertia,
            time: radius * radius / self.viscosity,
        })
    }

    fn relaxations(&self, order: usize) -> Result<Relaxations, Problem> {
        let memory = Memory { depth: order.div_ceil(2).max(1), modes: self.modes };
        self.shape.relaxations(memory)
    }

    /// Turns components along the axes of the shape into those along the file's.
    fn turn(&self) -> Matrix3<f64> {
        let columns =
            Matrix3::<f64>::identity().data.0.map(|axis| Vector3::from(to_inertial(self.attitude, axis)));
        Matrix3::from_columns(&columns)
    }
}

impl SlowLiquid {
    /// Reynolds number of a rotation with this spin (rad/s), `|ω|a²/ν` with the [`radius`](Self::radius) `a`.
    #[must_use]
    pub fn reynolds(&self, spin: f64) -> f64 {
        spin * self.radius * self.radius / self.viscosity
    }
}
