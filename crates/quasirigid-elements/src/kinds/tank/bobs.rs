//! Mechanical equivalent of a settled liquid: a bob on straight lines across the effective gravity for each mode, and a rigid rest.

use nalgebra::{Matrix3, Vector3};

use super::settled::Settled;
use super::{FILL, SETTLED_BY, Settling, Tank, TankDamping, TankError};
use crate::contribution::{Field as Shape, MovingBody, Piece};
use crate::error::{ElementError, ElementId, Field, at};
use crate::flow::revolution::{Slosh, SloshMode};
use crate::model::{Coordinate, Rheology};
use crate::structure::Block;

/// Degree of the polynomials and layers of patches at corners, of the grid that is used and of the one it is judged by.
const GRIDS: [[usize; 2]; 2] = [[8, 2], [6, 1]];
/// Greatest relative difference of both grids.
const UNRESOLVED: f64 = 1e-2;
/// Surface tension of water (N/m), where none is given.
const WATER: f64 = 0.07;
/// Least Bond number.
const LEAST_BOND: f64 = 1.0;
/// Greatest damping ratio of a layer that is thin.
const THIN: f64 = 0.3;
/// Least frequency of the slosh over the spin that settled the liquid.
const LEAST_RATIO: f64 = 2.0;

/// Liquid of a tank, settled, with its slosh modes.
#[derive(Clone, Debug, PartialEq)]
pub struct SettledTank {
    /// Name of the tank.
    pub name: String,
    /// Share of the volume that is full.
    pub fill: f64,
    /// Mass of the liquid (kg).
    pub liquid_mass: f64,
    /// Centre of mass of the liquid (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Slosh modes, slowest first; each is two coordinates.
    pub slosh: Vec<TankMode>,
    /// Effective gravity (m/s²) at the centre of the tank, in the file's axes.
    pub gravity: [f64; 3],
    /// What the liquid has settled under.
    pub settled_by: Settling,
    /// Angle between the effective gravity and the axis of the tank (rad).
    pub tilt: f64,
    /// Relative difference of two grids in wavenumber, mass and height of the modes.
    pub error: f64,
    /// Radius of the free surface (m).
    pub surface_radius: f64,
    /// Bond number `ρ g R²/σ` with the radius `R` of the surface, and whether the surface tension is that of water for want of another.
    pub bond: (f64, bool),
    /// Square of the spin over the lowest frequency, which the Coriolis force and the curvature of the surface change the slosh by; zero where
    /// no spin settled it. (U9)
    pub spin_share: f64,
    /// Moments of inertia (kg·m²) of the frozen liquid less those that an ideal one has, across the axis and about it. (U6), (U9)
    pub drag: [f64; 2],
    /// The greater of both over the least difference between the body's moment of inertia about the spin and those across it; zero where no
    /// spin settled the liquid. (U9)
    pub inertia_share: f64,
    /// Time (s) in which friction carries the liquid along about the axis, `R²/ν`; none where the viscosity is not given.
    pub drag_time: Option<f64>,
    /// Greatest damping ratio of the wall layer of a mode; zero where it was measured.
    pub layer: f64,
    /// Keulegan–Carpenter numbers of the baffles under the liquid in the first mode, and the amplitude of the wave (m); none without
    /// baffles. (U17)
    pub baffles: Option<(Vec<f64>, f64)>,
}

/// Slosh mode of a tank as a bob: a pendulum of this mass and length, hinged at `height + length` above the liquid's side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TankMode {
    /// `λ = ω²/g` (1/m). (U1)
    pub wavenumber: f64,
    /// Frequency (rad/s) in a tank at rest.
    pub frequency: f64,
    /// Mass of the bob (kg). (U3)
    pub mass: f64,
    /// Length of the pendulum (m), `1/λ`.
    pub length: f64,
    /// Height of the bob (m) along the axis of the tank, from its centre. (U3)
    pub height: f64,
    /// Damping ratio. (U7)
    pub damping_ratio: f64,
}

