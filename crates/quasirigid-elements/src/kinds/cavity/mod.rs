//! Cavities full of a viscous liquid.

mod advection;
mod boundary_layer;
mod ellipsoid;
mod flowing;
mod ideal;
mod liquid;
mod meshed;
mod outline;
mod pipe;
mod revolved;
mod shape;
#[cfg(test)]
mod tests;

use nalgebra::{Matrix3, Vector3};

use crate::contribution::Internal;
use crate::contribution::Piece;
use crate::contribution::SlowLiquid;
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::math::rotation::to_inertial;
use crate::model::{Advection, Coordinate, Inertia, LiquidFlow, LiquidMemory, Pair};
use crate::number;
use crate::visual::Outline;
use crate::{Assembly, Incomplete};
use flowing::Flowing;
use liquid::{Memory, Relaxations};
pub use shape::CavityShape;
use shape::SpinningLiquid;

/// A cavity of the carrier, full of a viscous liquid. (L1)–(L6)
///
/// The mass of the liquid joins that of the carrier. Its motion relative to the carrier is slow: the inertial and Coriolis forces act on
/// it, the square of its own velocity is left out. (L2)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Cavity {
    /// Unique name.
    pub name: String,
    /// Shape.
    pub shape: CavityShape,
    /// Middle of the shape (m), in the file's frame.
    pub center: [f64; 3],
    /// Attitude: unit quaternion, scalar first, from components along the axes of the shape to those along the file's.
    pub attitude: [f64; 4],
    /// Density of the liquid (kg/m³).
    pub density: f64,
    /// Kinematic viscosity of the liquid (m²/s).
    pub viscosity: f64,
    /// Degree of the polynomials in a cavity of revolution, 4 to 24, or the cells across the narrowest width of a box or a shell that is
    /// none; other shapes ignore it.
    pub resolution: usize,
    /// Regime of the flow.
    pub regime: Regime,
    /// Number of rates of change, 0 to 6, whose responses are kept beside the slow ones, each eight times as fast as the one before (L11);
    /// of a boundary layer panels of rates, each sixteen times as fast, beside the first two (L14).
    pub modes: usize,
}

/// Regime of the flow of a liquid.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Regime {
    /// Viscous throughout. (L1)–(L11)
    #[default]
    Viscous,
    /// Ideal but for a thin boundary layer, at high Reynolds numbers. (L12)–(L14)
    BoundaryLayer,
}

/// Reynolds numbers of a ball and of a spheroid up to which the ratio to the boundary layer is right to two per cent, and of a cylinder, as
/// high as wide at most, up to which its fields are.
pub const MAX_REYNOLDS_OF_BALL: f64 = 2e6;
/// As [`MAX_REYNOLDS_OF_BALL`].
pub const MAX_REYNOLDS_OF_SPHEROID: f64 = 5e5;
/// As [`MAX_REYNOLDS_OF_BALL`].
pub const MAX_REYNOLDS_OF_CYLINDER: f64 = 3e4;
/// Sine of the angle between a spin and the axis of a spheroid or a cylinder that changes its response by a per cent at most, and Reynolds
/// number of the spin across the axis that does so. (L18)
const ALIGNED: f64 = 0.05;
const WEAK: f64 = 2.0;
/// Margin over twice the spin, above which no wave has its frequency; the layer shifts them a little.
const BEYOND_WAVES: f64 = 2.2;
/// Reynolds number, per step of (L6), up to which slow flows hold the Coriolis force.
const SLOW_REYNOLDS: f64 = 5.0;
/// Most rates of change whose responses are kept.
const MOST_MODES: usize = 6;
/// Deviation from one up to which the square of the norm of an attitude is one.
const UNIT: f64 = 1e-9;