/// What the liquid of a tank gives to a body.
pub(crate) struct Sloshing {
    pub tank: SettledTank,
    /// The bobs, and the stiffness and damping of each over its two coordinates.
    pub bobs: Vec<(MovingBody, [f64; 2])>,
    /// The rest of the liquid, with its centre of mass (m).
    pub rest: (Piece, Vector3<f64>),
}

impl Sloshing {
    /// Stiffness and damping of the bobs over coordinates numbered from `start`.
    pub fn blocks(&self, start: usize) -> impl Iterator<Item = Block> + '_ {
        self.bobs.iter().enumerate().map(move |(number, (_, [stiffness, damping]))| Block {
            name: self.tank.name.clone(),
            columns: vec![start + 2 * number, start + 2 * number + 1],
            stiffness: diagonal(*stiffness),
            damping: diagonal(*damping),
            rheology: Rheology::Elastic,
        })
    }
}

fn diagonal(value: f64) -> Vec<Vec<f64>> {
    vec![vec![value, 0.0], vec![0.0, value]]
}

impl Tank {
    /// Slosh of the settled liquid.
    pub(crate) fn sloshing(&self, id: ElementId, settled: &Settled) -> Result<Sloshing, ElementError> {
        let refused = |field: Field, error: TankError| at(id, field)(error.into());
        let [fine, coarse] = GRIDS.map(|grid| Slosh::new(&settled.wall, self.modes, grid));
        let (Some(fine), Some(coarse)) = (fine, coarse) else {
            return Err(refused(FILL, TankError::Unresolved { error: None }));
        };
        let error = difference(&fine, &coarse, &settled.wall.ends());
        if !(error < UNRESOLVED) {
            return Err(refused(FILL, TankError::Unresolved { error: Some(error) }));
        }
        let slosh = fine.modes.iter().enumerate().map(|(number, mode)| self.mode(settled, (number, mode)));
        let slosh: Vec<TankMode> =
            slosh.collect::<Result<_, _>>().map_err(|(field, error)| refused(field, error))?;
        let layers = fine.modes.iter().enumerate().map(|(number, mode)| self.layer(settled, (number, mode)));
        let layer = layers.fold(0.0, f64::max);
        let drowned = fine.modes.first().map(|mode| self.baffled(settled, mode)).transpose();
        let drowned = drowned.map_err(|(field, error)| refused(field, error))?;
        let baffles = drowned.map(|(_, numbers)| numbers).zip(self.wave_amplitude);
        let [_, [radius, _]] = settled.wall.ends();
        let (bond, spin_share) =
            self.within_limits(settled, &slosh, layer).map_err(|(field, error)| refused(field, error))?;
        let moments = settled.moments;
        let frozen = self.density * (moments.along + 0.5 * moments.axial);
        let tank = SettledTank {
            name: self.name.clone(),
            fill: settled.fill,
            liquid_mass: settled.mass,
            center_of_mass: settled.center_of_mass().into(),
            gravity: (-settled.gravity[0] * settled.up).into(),
            settled_by: self.settled_by,
            tilt: settled.tilt,
            error,
            surface_radius: radius,
            bond: (bond, self.surface_tension.is_none()),
            spin_share,
            drag: [frozen - self.density * fine.lid, self.density * moments.axial],
            inertia_share: 0.0,
            drag_time: match self.damping {
                TankDamping::WallLayer(viscosity) | TankDamping::ContaminatedLayer(viscosity) => {
                    Some(radius * radius / viscosity)
                }
                TankDamping::Ratio(_) => None,
            },
            layer,
            baffles: baffles.filter(|(numbers, _)| !numbers.is_empty()),
            slosh,
        };
        let bobs = self.bobs(settled, &tank.slosh);
        let rest = self.rest(settled, &tank, self.density * fine.lid);
        let moving = tank.slosh.iter().map(|mode| mode.mass).sum();
        let up = settled.up;
        self.check_rest([rest.0.mass, up.dot(&(rest.0.second * up))], tank.liquid_mass, moving)
            .map_err(|(field, error)| refused(field, error))?;
        Ok(Sloshing { tank, bobs, rest })
    }

    /// Bond number, and the square of the spin over the lowest frequency, of a slosh that weight makes, with a thin layer at the wall, and fast
    /// beside the spin.
    fn within_limits(
        &self,
        settled: &Settled,
        slosh: &[TankMode],
        layer: f64,
    ) -> Result<(f64, f64), (Field, TankError)> {
        let [_, [radius, _]] = settled.wall.ends();
        let tension = self.surface_tension.unwrap_or(WATER);
        let bond = self.density * settled.gravity[0] * radius * radius / tension;
        if !(bond >= LEAST_BOND) {
            return Err((SETTLED_BY, TankError::Capillary { bond, least: LEAST_BOND }));
        }
        if !(layer <= THIN) {
            return Err((Field::VISCOSITY, TankError::Viscous { ratio: layer, most: THIN }));
        }
        let Settling::Spin(spin) = self.settled_by else { return Ok((bond, 0.0)) };
        let lowest = slosh.iter().fold(f64::INFINITY, |lowest, mode| lowest.min(mode.frequency));
        let ratio = lowest / Vector3::from(spin).norm();
        if !(ratio >= LEAST_RATIO) {
            return Err((SETTLED_BY, TankError::NearSpinAxis { ratio, least: LEAST_RATIO }));
        }
        Ok((bond, ratio.powi(-2)))
    }

    /// Frequency (rad/s) of a mode without a diaphragm, measured or of the theory.
    fn free_frequency(&self, settled: &Settled, (number, mode): (usize, &SloshMode)) -> f64 {
        let own = || (settled.gravity_at(mode.height) * mode.wavenumber).sqrt();
        self.measured(number).frequency.unwrap_or_else(own)
    }

    /// Damping ratio of the layer at the wall, and under the surface where that is dirty; zero where it was measured. (U7)
    fn layer(&self, settled: &Settled, (number, mode): (usize, &SloshMode)) -> f64 {
        if self.measured(number).damping_ratio.is_some() {
            return 0.0;
        }
        let layer = |viscosity: f64, rubbed: f64| {
            0.5 * (0.5 * viscosity / self.free_frequency(settled, (number, mode))).sqrt() * rubbed
        };
        match self.damping {
            TankDamping::WallLayer(viscosity) => layer(viscosity, mode.wall),
            TankDamping::ContaminatedLayer(viscosity) => layer(viscosity, mode.wall + mode.surface),
            TankDamping::Ratio(_) => 0.0,
        }
    }

    /// A mode of the theory, with what was measured in its place, and baffles and a diaphragm beside it.
    fn mode(
        &self,
        settled: &Settled,
        (number, mode): (usize, &SloshMode),
    ) -> Result<TankMode, (Field, TankError)> {
        let measured = self.measured(number);
        let own = match self.damping {
            TankDamping::Ratio(ratio) => ratio,
            _ => self.layer(settled, (number, mode)),
        };
        let (baffled, _) = self.baffled(settled, mode)?;
        let mass = measured.mass.unwrap_or(self.density * mode.mass);
        let free = self.free_frequency(settled, (number, mode));
        let frequency = (free * free + measured.stiffness / mass).sqrt();
        let decay = (measured.damping_ratio.unwrap_or(own) + baffled) * free + 0.5 * measured.damping / mass;
        let wavenumber = if frequency == (settled.gravity_at(mode.height) * mode.wavenumber).sqrt() {
            mode.wavenumber
        } else {
            frequency * frequency / settled.gravity_at(mode.height)
        };
        Ok(TankMode {
            wavenumber,
            frequency,
            mass,
            length: wavenumber.recip(),
            height: settled.sense * mode.height,
            damping_ratio: decay / frequency,
        })
    }