impl Cavity {
    /// Accepts the values of a cavity.
    fn check_values(&self, place: ElementId) -> Result<(), ElementError> {
        self.shape.check().map_err(|(field, problem)| at(place, field)(problem))?;
        number::finite(&self.center).map_err(at(place, Field::CENTER))?;
        number::positive(self.density).map_err(at(place, Field::DENSITY))?;
        number::positive(self.viscosity).map_err(at(place, Field::VISCOSITY))?;
        let norm = self.attitude.iter().map(|part| part * part).sum::<f64>();
        if !((norm - 1.0).abs() < UNIT) {
            return Err(at(place, Field::ATTITUDE)(Problem::NotAttitude { norm: norm.sqrt() }));
        }
        if self.modes > MOST_MODES {
            let problem = Problem::TooManyModes { modes: self.modes, most: MOST_MODES };
            return Err(at(place, Field::MODES)(problem));
        }
        Ok(())
    }

    /// Whether the linear response of the liquid holds for a small motion at a frequency (rad/s, body axes) about a steady spin (rad/s, in
    /// the file's frame), with coordinates for an order of the reduction.
    ///
    /// Liquid that spins has waves below twice the spin. Where its response is not known at every frequency its coordinates hold them at
    /// low Reynolds numbers only, and behind a boundary layer none. (L15), (L18)
    #[must_use]
    pub fn answers(&self, slow: &SlowLiquid, order: usize, spin: [f64; 3], frequency: f64) -> bool {
        let spin = Vector3::from(spin);
        let rate = spin.norm();
        let along = |axis: [f64; 3], time: f64, most: f64| {
            let across = spin.cross(&Vector3::from(axis)).norm();
            (across <= ALIGNED * rate || across * time <= WEAK) && rate * time <= most
        };
        let known = self.memory(0);
        match known.map(|memory| (memory.flow, memory.time)) {
            Some((LiquidFlow::Tube, _)) => true,
            Some((LiquidFlow::Ball, time)) => rate * time <= MAX_REYNOLDS_OF_BALL,
            Some((LiquidFlow::Spheroid { axis, .. }, time)) => along(axis, time, MAX_REYNOLDS_OF_SPHEROID),
            Some((LiquidFlow::Cylinder { axis, half }, time)) => {
                along(axis, time, MAX_REYNOLDS_OF_CYLINDER / half.max(1.0).powi(2))
            }
            None if frequency > BEYOND_WAVES * rate => true,
            None if self.regime == Regime::BoundaryLayer => false,
            None => slow.reynolds(rate) <= SLOW_REYNOLDS * order.div_ceil(2).max(1) as f64,
        }
    }

    /// Liquid with its motions, to the depth that an order of the reduction needs.
    fn filled(&self, place: ElementId, order: usize) -> Result<Internal, ElementError> {
        self.check_values(place)?;
        let memory = Memory { depth: order.div_ceil(2).max(1), modes: self.modes };
        let flowing = match self.regime {
            Regime::Viscous => Flowing::new(&self.shape, self.resolution, memory),
            Regime::BoundaryLayer => Flowing::layered(&self.shape, self.resolution, self.modes),
        };
        let Flowing { extent, relaxations, errors, equivalent } =
            flowing.map_err(|(field, problem)| at(place, field)(problem))?;
        let turn = self.turn();
        let inertia = self.density * (turn * extent.inertia() * turn.transpose());
        let inertia =
            Inertia::new(rows(&inertia)).map_err(|error| at(place, Field::DENSITY)(error.into()))?;
        let mass = self.density * extent.volume;
        let (P, inertia_of_unit) = (relaxations.slow_tensor(), extent.inertia());
        let slowest = (0..3).map(|k| P[(k, k)] / inertia_of_unit[(k, k)]).fold(0.0, f64::max);
        let piece = Piece::rigid(mass, Vector3::zeros(), &inertia);
        let slow = SlowLiquid {
            mass,
            radius: (35.0 * slowest).sqrt(),
            tensor: rows(&(turn * P * turn.transpose())),
            errors,
            equivalent: equivalent.map(|inertia| rows(&(self.density * (turn * inertia * turn.transpose())))),
            viscosity: self.viscosity,
        };
        Ok(Internal {
            rigid: vec![(piece, Vector3::from(self.center) + turn * extent.center)],
            liquids: vec![slow],
            ..self.relaxing(relaxations)
        })
    }