    /// A bob for each mode, with its stiffness and damping. (U3)
    fn bobs(&self, settled: &Settled, slosh: &[TankMode]) -> Vec<(MovingBody, [f64; 2])> {
        let bob = |(number, mode): (usize, &TankMode)| {
            let base = settled.place(settled.sense * mode.height);
            let TankMode { mass, frequency, damping_ratio, .. } = *mode;
            let label = format!("{} slosh {}", self.name, number + 1);
            let directions = across(settled.up);
            let coordinate = |(_, word): &(Vector3<f64>, &str)| Coordinate {
                name: format!("\"{}\" slosh {} {word}", self.name, number + 1),
                unit: "m",
            };
            let body = MovingBody {
                piece: Piece::point(mass),
                base,
                pose: Matrix3::identity(),
                shapes: directions.iter().map(|(direction, _)| Shape::constant(*direction)).collect(),
                curvature: vec![vec![Shape::constant(Vector3::zeros()); 2]; 2],
                axes: Vec::new(),
                oriented: false,
                coordinates: directions.iter().map(coordinate).collect(),
                marker: (label, Vector3::zeros()),
                places: Vec::new(),
                law: None,
            };
            (body, [mass * frequency * frequency, 2.0 * damping_ratio * mass * frequency])
        };
        slosh.iter().enumerate().map(bob).collect()
    }

    /// The liquid without the bobs: its mass, its first moment along the axis and its moment across it, with `lid` that of the whole ideal
    /// liquid under a rigid lid. About the axis nothing moves an ideal liquid; one that has settled by a spin turns with the tank. (U6), (U9)
    fn rest(&self, settled: &Settled, tank: &SettledTank, lid: f64) -> (Piece, Vector3<f64>) {
        let mut mass = settled.mass;
        let mut first = self.density * settled.moments.first;
        let (mut across, about) = match self.settled_by {
            Settling::Acceleration(_) => (lid, 0.0),
            Settling::Spin(_) => (lid + tank.drag[0], tank.drag[1]),
        };
        for mode in &tank.slosh {
            let height = settled.sense * mode.height;
            mass -= mode.mass;
            first -= mode.mass * height;
            across -= mode.mass * height * height;
        }
        let center = first / mass;
        let along = settled.up * settled.up.transpose();
        let second = 0.5 * about * (Matrix3::identity() - along)
            + (across - mass * center * center - 0.5 * about) * along;
        (Piece { mass, first: Vector3::zeros(), second }, settled.place(center))
    }
}

/// Relative difference of the modes of two grids; heights in units of the depth.
fn difference(fine: &Slosh, coarse: &Slosh, [[_, low], [_, high]]: &[[f64; 2]; 2]) -> f64 {
    let total = fine.all[0];
    let gaps = fine.modes.iter().zip(&coarse.modes).flat_map(|(a, b)| {
        let share = a.mass / total;
        [
            b.wavenumber / a.wavenumber - 1.0,
            (b.mass - a.mass) / total,
            share * (b.height - a.height) / (high - low),
            share.sqrt() * (b.wall / a.wall - 1.0),
        ]
    });
    let lid = (coarse.lid / fine.lid - 1.0).abs();
    gaps.fold(lid, |most, gap| if gap.abs() > most || gap.is_nan() { gap.abs() } else { most })
}

/// Two directions across a unit vector that with it are right-handed, each named after another axis of the file, the one that it is nearest to.
fn across(up: Vector3<f64>) -> [(Vector3<f64>, &'static str); 2] {
    let mut least = Vector3::zeros();
    least[up.iamin()] = 1.0;
    let first = (least - up * up.dot(&least)).normalize();
    let second = up.cross(&first);
    let named = first.iamax();
    let [a, b] = [(named + 1) % 3, (named + 2) % 3];
    let other = if second[a].abs() > second[b].abs() { a } else { b };
    [(first, ["x", "y", "z"][named]), (second, ["x", "y", "z"][other])]
}