    /// Cyclic coordinates of the liquid.
    fn relaxing(&self, relaxations: Relaxations) -> Internal {
        let turn = self.turn();
        let Relaxations { mass, friction, momentum, turning, shares, advection } = relaxations;
        let coordinate = |number: usize| Coordinate {
            name: format!("\"{}\" relaxation {}", self.name, number + 1),
            unit: "rad",
        };
        let count = friction.len();
        let own = (0..count).map(|j| (j, j, Pair { A: self.density * mass, ..Pair::default() }));
        let coupled = turning.into_iter().map(|(j, k, turning)| {
            (j, k, Pair { Z: (2.0 * self.density * (turn * turning)).into(), ..Pair::default() })
        });
        let terms: Vec<_> = advection.into_iter().map(|(flows, term)| (flows, self.density * term)).collect();
        let advections = if terms.is_empty() {
            Vec::new()
        } else {
            vec![Advection { coordinates: 0..count, shares, terms }]
        };
        let brake = self.density * self.viscosity;
        let friction = friction.iter().enumerate().map(|(j, friction)| (j, j, brake * friction));
        Internal {
            memories: self.memory(count).into_iter().collect(),
            coordinates: (0..count).map(coordinate).collect(),
            h: momentum.iter().map(|h| (self.density * (turn * h)).into()).collect(),
            pairs: own.chain(coupled).collect(),
            friction: vec![(self.name.clone(), friction.collect())],
            advections,
            ..Internal::default()
        }
    }

    /// Linear response of the liquid where it is known at every frequency; `count` is the number of its coordinates. (L15)
    fn memory(&self, count: usize) -> Option<LiquidMemory> {
        let SpinningLiquid { flow, radius, inertia, axes } = self.shape.turning()?;
        if self.regime == Regime::BoundaryLayer && flow == LiquidFlow::Tube {
            return None;
        }
        let turn = self.turn();
        let flow = match flow {
            LiquidFlow::Spheroid { axis, stretch } => {
                LiquidFlow::Spheroid { axis: (turn * Vector3::from(axis)).into(), stretch }
            }
            LiquidFlow::Cylinder { axis, half } => {
                LiquidFlow::Cylinder { axis: (turn * Vector3::from(axis)).into(), half }
            }
            other => other,
        };
        Some(LiquidMemory {
            coordinates: 0..count,
            axes: axes.iter().map(|axis| turn.column(*axis).into_owned().into()).collect(),
            flow,
            inertia: self.density * inertia,
            time: radius * radius / self.viscosity,
        })
    }

    /// Rotation from components along the axes of the shape to those along the file's.
    fn turn(&self) -> Matrix3<f64> {
        let columns =
            Matrix3::<f64>::identity().data.0.map(|axis| Vector3::from(to_inertial(self.attitude, axis)));
        Matrix3::from_columns(&columns)
    }
}

impl Element for Cavity {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        self.check_values(id).err().into_iter().collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        let ring = matches!(self.shape, CavityShape::Ring { .. });
        if self.regime == Regime::Viscous && !ring { vec![Incomplete::Liquids] } else { Vec::new() }
    }

    fn outline(&self, _: ElementId, _: &Assembly) -> Option<Outline> {
        Some(self.wall())
    }

    fn inner(&self, id: ElementId, order: usize) -> Result<Option<Internal>, ElementError> {
        self.filled(id, order).map(Some)
    }
}

fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)]))
}

impl SlowLiquid {
    /// Reynolds number of a rotation with this spin (rad/s), `|ω|a²/ν` with the [`radius`](Self::radius) `a`.
    #[must_use]
    pub fn reynolds(&self, spin: f64) -> f64 {
        spin * self.radius * self.radius / self.viscosity
    }
}
